// SPDX-License-Identifier: BSD-3-Clause
// The contacts of a simulation: candidates with their constants, history and last forces, in structure of arrays.
//
// Rows [0, n_pair_rows) are ball-ball candidates, padded to a multiple of k_contact_batch: first the pairs of two
// rubber balls, sorted by (i, j), which all share their constants; then the others, sorted by (i, j). Rows
// [n_pair_rows, n_rows) are ball-wall candidates sorted by (ball, wall). Each row is evaluated once per step and its
// force stored; bodies then add up their rows in row order (ContactReferences), so no sum depends on threads. History
// belongs to the pair of ids: when the list is rebuilt it is carried over by a merge of the two sorted lists.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/laws/hertz_mindlin.hpp"
#include "dem4grm/search/candidates.hpp"

namespace dem {

/// What a contact remembers and what it does to its bodies: one cache line, because the bodies that add up their contacts
/// come at them from anywhere, and no more, because a step is as fast as its state fits the cache.
struct alignas(64) ContactState {
  Vec3 normal;                ///< unit vector from i to j (or from the ball to the wall)
  double normal_force = 0.0;  ///< N, with the dashpot; positive when pushing
  Vec3 shear;                 ///< N, on i, space axes: the history
  double overlap = 0.0;       ///< m, 0 when apart
};
inline constexpr std::size_t k_contact_numbers = sizeof(ContactState) / sizeof(double);
/// Places of its parts among these numbers.
inline constexpr std::size_t k_normal_at = 0, k_normal_force_at = 3, k_shear_at = 4, k_overlap_at = 7;
static_assert(k_contact_numbers == 8 && offsetof(ContactState, normal_force) == k_normal_force_at * sizeof(double) &&
              offsetof(ContactState, shear) == k_shear_at * sizeof(double) &&
              offsetof(ContactState, overlap) == k_overlap_at * sizeof(double));

struct ContactTable {
  std::vector<PairKey> pairs;       ///< (i, j) ball ids: pairs of rubber balls, then the others, each part sorted
  std::size_t n_rubber_pairs = 0;   ///< pairs of two rubber balls
  std::vector<PairKey> wall_pairs;  ///< (ball id, wall), sorted

  // Constants of a row while the list lives; padding rows have radius 0 and so never touch.
  AlignedArray<int> index_i, index_j;                  ///< places in the ball store (index_j of a wall row: the wall)
  AlignedArray<double> radius_i, radius_j;             ///< m; radius_j of a wall row is 0
  AlignedArray<double> hertz, shear_ratio, friction;   ///< laws/hertz_mindlin.hpp
  AlignedArray<double> normal_dashpot, shear_dashpot;  ///< empty when dashpots are off

  bool has_equal_rubber = true;          ///< all rubber balls have one radius
  HertzParameters between_rubber_balls;  ///< constants of all pairs of rubber balls, when they are equal

  AlignedArray<ContactState> state;                      ///< history and result of the last evaluation
  AlignedArray<double> damping_x, damping_y, damping_z;  ///< N, shear dashpot on i; empty when dashpots are off
  AlignedArray<ContactState> spare_state;                ///< room for the next list
  AlignedArray<double> spare_damping;

  [[nodiscard]] std::size_t n_pairs() const { return pairs.size(); }
  [[nodiscard]] std::size_t n_pair_rows() const {
    return (pairs.size() + k_contact_batch - 1) / k_contact_batch * k_contact_batch;
  }
  /// Rows of whole batches in which every pair is one of two equal rubber balls.
  [[nodiscard]] std::size_t n_equal_rows() const {
    return has_equal_rubber ? n_rubber_pairs / k_contact_batch * k_contact_batch : 0;
  }
  [[nodiscard]] std::size_t n_rows() const { return n_pair_rows() + wall_pairs.size(); }

  [[nodiscard]] const Vec3& shear(std::size_t row) const { return state[row].shear; }
  /// The states as k_contact_numbers doubles for each row.
  [[nodiscard]] double* state_numbers() { return state.empty() ? nullptr : &state[0].normal.x; }
  /// Shear force on i with its dashpot, N.
  [[nodiscard]] Vec3 shear_total(std::size_t row) const {
    return damping_x.empty() ? shear(row) : shear(row) + Vec3{damping_x[row], damping_y[row], damping_z[row]};
  }
  /// Force on i, N; on j the opposite.
  [[nodiscard]] Vec3 force(std::size_t row) const {
    return shear_total(row) - state[row].normal * state[row].normal_force;
  }
  /// n x F, N: torque on i is lever_i times this, on j lever_j times this.
  [[nodiscard]] Vec3 couple(std::size_t row) const { return cross(state[row].normal, shear_total(row)); }
  [[nodiscard]] bool has_dashpots() const { return !normal_dashpot.empty(); }
  /// From the centre of ball i or j to the contact point, m.
  [[nodiscard]] double lever_i(std::size_t row) const { return radius_i[row] - 0.5 * state[row].overlap; }
  [[nodiscard]] double lever_j(std::size_t row) const { return radius_j[row] - 0.5 * state[row].overlap; }

  /// Replaces the candidates; history of pairs that stay is kept, new pairs start from zero. Constants are left to the
  /// caller to fill. Both lists must be sorted; rubber balls are those of ids below n_rubber_balls.
  void replace(std::vector<PairKey> new_pairs, std::vector<PairKey> new_wall_pairs, int n_rubber_balls = 0);

  /// Gives every row constants of zero, for the caller to fill; dashpots are left alone.
  void clear_constants();
};

/// How many references ahead of the present one the bodies that add up their contacts fetch a row.
inline constexpr int k_references_ahead = 16;

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
