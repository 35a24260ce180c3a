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

/// The grains of a specimen: gravel sizes and shapes, and so many rubber grains of one size.
struct GrainList {
  std::vector<ClumpTemplate> shapes;
  std::vector<GravelGrain> gravel;
  int rubber_count = 0;
  double rubber_ball_radius = 0.0;   ///< m
  double rubber_solid_volume = 0.0;  ///< m3 of one grain, internal voids filled
  double gravel_volume = 0.0;        ///< m3, all gravel
  double rubber_volume = 0.0;        ///< m3, all rubber (solid volume)

  [[nodiscard]] double solid_volume() const { return gravel_volume + rubber_volume; }
  /// Rubber content by solid volume (VRC), fraction.
  [[nodiscard]] double rubber_content() const { return rubber_volume / solid_volume(); }
};

}  // namespace dem
