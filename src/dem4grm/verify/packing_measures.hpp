// SPDX-License-Identifier: BSD-3-Clause
// Solid fraction and coordination inside a packing of spheres.
#pragma once

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem::verify {

/// State of the core of a packing.
struct PackingState {
  double solid_fraction = 0.0;  ///< volume of spheres in the core over that of the core
  double coordination = 0.0;    ///< mean number of contacts of the spheres of the core that are no rattlers
  double rattlers = 0.0;        ///< share of the spheres of the core
  double mean_overlap = 0.0;    ///< over the mean diameter, of the contacts between spheres
  int core_spheres = 0;         ///< spheres with their centre in the core
};

/// Volume of a sphere inside a box, m3: exact chords along z over a grid of columns.
double volume_inside(const Vec3& centre, double radius, const Bounds& box);

/// Rattlers have fewer contacts than least_contacts with spheres that are none, found by repeated removal; contacts
/// with walls count. All clumps of the simulation are lone spheres.
PackingState packing_state(const Simulation& s, const Bounds& core, int least_contacts);

}  // namespace dem::verify
