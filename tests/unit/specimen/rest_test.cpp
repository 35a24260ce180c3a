// SPDX-License-Identifier: BSD-3-Clause
// Speeds of the plate that compresses a specimen. Not tested here: that a specimen comes to rest (tests/lab), the servo
// (tests/verification).
#include "dem4grm/specimen/rest.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dem {
namespace {

TEST(PlateSpeed, GivesTheInertialNumber) {
  // I = strain rate * D / sqrt(stress / density), MiDi (2004): a layer of 60 mm of grains of 3.7 mm and 1150 kg/m3 under
  // 27 kPa, compressed by 1 mm/s.
  const Layer layer{0.060, 3.7e-3, 1150.0};
  const double number = 1e-3 / 0.060 * 3.7e-3 / std::sqrt(27e3 / 1150.0);
  EXPECT_NEAR(plate_speed_at(number, layer, 27e3), 1e-3, 1e-15);
}

TEST(PlateSpeed, LeavesStrainRateTimesInertialTimeAlone) {
  // Twice as large in every length, with four times the stress: the same strain rate times D sqrt(density / stress).
  const Layer small{0.030, 3.7e-3, 1150.0}, large{0.060, 7.4e-3, 1150.0};
  EXPECT_NEAR(plate_speed_at(0.003, large, 4.0 * 27e3), 2.0 * plate_speed_at(0.003, small, 27e3), 1e-12);
}

TEST(PlateSpeed, RisesWithTheStressThatWasReached) {
  PlateLoad load;
  load.stress = 90e3;
  load.speed_cap = 0.05;
  EXPECT_EQ(speed_cap_at(load, 90e3), 0.05) << "only faster where it was asked for";
  load.speed_of_stress = 1e-3;
  EXPECT_EQ(speed_cap_at(load, 0.0), 0.05);
  EXPECT_EQ(speed_cap_at(load, -5.0), 0.05) << "a plate that is torn off";
  EXPECT_EQ(speed_cap_at(load, 2499.0), 0.05);
  EXPECT_DOUBLE_EQ(speed_cap_at(load, 10e3), 0.1);
  EXPECT_DOUBLE_EQ(speed_cap_at(load, 90e3), 0.3);
  EXPECT_DOUBLE_EQ(speed_cap_at(load, 1e6), 0.3) << "a blow is no firm specimen";
}

}  // namespace
}  // namespace dem
