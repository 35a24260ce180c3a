// SPDX-License-Identifier: BSD-3-Clause
// Reading peak, residual, stiffness and dilation off records whose answers are known by construction.
#include "dem4grm/lab/shear_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace dem {
namespace {

std::vector<ShearRow> record(double end, const std::function<double(double)>& stress,
                             const std::function<double(double)>& rise) {
  std::vector<ShearRow> rows;
  const double interval = 1e-5;
  for (int k = 1; k * interval <= end * (1.0 + 1e-9); ++k) {
    ShearRow row;
    row.displacement = k * interval;
    row.shear_stress = stress(row.displacement);
    row.vertical_displacement = rise(row.displacement);
    rows.push_back(row);
  }
  return rows;
}

TEST(ShearCurve, PeakAndResidualOfARiseAndFall) {
  // Linear to 80 kPa at 2 mm, linear down to 50 kPa at 4 mm, flat to 10 mm.
  const auto stress = [](double u) {
    if (u < 2e-3) return 80e3 * u / 2e-3;
    if (u < 4e-3) return 80e3 - 30e3 * (u - 2e-3) / 2e-3;
    return 50e3;
  };
  const ShearCurve c = read_shear_curve(record(10e-3, stress, [](double u) { return 0.2 * u; }));
  EXPECT_NEAR(c.displacement_at_peak, 2e-3, 0.05e-3);
  EXPECT_LT(c.peak_stress, 80e3);  // a mean over 0.1 mm rounds the tip
  EXPECT_GT(c.peak_stress, 78e3);
  EXPECT_NEAR(c.residual_stress, 50e3, 1.0);
  EXPECT_NEAR(c.secant_stiffness, 80e3 / 2e-3, 1.0);
  EXPECT_NEAR(c.dilation_angle, std::atan(0.2), 1e-9);
  EXPECT_NEAR(c.vertical_displacement_at_end, 2e-3, 1e-12);
  EXPECT_FALSE(c.is_hardening);
}

TEST(ShearCurve, AStrengthComesWithItsDisplacementsAndItsNormalStress) {
  // A peak of one window, 4.91 to 5 mm, in 10 mm; the plate rises by 0.2 of the displacement, the normal stress by 1 kPa a mm.
  auto rows = record(
      10e-3, [](double u) { return u > 4.905e-3 && u < 5.005e-3 ? 90e3 : 50e3; }, [](double u) { return 0.2 * u; });
  for (ShearRow& row : rows) row.normal_stress = 100e3 + 1e6 * row.displacement;
  const ShearCurve c = read_shear_curve(rows);
  EXPECT_NEAR(c.peak_stress, 90e3, 1e-6);
  EXPECT_NEAR(c.peak_point.displacement, 4.955e-3, 1e-12);  // mean of 4.91, 4.92, ... 5.00
  EXPECT_EQ(c.displacement_at_peak, c.peak_point.displacement);
  EXPECT_NEAR(c.peak_point.vertical_displacement, 0.2 * 4.955e-3, 1e-12);
  EXPECT_NEAR(c.peak_point.normal_stress, 104.955e3, 1e-6);
  EXPECT_NEAR(c.residual_stress, 50e3, 1e-6);
  EXPECT_NEAR(c.residual_point.displacement, 9.005e-3, 1e-12);  // 8.01, 8.02, ... 10.00
  EXPECT_NEAR(c.residual_point.vertical_displacement, 0.2 * 9.005e-3, 1e-12);
  EXPECT_NEAR(c.residual_point.normal_stress, 109.005e3, 1e-6);
}

TEST(ShearCurve, ASingleSpikeIsNoPeak) {
  auto rows = record(
      6e-3, [](double u) { return u < 3e-3 ? 60e3 : 40e3; }, [](double) { return 0.0; });
  rows[450].shear_stress = 200e3;  // one row of 0.01 mm: 24 kPa over a mean of 0.1 mm, 56 in all
  const ShearCurve c = read_shear_curve(rows);
  EXPECT_NEAR(c.peak_stress, 60e3, 1e-6);
}

TEST(ShearCurve, RisingToTheEndIsHardening) {
  const ShearCurve c = read_shear_curve(record(
      8e-3, [](double u) { return 5e6 * u; }, [](double u) { return -0.1 * u; }));
  EXPECT_TRUE(c.is_hardening);
  EXPECT_NEAR(c.dilation_angle, std::atan(-0.1), 1e-9);
}

TEST(ShearCurve, SteepestMillimetreDecidesTheDilationAngle) {
  const auto rise = [](double u) { return u < 2e-3 ? 0.0 : (u < 3.5e-3 ? 0.5 * (u - 2e-3) : 0.75e-3); };
  const ShearCurve c = read_shear_curve(record(
      8e-3, [](double) { return 1.0; }, rise));
  EXPECT_NEAR(c.dilation_angle, std::atan(0.5), 1e-9);
}

/// Shear stress 60 kPa plus what the rise of the plate takes, under 100 kPa: friction alone is always 0.6.
std::vector<ShearRow> dilating_record() {
  // Sinks by 0.1 mm over the first millimetre, rises with a slope of 0.4 from 1 to 3 mm, then with 0.1.
  const auto slope = [](double u) { return u < 1e-3 ? -0.1 : (u < 3e-3 ? 0.4 : 0.1); };
  const auto rise = [](double u) {
    return u < 1e-3 ? -0.1 * u : (u < 3e-3 ? -0.1e-3 + 0.4 * (u - 1e-3) : 0.7e-3 + 0.1 * (u - 3e-3));
  };
  std::vector<ShearRow> rows = record(
      8e-3, [&](double u) { return 100e3 * (0.6 + slope(u - 0.5e-5)); }, rise);
  for (ShearRow& row : rows) row.normal_stress = 100e3;
  return rows;
}

TEST(Dilatancy, TaylorsFrictionIsWhatTheRiseOfTheLoadLeaves) {
  const std::vector<ShearRow> rows = dilating_record();
  for (const std::size_t n : {90U, 250U, 800U}) {  // within the first, the second and the third part
    const Dilatancy d = last_dilatancy(std::span(rows).first(n));
    EXPECT_NEAR(d.rate, n == 90U ? -0.1 : (n == 250U ? 0.4 : 0.1), 1e-9);
    EXPECT_NEAR(d.shear_ratio, 0.6 + d.rate, 1e-9);
    EXPECT_NEAR(d.friction, 0.6, 1e-9);
  }
  // Only the last 0.5 mm count: 0.25 mm behind the bend the mean slope lies between the two.
  const Dilatancy at_bend = last_dilatancy(std::span(rows).first(325));
  EXPECT_GT(at_bend.rate, 0.15);
  EXPECT_LT(at_bend.rate, 0.35);
  EXPECT_TRUE(std::isnan(last_dilatancy(std::span(rows).first(1)).rate));
  EXPECT_TRUE(std::isnan(last_dilatancy({}).friction));
}

TEST(Dilatancy, CurveNamesContractionPeakAndEnd) {
  const ShearCurve c = read_shear_curve(dilating_record());
  EXPECT_NEAR(c.contraction, 0.1e-3, 1e-9);
  EXPECT_NEAR(c.displacement_at_contraction, 1e-3, 1e-8);
  EXPECT_NEAR(c.fastest_dilation.dilatancy.rate, 0.4, 1e-9);
  EXPECT_GT(c.fastest_dilation.displacement, 1.249e-3);  // windows between the bends, all alike
  EXPECT_LT(c.fastest_dilation.displacement, 2.751e-3);
  EXPECT_NEAR(c.at_peak.dilatancy.shear_ratio, c.peak_stress / 100e3, 0.26);
  EXPECT_NEAR(c.at_peak.displacement, c.displacement_at_peak, 0.26e-3);
  EXPECT_NEAR(c.residual.dilatancy.shear_ratio, 0.7, 1e-9);
  EXPECT_NEAR(c.residual.dilatancy.friction, 0.6, 1e-9);
  EXPECT_NEAR(c.residual.displacement, 7e-3, 1e-8);
}

TEST(Dilatancy, ARecordThatOnlyRisesHasNoContraction) {
  const ShearCurve c = read_shear_curve(record(
      2e-3, [](double) { return 1e3; }, [](double u) { return 0.2 * u; }));
  EXPECT_EQ(c.contraction, 0.0);
  EXPECT_EQ(c.displacement_at_contraction, 0.0);
}

TEST(ShearCurve, WhatARecordIsTooShortForIsNotMeasured) {
  const ShearCurve c = read_shear_curve(record(
      5e-5, [](double) { return 1e3; }, [](double) { return 0.0; }));
  EXPECT_TRUE(std::isnan(c.peak_stress));
  EXPECT_TRUE(std::isnan(read_shear_curve({}).peak_stress));
  // Half a millimetre has a peak, but neither a dilation angle over 1 mm nor a residual over 2 mm.
  const auto up_to = [](double end) {
    return read_shear_curve(record(
        end, [](double u) { return 5e6 * u; }, [](double u) { return 0.1 * u; }));
  };
  EXPECT_GT(up_to(0.5e-3).peak_stress, 0.0);
  EXPECT_TRUE(std::isnan(up_to(0.5e-3).dilation_angle));
  EXPECT_TRUE(std::isnan(up_to(0.5e-3).residual_stress));
  EXPECT_TRUE(std::isnan(up_to(0.5e-3).residual_point.displacement));
  EXPECT_TRUE(std::isnan(c.peak_point.vertical_displacement));
  EXPECT_NEAR(up_to(1e-3).dilation_angle, std::atan(0.1), 1e-9);
  EXPECT_TRUE(std::isnan(up_to(1.9e-3).residual_stress));
  EXPECT_TRUE(std::isnan(up_to(1.9e-3).residual.dilatancy.rate));
  EXPECT_NEAR(up_to(2e-3).residual_stress, 5e6 * 1.005e-3, 1e-3);
  EXPECT_TRUE(std::isnan(c.at_peak.dilatancy.rate)) << "what was not measured is no zero";
}

}  // namespace
}  // namespace dem
