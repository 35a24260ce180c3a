// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/shear_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr double k_plate_window = 1e-3;  // m of displacement
constexpr double k_plate_limit = 0.3;    // of the target

}  // namespace

void check_kinetic_energy(double kinetic, double given, double displacement) {
  if (kinetic <= given) return;  // false also for a value that is no number
  throw PhysicsError(
      fmt::format("the grains move with {:.3g} J, more than the {:.3g} J that the walls and the stored energy could "
                  "give (stage shear, "
                  "{:.3f} mm): the calculation is unstable. Try a smaller integration.time_step_safety",
                  kinetic, given, displacement * 1e3));
}

void check_plate_stress(std::span<const ShearRow> rows, double displacement, double target, double begin) {
  if (displacement - begin < k_plate_window) return;
  double sum = 0.0;
  int n = 0;
  for (auto row = rows.rbegin(); row != rows.rend() && row->displacement > displacement - k_plate_window; ++row, ++n) {
    sum += row->normal_stress;
  }
  if (n == 0 || std::fabs(sum / n / target - 1.0) <= k_plate_limit) return;
  throw PhysicsError(
      fmt::format("the top plate holds {:.3g} kPa where {:g} kPa were asked for, over the last {:g} mm (stage shear, "
                  "{:.3f} mm): it "
                  "cannot follow. Try a slower shear.velocity, a larger servo.gain or servo.shear_speed_cap",
                  sum / n / 1e3, target / 1e3, k_plate_window * 1e3, displacement * 1e3));
}

}  // namespace dem
