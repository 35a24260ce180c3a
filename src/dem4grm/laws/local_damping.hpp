// SPDX-License-Identifier: BSD-3-Clause
// Local (non-viscous) damping of the out-of-balance force.
#pragma once

#include <cmath>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"

namespace dem {

/// formula:  F_d = F - alpha |F| sign(v)      per global component; the same for moment and spin
///   F      out-of-balance force component, N (or moment, N m)
///   v      velocity component of the same direction, m/s (or spin, rad/s); sign(0) = 0
///   alpha  damping coefficient, dimensionless, 0 <= alpha < 1
/// Source: Cundall (1987), as in PFC. A linear oscillator loses the factor (1-alpha)/(1+alpha) of its energy per half
/// swing.
DEM_INLINE double locally_damped(double force, double velocity, double alpha) {
  const double opposing = velocity > 0.0 ? alpha : (velocity < 0.0 ? -alpha : 0.0);
  return force - opposing * std::fabs(force);
}

DEM_INLINE Vec3 locally_damped(const Vec3& force, const Vec3& velocity, double alpha) {
  return {locally_damped(force.x, velocity.x, alpha), locally_damped(force.y, velocity.y, alpha),
          locally_damped(force.z, velocity.z, alpha)};
}

}  // namespace dem
