// SPDX-License-Identifier: BSD-3-Clause
// Size and volume of the rubber grain against the numbers of the physics reference, 4.2.
#include "dem4grm/grains/rubber_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace dem;

TEST(RubberSize, FactorsOfTheModel) {
  EXPECT_NEAR(rubber_solid_volume(1.0, 1610.0, 1150.0), 205.25, 0.005);
  EXPECT_NEAR(rubber_grain_size(1.0, 1610.0, 1150.0), 5.8988, 0.00005);
}

TEST(RubberSize, GrainOfThePublishedSize) {
  const double radius = rubber_ball_radius(3.70e-3, 1610.0, 1150.0);
  EXPECT_NEAR(radius, 0.6272e-3, 0.00005e-3);
  EXPECT_NEAR(rubber_solid_volume(radius, 1610.0, 1150.0), 50.65e-9, 0.005e-9);
  EXPECT_NEAR(rubber_solid_volume(radius, 1610.0, 1150.0) * 1150.0, 58.25e-6, 0.01e-6);  // mass, kg
}

TEST(RubberSize, RadiusAndSizeAreInverse) {
  for (const double radius : {1e-6, 3.1e-4, 6.27e-4, 0.9, 1.0, 7.0, 4.4e3}) {
    const double size = rubber_grain_size(radius, 1610.0, 1150.0);
    EXPECT_NEAR(rubber_ball_radius(size, 1610.0, 1150.0) / radius, 1.0, 1e-14);
    EXPECT_NEAR(size / std::cbrt(rubber_solid_volume(radius, 1610.0, 1150.0)), 1.0, 1e-14);
  }
}

TEST(RubberSize, OnlyTheRatioOfTheDensitiesMatters) {
  EXPECT_DOUBLE_EQ(rubber_solid_volume(1e-3, 1610.0, 1150.0), rubber_solid_volume(1e-3, 1610e4, 1150e4));
}

}  // namespace
