// SPDX-License-Identifier: BSD-3-Clause
// How many contacts there are for each body, who carries nothing, who slides.
#pragma once

#include <span>

#include "dem4grm/micro/contact_network.hpp"

namespace dem {

struct Connectivity {
  /// 2 N_c / N_b: contacts of two bodies for each body.
  double coordination = 0.0;
  /// The same with all contacts of two bodies counted as one.
  double coordination_pairs = 0.0;
  /// Contacts for each body that is no rattler: (2 N_c - contacts of rattlers) / (N_b - rattlers).
  /// Source: Thornton (2000).
  double coordination_mechanical = 0.0;
  double rattlers = 0.0;         ///< share of all bodies
  double rattlers_gravel = 0.0;  ///< share of the gravel grains; not a number without any
  double rattlers_rubber = 0.0;  ///< share of the rubber grains; not a number without any
};

/// A rattler touches fewer than two partners, bodies or walls: nothing can be carried through it.
Connectivity connectivity_of(const ContactNetwork& network);

/// Sums over some contacts.
struct Friction {
  double contacts = 0.0;
  double sliding = 0.0;  ///< share of the contacts at their Coulomb limit; not a number without contacts
  double bulk = 0.0;     ///< sum |f_t| / sum |f_n|; not a number without normal force
};
/// Source of the bulk friction: Chew et al. (2022). It cannot exceed the largest friction coefficient of the contacts.
Friction friction_of(std::span<const Contact> contacts);

}  // namespace dem
