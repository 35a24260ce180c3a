// SPDX-License-Identifier: BSD-3-Clause
// All pairs of balls that the search has found with wide margins. The lists of candidates, which are needed far more often, are
// picked from them without a new search.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem4grm/search/candidates.hpp"

namespace dem {

/// Positions by components, each [n_balls] by ball id, m.
using BallPositions = std::array<std::vector<double>, 3>;

/// All pairs whose gap was below the sum of two wide margins when they were found. As long as every block of grains
/// would still be inside its wide margin after moving by the margin of a new list, that list is a part of these pairs:
///   displacement since they were found + margin <= wide margin        for every block, and for the walls
///   wide margin = max(margin, min(reserve margin, smallest radius))   of a block;   reserve margin   of walls
/// so that a new list needs no search. The list depends on the present positions and margins alone, not on when these
/// pairs were found; they are no part of the state of a simulation.
struct NearPairs {
  double reserve = 12.0;            ///< wide margin over margin, at least 1; 1: a search for every list
  std::vector<PairKey> pairs;       ///< sorted
  std::vector<PairKey> wall_pairs;  ///< sorted
  std::vector<double> margin;       ///< [n_blocks + clump blocks] m
  double wall_margin = 0.0;         ///< m
  BallPositions found_at;
  std::vector<Vec3> wall_found_at;  ///< [n_walls] corners, m
  bool is_valid = false;
  std::int64_t searches = 0;
};

}  // namespace dem
