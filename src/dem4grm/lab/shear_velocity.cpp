// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/shear_velocity.hpp"

#include <algorithm>
#include <cmath>

#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/laws/inertial_number.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/specimen_parts.hpp"

namespace dem {
namespace {

constexpr double k_cap_over_velocity = 5.0;

/// To three significant digits, to whole mm/s from 1 m/s on. Powers of ten up to 1e22 are exact, so that one division
/// gives the double nearest to the decimal number, which is what the text of it reads as.
double rounded_down(double velocity) {
  double scale = 1e3;
  while (velocity * scale < 100.0 && scale < 1e22) scale *= 10.0;
  return std::floor(velocity * scale) / scale;
}

}  // namespace

double shear_velocity(const ShearSettings& shear, const SpecimenReport& specimen) {
  if (shear.velocity) return *shear.velocity;
  const double rate = shear_rate_of(shear.inertial_number.value_or(k_default_inertial_number), specimen.mean_size,
                                    specimen.mean_density, shear.normal_stress);
  return rounded_down(rate * specimen.height);
}

double inertial_number_at(double velocity, const SpecimenReport& specimen, double normal_stress) {
  return inertial_number(velocity / specimen.height, specimen.mean_size, specimen.mean_density, normal_stress);
}

double plate_speed_cap(const DirectShearCase& test, double velocity) {
  if (test.shear.velocity) return std::max(test.servo.shear_speed_cap, velocity);
  // Rounded as the velocity is, so that the cap can be typed as well.
  constexpr double k_scale = 1e10;
  return std::max(test.servo.shear_speed_cap, std::round(k_cap_over_velocity * velocity * k_scale) / k_scale);
}

SpecimenReport expected_specimen(const DirectShearCase& test, const GrainList& grains) {
  SpecimenReport expected;
  describe(grains, specimen_order(test), expected);
  expected.height = test.box.height;
  return expected;
}

double expected_shear_velocity(const DirectShearCase& test) {
  if (test.shear.velocity) return *test.shear.velocity;
  const GrainList grains =
      draw_grains(test.specimen, test.box, test.rubber.density, test.rubber_solid_density, test.seed);
  return shear_velocity(test.shear, expected_specimen(test, grains));
}

}  // namespace dem
