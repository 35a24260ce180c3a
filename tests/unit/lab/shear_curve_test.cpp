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

TEST(ShearCurve, TooShortARecordGivesZeros) {
  const ShearCurve c = read_shear_curve(record(
      5e-5, [](double) { return 1e3; }, [](double) { return 0.0; }));
  EXPECT_EQ(c.peak_stress, 0.0);
  EXPECT_EQ(read_shear_curve({}).peak_stress, 0.0);
}

}  // namespace
}  // namespace dem
