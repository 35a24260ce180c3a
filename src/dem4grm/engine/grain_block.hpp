// SPDX-License-Identifier: BSD-3-Clause
// One block of interleaved rubber grains while it is being advanced: its state by pointer, its forces on the stack.
#pragma once

#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Forces and torques of the balls of one block: component c of (slot, lane) at value[c][slot * W + lane];
/// components 0 to 2 force (N), 3 to 5 torque (N m).
struct alignas(64) BlockForces {
  double value[6][k_grain_balls * k_lanes] = {};
};

/// Pointers to slot 0, lane 0 of one block; slot s, lane l is at offset s * W + l.
struct GrainBlock {
  double* __restrict x, * __restrict y, * __restrict z;
  double* __restrict vx, * __restrict vy, * __restrict vz;
  double* __restrict wx, * __restrict wy, * __restrict wz;
  double* __restrict qw, * __restrict qx, * __restrict qy, * __restrict qz;
};

inline GrainBlock grain_block(BallStore& b, std::size_t block) {
  const std::size_t k = block * k_grain_balls * k_lanes;
  return {b.x.data() + k,  b.y.data() + k,  b.z.data() + k,  b.vx.data() + k, b.vy.data() + k,
          b.vz.data() + k, b.wx.data() + k, b.wy.data() + k, b.wz.data() + k, b.qw.data() + k,
          b.qx.data() + k, b.qy.data() + k, b.qz.data() + k};
}

DEM_INLINE Vec3 load3(const double* a, const double* b, const double* c, std::size_t k) { return {a[k], b[k], c[k]}; }

/// Adds force f and torque t to ball k = slot * W + lane.
DEM_INLINE void add_load(BlockForces& out, std::size_t k, const Vec3& f, const Vec3& t) {
  out.value[0][k] += f.x;
  out.value[1][k] += f.y;
  out.value[2][k] += f.z;
  out.value[3][k] += t.x;
  out.value[4][k] += t.y;
  out.value[5][k] += t.z;
}

/// What a block lost in this step, J per lane.
struct alignas(64) BlockLosses {
  double slip[k_lanes] = {};
  double dashpot[k_lanes] = {};
};

/// Bonds of one block in the history-free form (grain_bonds.cpp).
void add_history_free_bonds(const BondParameters& p, const GrainBlock& g, double dt, BlockForces& out,
                            BlockLosses& losses);

/// What a case asks for beside the bonds of one block: linear springs with friction, or Hertz contacts
/// (bond_companion.cpp).
void add_bond_companions(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses);

/// Bonds of one block in the incremental form; broken pairs become Hertz contacts in the same step.
void add_incremental_bonds(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses);

}  // namespace dem
