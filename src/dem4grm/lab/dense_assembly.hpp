// SPDX-License-Identifier: BSD-3-Clause
// A stand-in for a specimen when only speed is asked for: the grains of a case on a lattice, turned at random, so close
// that they have about as many contacts as under load. Made in a moment, where a specimen takes minutes to hours.
#pragma once

#include <cstdint>

#include "dem4grm/engine/scene.hpp"
#include "dem4grm/specimen/grain_list.hpp"

namespace dem {

/// Volume of a lattice cell over the mean solid volume of a grain. With it, 5769 rubber grains have 90,000 contacts, as
/// many as in a specimen under 100 kPa.
inline constexpr double k_dense_cell_volume = 1.44;

/// What stands in the box.
struct DenseAssembly {
  Scene scene;          ///< grains on the lattice and the walls of a shear box around them
  double height = 0.0;  ///< m, of the top plate
};

/// materials: a scene whose materials, bonds, contacts and integration are used. length, width: of the box, m. Overlaps
/// are far from equilibrium: step it with a time step so short that nothing moves.
DenseAssembly make_dense_assembly(const GrainList& grains, const Scene& materials, double length, double width,
                                  std::uint64_t seed);

/// A time step, s, in which forces are computed as ever but no grain of a dense assembly gets anywhere.
inline constexpr double k_frozen_time_step = 1e-13;

}  // namespace dem
