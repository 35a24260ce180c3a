// SPDX-License-Identifier: BSD-3-Clause
// Strength envelopes against closed forms and tables, and that the bounds hold what they promise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "dem4grm/campaign/mohr_envelope.hpp"

namespace dem {
namespace {

using Points = std::vector<StrengthPoint>;

TEST(MohrEnvelope, QuantilesAreThoseOfTheTables) {
  // Two-sided 95 %, as printed in any table of Student's t.
  EXPECT_NEAR(student_quantile_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile_95(2), 4.303, 5e-4);
  EXPECT_NEAR(student_quantile_95(4), 2.776, 5e-4);
  EXPECT_NEAR(student_quantile_95(13), 2.160, 5e-4);
  EXPECT_NEAR(student_quantile_95(100000), 1.960, 5e-4);
}

TEST(MohrEnvelope, PointsOnALineGiveTheLine) {
  const double slope = std::tan(0.6);
  const MohrEnvelope e =
      fit_envelope(Points{{30e3, 5e3 + slope * 30e3}, {60e3, 5e3 + slope * 60e3}, {100e3, 5e3 + slope * 100e3}});
  EXPECT_EQ(e.points, 3);
  EXPECT_EQ(e.stresses, 3);
  EXPECT_NEAR(e.friction_angle->value, 0.6, 1e-12);
  EXPECT_NEAR(e.cohesion->value, 5e3, 1e-7);
  EXPECT_NEAR(*e.friction_angle->low, 0.6, 1e-9);
  EXPECT_NEAR(*e.determination, 1.0, 1e-12);
}

TEST(MohrEnvelope, BoundsOfASmallExampleByHand) {
  // sigma 1, 2, 3 and tau 1, 3, 2: slope 1/2, intercept 1, residuals -0.5, 1, -0.5, s^2 = 1.5, S = 2.
  const MohrEnvelope e = fit_envelope(Points{{1.0, 1.0}, {2.0, 3.0}, {3.0, 2.0}});
  EXPECT_NEAR(std::tan(e.friction_angle->value), 0.5, 1e-12);
  EXPECT_NEAR(e.cohesion->value, 1.0, 1e-12);
  EXPECT_NEAR(*e.residual_deviation, std::sqrt(1.5), 1e-12);
  const double t = 12.7062047362;
  EXPECT_NEAR(std::tan(*e.friction_angle->high), 0.5 + t * std::sqrt(1.5 / 2.0), 1e-8);
  EXPECT_NEAR(*e.cohesion->low, 1.0 - t * std::sqrt(1.5) * std::sqrt(1.0 / 3.0 + 4.0 / 2.0), 1e-8);
  EXPECT_NEAR(*e.determination, 1.0 - 1.5 / 2.0, 1e-12);
  // Through the origin: slope 13/14, residuals 1/14, 16/14, -11/14.
  EXPECT_NEAR(std::tan(e.angle_through_origin->value), 13.0 / 14.0, 1e-12);
  const double s2 = (1.0 + 256.0 + 121.0) / 196.0 / 2.0;
  EXPECT_NEAR(std::tan(*e.angle_through_origin->high), 13.0 / 14.0 + 4.30265272975 * std::sqrt(s2 / 14.0), 1e-8);
}

TEST(MohrEnvelope, WhatCannotBeKnownIsLeftOut) {
  EXPECT_FALSE(fit_envelope(Points{}).angle_through_origin.has_value());
  const MohrEnvelope one = fit_envelope(Points{{60e3, 40e3}});
  EXPECT_FALSE(one.friction_angle.has_value());
  EXPECT_NEAR(one.angle_through_origin->value, std::atan(2.0 / 3.0), 1e-12);
  EXPECT_FALSE(one.angle_through_origin->low.has_value());
  const MohrEnvelope same = fit_envelope(Points{{60e3, 40e3}, {60e3, 44e3}});
  EXPECT_FALSE(same.friction_angle.has_value()) << "seeds under one stress give no slope";
  EXPECT_TRUE(same.angle_through_origin->low.has_value());
  const MohrEnvelope two = fit_envelope(Points{{30e3, 20e3}, {60e3, 40e3}});
  EXPECT_TRUE(two.friction_angle.has_value());
  EXPECT_FALSE(two.friction_angle->low.has_value()) << "two points lie on every line through them";
  EXPECT_FALSE(two.residual_deviation.has_value());
  EXPECT_FALSE(fit_envelope(Points{{1.0, 2.0}, {2.0, 2.0}, {3.0, 2.0}}).determination.has_value());
}

TEST(MohrEnvelope, ScaleAndOrderDoNotMatter) {
  Points points{{30e3, 25e3}, {60e3, 41e3}, {100e3, 77e3}, {100e3, 70e3}};
  const MohrEnvelope a = fit_envelope(points);
  std::reverse(points.begin(), points.end());
  for (StrengthPoint& p : points) p = {2.0 * p.normal_stress, 2.0 * p.shear_stress};
  const MohrEnvelope b = fit_envelope(points);
  EXPECT_NEAR(a.friction_angle->value, b.friction_angle->value, 1e-12);
  EXPECT_NEAR(*a.friction_angle->low, *b.friction_angle->low, 1e-12);
  EXPECT_NEAR(2.0 * *a.cohesion->high, *b.cohesion->high, 1e-6);
}

TEST(MohrEnvelope, BoundsHoldTheTruthInNinetyFiveOfAHundredStudies) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> scatter(0.0, 4e3);
  constexpr int k_studies = 4000;
  int angle_held = 0, cohesion_held = 0;
  for (int k = 0; k < k_studies; ++k) {
    Points points;
    for (const double sigma : {30e3, 60e3, 100e3}) {
      for (int seed = 0; seed < 2; ++seed) points.push_back({sigma, 6e3 + 0.7 * sigma + scatter(random)});
    }
    const MohrEnvelope e = fit_envelope(points);
    angle_held += *e.friction_angle->low <= std::atan(0.7) && std::atan(0.7) <= *e.friction_angle->high;
    cohesion_held += *e.cohesion->low <= 6e3 && 6e3 <= *e.cohesion->high;
  }
  // Four standard deviations of a count of 4,000 are 1.4 %.
  EXPECT_NEAR(angle_held / static_cast<double>(k_studies), 0.95, 0.014);
  EXPECT_NEAR(cohesion_held / static_cast<double>(k_studies), 0.95, 0.014);
}

}  // namespace
}  // namespace dem
