// SPDX-License-Identifier: BSD-3-Clause
// Rigid bodies made of pebbles: their motion, and where each pebble sits on its body.
#pragma once

#include <vector>

#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/core/vec3.hpp"

namespace dem {

/// State of one clump, SI units. Momentum-like quantities belong to the half step, positions to the full step.
struct Clump {
  Vec3 position;           ///< centroid, m
  Quaternion orientation;  ///< principal axes to space
  Vec3 velocity;           ///< m/s
  Vec3 angular_momentum;   ///< space axes, kg m2/s
  Vec3 spin;               ///< space axes, rad/s, derived from the angular momentum at mid-step
  double mass = 0.0;       ///< kg
  Vec3 inertia;            ///< principal moments, kg m2
  double volume = 0.0;     ///< solid volume, m3
  double size = 0.0;       ///< sieve size, m
  int first_pebble = 0;    ///< pebbles [first_pebble, first_pebble + n_pebbles)
  int n_pebbles = 0;
  int shape = 0;  ///< index into the scene's templates
  unsigned char material = 0;
};

/// All clumps of a simulation with the body-frame positions of their pebbles.
struct ClumpStore {
  std::vector<Clump> clumps;
  std::vector<Vec3> pebble_offset;   ///< [n_pebbles] m, principal axes
  std::vector<int> clump_of_pebble;  ///< [n_pebbles]
};

}  // namespace dem
