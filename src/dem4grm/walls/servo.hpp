// SPDX-License-Identifier: BSD-3-Clause
// Velocity of a plate that is to carry a given force.
#pragma once

#include <algorithm>

#include "dem4grm/core/lanes.hpp"

namespace dem {

/// formula:  v = gain (F_target - F) / (dt sum k_n),   |v| <= cap
///   v         velocity towards the grains, m/s
///   F         force of the grains on the plate, compression positive, N
///   sum k_n   normal stiffness of all contacts of the plate, N/m; without contacts the plate moves at the cap
///   gain      share of the force error removed per step in quasi-statics: error factor 1 - gain, stable below 2
/// Source: proportional wall servo of PFC, written so that the units work.
inline double servo_velocity(double force_error, double stiffness_sum, double dt, double gain, double cap) {
  if (stiffness_sum <= 0.0) return force_error > 0.0 ? cap : -cap;
  return std::clamp(gain * force_error / (dt * stiffness_sum), -cap, cap);
}

}  // namespace dem
