// SPDX-License-Identifier: BSD-3-Clause
// How even a specimen is: scatter over cells, loose or layered zones at the walls, fabric before shear, and whether any
// grain is caught in another.
//
//   scatter    standard deviation over the cells of solid_distribution of void ratio e = V / V_s - 1 and of rubber
//              content V_rubber / V_s
//   layering   root mean square of (fraction / mean fraction - 1) over the layers between 0.5 and 2.5 mean grain sizes
//              from the walls; 0.43 for square layers of touching spheres
//   fabric     F = mean of n n over the contacts between different bodies, D = F - 1/3; deviator sqrt(3/2 D:D), 1 when
//              all normals are parallel. The shear plane is left to fabric.hpp.
//   noise      what 1.1 % of isotropic sets of N independent contacts exceed: 1.72 / sqrt(N) (N D:D 15/2 has the chi-squared
//              distribution of 5 degrees). Contacts of one pair of grains are not independent, so a rubber specimen may lie
//              somewhat above it.
//
// A specimen that has been compressed between plates is not isotropic: contacts prefer the direction of the load.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/specimen/packing.hpp"
#include "dem4grm/specimen/solid_distribution.hpp"

namespace dem {

struct FabricMeasure {
  int contacts = 0;
  double deviator = 0.0, deviator_noise = 0.0;
};

/// From the unit normals of contacts; all 0 without contacts.
FabricMeasure measure_fabric(std::span<const Vec3> normals);

struct OverlapMeasure {
  double largest = 0.0;  ///< overlap of two balls of different bodies over the smaller radius
  int caught = 0;        ///< pairs with the centre of one ball inside the other
};

/// Looks at all balls anew, whatever list of contacts the engine keeps.
OverlapMeasure measure_overlaps(const Packing& packing);

struct Homogeneity {
  int cells = 0;
  double void_ratio_scatter = 0.0;      ///< NaN with fewer than two cells, as are the next
  double rubber_content_scatter = 0.0;  ///< fraction
  double void_ratio_inside = 0.0;       ///< NaN when the box has no such zone, as are the next two
  double void_ratio_at_plates = 0.0, void_ratio_at_sides = 0.0;
  double layering_at_plates = 0.0, layering_at_sides = 0.0;
  FabricMeasure fabric;
  OverlapMeasure overlap;
};

/// All of it. room: the box up to the plate, m; mean_size: volume-weighted, m; rubber_fill: solid volume of a rubber grain
/// over the volume of its balls. Takes 0.1 s for a full-size specimen of gravel, 0.2 s of rubber.
Homogeneity measure_homogeneity(const Packing& packing, std::span<const Vec3> normals, const Bounds& room,
                                double mean_size, double rubber_fill);

}  // namespace dem
