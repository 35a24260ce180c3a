// SPDX-License-Identifier: BSD-3-Clause
// Size and solid volume of the rubber grain of 35 balls, from the radius of its balls and back.
#include "dem4grm/grains/rubber_size.hpp"

#include <cmath>
#include <numbers>

#include "dem4grm/grains/rubber_grain.hpp"

namespace dem {
namespace {

/// Cube root of a positive number. Not std::cbrt, whose last bit differs between libraries and would reach the state.
double cube_root(double value) {
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);  // in [0.5, 1); scaling by powers of two is exact
  while (exponent % 3 != 0) {
    mantissa *= 0.5;
    ++exponent;
  }
  double root = 0.8;
  for (int i = 0; i < 8; ++i) root = (2.0 * root + mantissa / (root * root)) / 3.0;  // Newton, converged after six
  return std::ldexp(root, exponent / 3);
}

}  // namespace

double rubber_solid_volume(double ball_radius, double ball_density, double solid_density) {
  const double balls = k_grain_balls * (4.0 / 3.0 * std::numbers::pi) * ball_radius * ball_radius * ball_radius;
  return balls * (ball_density / solid_density);
}

double rubber_grain_size(double ball_radius, double ball_density, double solid_density) {
  return cube_root(rubber_solid_volume(ball_radius, ball_density, solid_density));
}

double rubber_ball_radius(double grain_size, double ball_density, double solid_density) {
  return grain_size / rubber_grain_size(1.0, ball_density, solid_density);
}

}  // namespace dem
