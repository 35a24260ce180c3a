// SPDX-License-Identifier: BSD-3-Clause
// The contacts of a simulation: candidates with their constants, history and last forces, in structure of arrays.
//
// Rows [0, n_pair_rows) are ball-ball candidates sorted by (i, j) and padded to a multiple of k_contact_batch; rows
// [n_pair_rows, n_rows) are ball-wall candidates sorted by (ball, wall). Each row is evaluated once per step and its
// force stored; bodies then add up their rows in row order (ContactReferences), so no sum depends on threads. History
// belongs to the pair of ids: when the list is rebuilt it is carried over by a merge of the two sorted lists.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/search/candidates.hpp"

namespace dem {

struct ContactTable {
  std::vector<PairKey> pairs;       ///< (i, j) ball ids, sorted
  std::vector<PairKey> wall_pairs;  ///< (ball id, wall), sorted

  // Constants of a row while the list lives; padding rows have radius 0 and so never touch.
  AlignedArray<std::int64_t> index_i, index_j;  ///< places in the ball store (index_j of a wall row is the wall); as
                                                ///< wide as a double so that a vector of them is as long
  AlignedArray<double> radius_i, radius_j;      ///< m; radius_j of a wall row is 0
  AlignedArray<double> hertz, shear_ratio, friction;   ///< laws/hertz_mindlin.hpp
  AlignedArray<double> normal_dashpot, shear_dashpot;  ///< empty when dashpots are off

  // History: shear force on i, N, space axes.
  AlignedArray<double> shear_x, shear_y, shear_z;

  // Result of the last evaluation.
  AlignedArray<double> force_x, force_y, force_z;     ///< N, on i (on j the opposite)
  AlignedArray<double> couple_x, couple_y, couple_z;  ///< N, n x F: torque on i is lever_i times this, on j lever_j
  AlignedArray<double> lever_i, lever_j;              ///< m, from ball centre to contact point

  [[nodiscard]] std::size_t n_pairs() const { return pairs.size(); }
  [[nodiscard]] std::size_t n_pair_rows() const {
    return (pairs.size() + k_contact_batch - 1) / k_contact_batch * k_contact_batch;
  }
  [[nodiscard]] std::size_t n_rows() const { return n_pair_rows() + wall_pairs.size(); }

  [[nodiscard]] Vec3 shear(std::size_t row) const { return {shear_x[row], shear_y[row], shear_z[row]}; }
  [[nodiscard]] Vec3 force(std::size_t row) const { return {force_x[row], force_y[row], force_z[row]}; }

  /// Replaces the candidates; history of pairs that stay is kept, new pairs start from zero. Constants are left to the
  /// caller to fill. Both lists must be sorted.
  void replace(std::vector<PairKey> new_pairs, std::vector<PairKey> new_wall_pairs);

  /// Gives every row constants of zero, for the caller to fill; dashpots are left alone.
  void clear_constants();
};

/// For every owner (block of rubber grains, then clump): which rows act on it, where, and with which sign.
struct ContactReferences {
  static constexpr int k_second = 1 << 30;  ///< set in `place` when the owner is body j of the row

  std::vector<int> start;  ///< [n_owners + 1]
  std::vector<int> row;    ///< contact row, ascending within an owner
  std::vector<int> place;  ///< of the ball within its owner, with k_second

  /// owner_of, place_of: [n_balls] by ball id.
  void build(const ContactTable& table, std::span<const int> owner_of, std::span<const int> place_of, int n_owners);
};

}  // namespace dem
