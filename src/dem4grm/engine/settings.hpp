// SPDX-License-Identifier: BSD-3-Clause
// Settings of the integration and of the test for rest, in SI units.
#pragma once

#include <cstdint>

namespace dem {

enum class TimeStepRule : std::uint8_t { true_limit, diagonal };

struct IntegrationSettings {
  double local_damping = 0.2;  ///< dimensionless
  TimeStepRule time_step_rule = TimeStepRule::true_limit;
  double time_step_safety = 0.8;  ///< fraction of the stability limit
};

/// When a specimen counts as being at rest.
struct EquilibriumSettings {
  double force_ratio = 1e-4;        ///< mean net force on a body over mean contact force
  double plate_speed = 1e-5;        ///< m/s
  double stress_tolerance = 0.005;  ///< relative
  int hold_steps = 5000;            ///< for so many steps in a row
  int most_steps = 2000000;         ///< then the run stops with an error
  // The same where only a void ratio is read, in branches and under load steps, unless the above are looser.
  double branch_force_ratio = 0.01;
  double branch_inertial_number = 5e-6;  ///< of the plate
  int branch_hold_steps = 1000;
};

}  // namespace dem
