// SPDX-License-Identifier: BSD-3-Clause
// Where the solid of a specimen lies: its volume in a grid of cells, and its fraction in layers along the walls.
//
// The box is covered by columns along z, D/16 apart (D: mean grain size). In a column the part of a gravel grain is the
// union of the intervals of its pebbles, exact in z; a clump's own overlaps count once, those of two grains twice, as in
// the void ratio of the whole specimen. A rubber grain has its voids filled: each of its 35 balls stands for 1/35 of its
// solid volume, spread over the sphere of the ball (1.4 of the ball at the published densities).
//
// Error: the columns miss or add about 1 % of a single grain at random, which is 0.1 % of a cell of a hundred grains;
// balls stand for the skin of a rubber grain that lies 0.64 r outside their outer centres, r the ball radius: where a
// border of a cell or a layer passes through a grain its volume can be misplaced by a tenth of a millimetre.
#pragma once

#include <array>
#include <vector>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/specimen/packing.hpp"

namespace dem {

/// A volume of the box and the solid in it, m3.
struct SolidZone {
  double volume = 0.0, solid = 0.0;
  [[nodiscard]] double void_ratio() const { return volume / solid - 1.0; }
};

/// Solid and volume of a cell, m3.
struct Cell {
  double volume = 0.0, gravel = 0.0, rubber = 0.0;
};

struct SolidDistribution {
  std::array<int, 3> counts{};  ///< cells along x, y, z
  std::vector<Cell> cells;      ///< [nz][ny][nx]
  /// Zones by the distance to the plates and to the side walls: nearer than D/2 to one kind and farther than 1.5 D from
  /// the other; farther than 1.5 D from both. Volume 0 when the box is too small.
  SolidZone at_plates, at_sides, inside;
  /// Layers of D/8 by the distance to the nearest plate, and to the nearest side wall, up to 2.5 D or the middle.
  std::vector<SolidZone> plate_layers, side_layers;
};

/// Cells have edges of about 4 D, at least one along each axis. room: the box up to the plate; rubber_fill: solid volume of
/// a rubber grain over the volume of its balls. Grains outside the room do not count. Throws InputError for a room
/// without volume or a mean size that is not positive.
SolidDistribution solid_distribution(const Packing& packing, const Bounds& room, double mean_size, double rubber_fill);

}  // namespace dem
