// SPDX-License-Identifier: BSD-3-Clause
// The velocity that the servo asks of its plate, by the formula. Not tested here: the plate on grains, which
// `dem4grm verify --only servo-spring-bed` and `--only servo-approach` hold against closed forms.
#include "dem4grm/walls/servo.hpp"

#include <gtest/gtest.h>

namespace {

using namespace dem;

TEST(Servo, VelocityOfTheFormula) {
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 4e5, 1e-6, 0.5, 1e9), 0.5 * 2.0 / (1e-6 * 4e5));
  EXPECT_DOUBLE_EQ(servo_velocity(-2.0, 4e5, 1e-6, 0.5, 0.01), -0.01);
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 4e5, 1e-6, 0.5, 0.01), 0.01);
  EXPECT_DOUBLE_EQ(servo_velocity(2.0, 0.0, 1e-6, 0.5, 0.01), 0.01);    // nothing touched yet: approach
  EXPECT_DOUBLE_EQ(servo_velocity(-2.0, 0.0, 1e-6, 0.5, 0.01), -0.01);  // and the other way
}

}  // namespace
