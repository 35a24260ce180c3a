// SPDX-License-Identifier: BSD-3-Clause
// The ordered sums: every ball of a block of rubber grains adds up the contacts that act on it, always in row order.
#pragma once

#include "dem4grm/core/registers.hpp"
#include "dem4grm/engine/kernels/grain_block.hpp"

namespace dem {

/// Adds the contact rows that act on a block, in row order.
///   force = sign (F_s - n F_n),   torque = lever n x F_s     (ContactTable)
/// The fourth lanes hold what is left of normal force and overlap, and nobody reads them.
template <bool dashpots>
DEM_INLINE void gather_contacts(const Simulation& s, std::size_t block, ContactLoads& out) {
  const ContactTable& t = s.contacts;
  const double radius = s.rubber_of_block(block).ball_radius;
  const ContactState* const states = t.state.data();
  const int* const rows = s.references.row.data();
  const int* const places = s.references.place.data();
  const int end = s.references.start[block + 1];
  for (int k = s.references.start[block]; k < end; ++k) {
    if (k + k_references_ahead < end) __builtin_prefetch(states + rows[k + k_references_ahead]);
    const auto row = static_cast<std::size_t>(rows[k]);
    const ContactState& contact = states[row];
    const double sign = (places[k] & ContactReferences::k_second) != 0 ? -1.0 : 1.0;
    const double lever = radius - 0.5 * contact.overlap;
    const Four n = load<Four>(&contact.normal.x);
    Four shear = load<Four>(&contact.shear.x);
    if constexpr (dashpots) shear += Four{t.damping_x[row], t.damping_y[row], t.damping_z[row], 0.0};
    const Four force = (shear - n * contact.normal_force) * sign;
    double* to = out.value[places[k] & ~ContactReferences::k_second];
    add_four(to, force);
    add_four(to + 4, cross(n, shear) * lever);
  }
}

/// Begins the loads of all balls with those of their contacts, W balls at a time.
DEM_INLINE void begin_loads(const ContactLoads& contacts, BlockForces& out) {
  for (std::size_t slot = 0; slot < k_grain_balls; ++slot) {
    const auto* of_slot = contacts.value + slot * k_lanes;
    double* to = out.value + load_at(slot, 0);
    if constexpr (k_lanes == 8) {
      double nobody_reads[8];
      const EightRows<const double> from(of_slot[0], 8);
      double* const components[8] = {to,         to + 8,     to + 2 * 8, nobody_reads,
                                     to + 3 * 8, to + 4 * 8, to + 5 * 8, nobody_reads};
      transpose_eight(from.at, components);
    } else {
      for (std::size_t lane = 0; lane < k_lanes; ++lane) {
        for (std::size_t c = 0; c < 3; ++c) to[c * k_lanes + lane] = of_slot[lane][c];
        for (std::size_t c = 3; c < 6; ++c) to[c * k_lanes + lane] = of_slot[lane][c + 1];
      }
    }
  }
}

}  // namespace dem
