// SPDX-License-Identifier: BSD-3-Clause
// Which balls are near each other, and which balls are near which wall.
//
// First bodies, then balls. Every run of balls of one body gets a bounding sphere; the spheres are sorted into cell
// grids, one per size level: level k holds radii above r_max / 2^(k+1) and up to r_max / 2^k, with cells as wide as the
// largest pair of that level plus the skin. A sphere looks into the 27 cells around it on its own level (partners of
// higher number) and on every coarser level (all partners), so small bodies never pay for the cells of large ones. Only
// for spheres that meet are the balls compared, and of those only the ones that reach the other's sphere: a rubber
// grain meets its neighbours with a few of its 35 balls. The search runs in parallel over fixed blocks; keys end in
// ascending order, so the list depends on the positions alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem4grm/walls/wall.hpp"

namespace dem {

/// Two ball ids, i < j, packed so that sorting the keys sorts by (i, j).
using PairKey = std::uint64_t;
constexpr PairKey pair_key(int i, int j) {
  return static_cast<PairKey>(static_cast<std::uint32_t>(i)) << 32U | static_cast<std::uint32_t>(j);
}
constexpr int first_of(PairKey key) { return static_cast<int>(key >> 32U); }
constexpr int second_of(PairKey key) { return static_cast<int>(key & 0xffffffffU); }

/// Balls as the search sees them; all spans are [n_balls], indexed by ball id.
struct SearchBalls {
  std::span<const double> x, y, z;  ///< m
  std::span<const double> radius;   ///< m
  std::span<const int> body;        ///< balls of one body are never candidates
};

/// All pairs of different bodies with a surface gap below the skin (m), sorted. Positions must be finite.
std::vector<PairKey> find_pairs(const SearchBalls& balls, double skin);

/// All (ball, wall) with a distance below radius + skin, as pair_key(ball, wall), sorted.
std::vector<PairKey> find_wall_pairs(const SearchBalls& balls, std::span<const Wall> walls, double skin);

/// Those of the given pairs, in their order, whose surfaces overlap: when all pairs that can overlap are among them,
/// the same list as find_pairs(balls, 0), for a fraction of its work.
std::vector<PairKey> pick_pairs(const SearchBalls& balls, std::span<const PairKey> pairs);

/// The same of find_wall_pairs.
std::vector<PairKey> pick_wall_pairs(const SearchBalls& balls, std::span<const Wall> walls, double skin,
                                     std::span<const PairKey> wall_pairs);

}  // namespace dem
