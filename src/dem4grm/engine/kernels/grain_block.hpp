// SPDX-License-Identifier: BSD-3-Clause
// One block of interleaved rubber grains while it is being advanced: its state by pointer, its forces on the stack.
#pragma once

#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Numbers of one load: force (N), torque (N m).
inline constexpr std::size_t k_load_components = 6;

/// Forces and torques of the balls of one block: component c of (slot, lane) at value[(slot * 6 + c) * W + lane].
/// Not initialised: the first who knows something about a ball stores it.
struct alignas(64) BlockForces {
  double value[k_grain_balls * k_load_components * k_lanes];
};

/// Loads by contacts of one block, ball by ball: ball (slot, lane) at [slot * W + lane]. Four numbers for the force and
/// four for the torque, each a register with one lane to spare.
struct alignas(64) ContactLoads {
  double value[k_grain_balls * k_lanes][8] = {};
};

/// Where the load of (slot, lane) begins.
constexpr std::size_t load_at(std::size_t slot, std::size_t lane) { return slot * k_load_components * k_lanes + lane; }

/// Pointers to the components of (slot 0, lane 0) of one block; those of another ball are ball_at(slot, lane) further.
struct GrainBlock {
  double *x, *y, *z, *vx, *vy, *vz, *wx, *wy, *wz, *qw, *qx, *qy, *qz;
};

inline constexpr std::size_t k_block_length = k_grain_balls * k_rubber_components * k_lanes;
constexpr std::size_t ball_at(std::size_t slot, std::size_t lane) {
  return slot * k_rubber_components * k_lanes + lane;
}

DEM_INLINE GrainBlock grain_block(BallStore& b, std::size_t block) {
  using C = BallComponent;
  const auto at = [base = b.state.data() + block * k_block_length](C c) { return base + component_offset(c); };
  return {at(C::x),  at(C::y),  at(C::z),  at(C::vx), at(C::vy), at(C::vz), at(C::wx),
          at(C::wy), at(C::wz), at(C::qw), at(C::qx), at(C::qy), at(C::qz)};
}

DEM_INLINE Vec3 load3(const double* a, const double* b, const double* c, std::size_t k) { return {a[k], b[k], c[k]}; }

/// Adds force f and torque t to the load that begins at k (load_at).
DEM_INLINE void add_load(BlockForces& out, std::size_t k, const Vec3& f, const Vec3& t) {
  double* v = out.value + k;
  v[0] += f.x;
  v[k_lanes] += f.y;
  v[2 * k_lanes] += f.z;
  v[3 * k_lanes] += t.x;
  v[4 * k_lanes] += t.y;
  v[5 * k_lanes] += t.z;
}

/// What a block lost in this step, J per lane.
struct alignas(64) BlockLosses {
  double slip[k_lanes] = {};
  double dashpot[k_lanes] = {};
};

}  // namespace dem
