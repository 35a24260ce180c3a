// SPDX-License-Identifier: BSD-3-Clause
// Contacts made by hand or by chance, for tests of the micro-mechanics.
#pragma once

#include <cmath>
#include <numbers>

#include "dem4grm/core/random.hpp"
#include "dem4grm/micro/contact_network.hpp"

namespace dem::test {

inline constexpr double k_degree = std::numbers::pi / 180.0;

/// A contact whose normal lies in the shear plane at an angle (rad); the tangential force points along y.
inline Contact plane_contact(double angle, double normal_force, double shear_force) {
  Contact c;
  c.ball_i = c.body_i = 0;
  c.ball_j = c.body_j = 1;
  c.normal = {std::cos(angle), 0.0, std::sin(angle)};
  c.normal_force = normal_force;
  c.shear_force = {0.0, shear_force, 0.0};
  return c;
}

/// Exponential with mean 1, so its standard deviation is 1 too: forces in granular matter are about like that.
inline double exponential(RandomSequence& random) { return -std::log(1.0 - random.uniform()); }

/// An angle from (1/2pi) {1 + a cos 2(theta - theta_a)} by rejection, [0, 2 pi).
inline double random_angle(RandomSequence& random, double a, double theta_a) {
  for (;;) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    if (random.uniform(0.0, 1.0 + a) < 1.0 + a * std::cos(2.0 * (angle - theta_a))) return angle;
  }
}

/// Smallest distance of two angles that are the same modulo the period.
inline double apart(double a, double b, double period) {
  return std::fabs(a - b - period * std::nearbyint((a - b) / period));
}

}  // namespace dem::test
