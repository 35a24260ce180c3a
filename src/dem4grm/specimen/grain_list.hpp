// SPDX-License-Identifier: BSD-3-Clause
// Which grains a specimen is made of, before anyone knows where they lie.
#pragma once

#include <vector>

#include "dem4grm/grains/clump_template.hpp"

namespace dem {

/// One gravel grain to be made.
struct GravelGrain {
  int shape = 0;            ///< index into GrainList::shapes
  double sieve_size = 0.0;  ///< m
};

/// The grains of a specimen: gravel sizes and shapes, and so many rubber grains of one or several sizes.
struct GrainList {
  std::vector<ClumpTemplate> shapes;
  std::vector<GravelGrain> gravel;
  int rubber_count = 0;
  double rubber_ball_radius = 0.0;   ///< m, of the D50 of the rubber
  double rubber_solid_volume = 0.0;  ///< m3 of one grain of that size, internal voids filled
  std::vector<double> rubber_radii;  ///< [rubber_count] m, in runs of k_grains_of_one_size; empty: all as above
  double rubber_mean_size = 0.0;     ///< m, weighted by volume
  double gravel_volume = 0.0;        ///< m3, all gravel
  double rubber_volume = 0.0;        ///< m3, all rubber (solid volume)

  [[nodiscard]] double ball_radius_of_rubber(int grain) const {
    return rubber_radii.empty() ? rubber_ball_radius : rubber_radii[static_cast<std::size_t>(grain)];
  }
  [[nodiscard]] double solid_volume() const { return gravel_volume + rubber_volume; }
  /// Rubber content by solid volume (VRC), fraction.
  [[nodiscard]] double rubber_content() const { return rubber_volume / solid_volume(); }
};

}  // namespace dem
