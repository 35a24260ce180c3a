// SPDX-License-Identifier: BSD-3-Clause
// All balls of a simulation in one structure of arrays: the balls of rubber grains first, then the pebbles of clumps.
//
// Rubber grains are interleaved k_lanes at a time, so that one vector register holds the same slot of k_lanes grains:
//   index of (grain g, slot s) = ((g / W) * 35 + s) * W + g % W,    W = k_lanes
// Lanes beyond the last grain hold a resting grain far away; no sum and no output includes them.
//
// Two numbers name a ball and must not be mixed: its *index* is the place in the arrays, its *id* counts the balls
// without padding (grain * 35 + slot, then pebbles). Lists are ordered by id, so results do not depend on W.
#pragma once

#include <cstdint>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/grains/rubber_grain.hpp"

namespace dem {

/// State of the balls, SI units; every array has n_rows() elements. Velocities and spins are those of the last half
/// step. Orientations are kept for balls of rubber grains only.
struct BallStore {
  int n_grains = 0;   ///< rubber grains
  int n_blocks = 0;   ///< of k_lanes grains each
  int n_pebbles = 0;  ///< of all clumps

  AlignedArray<double> x, y, z;         ///< m
  AlignedArray<double> vx, vy, vz;      ///< m/s
  AlignedArray<double> wx, wy, wz;      ///< rad/s, space axes
  AlignedArray<double> qw, qx, qy, qz;  ///< rubber balls only
  AlignedArray<double> radius;          ///< m

  void allocate(int grains, int pebbles) {
    n_grains = grains;
    n_pebbles = pebbles;
    n_blocks = static_cast<int>((static_cast<std::size_t>(grains) + k_lanes - 1) / k_lanes);
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &wx, &wy, &wz, &radius}) a->resize(static_cast<std::size_t>(n_rows()));
    for (auto* a : {&qw, &qx, &qy, &qz}) a->resize(static_cast<std::size_t>(n_rubber_rows()));
  }

  [[nodiscard]] int n_rubber_rows() const { return n_blocks * k_grain_balls * static_cast<int>(k_lanes); }
  [[nodiscard]] int n_rows() const { return n_rubber_rows() + n_pebbles; }
  [[nodiscard]] int n_rubber_balls() const { return n_grains * k_grain_balls; }
  [[nodiscard]] int n_balls() const { return n_rubber_balls() + n_pebbles; }

  static int rubber_index(int grain, int slot) {
    constexpr int w = static_cast<int>(k_lanes);
    return ((grain / w) * k_grain_balls + slot) * w + grain % w;
  }
  [[nodiscard]] int pebble_index(int pebble) const { return n_rubber_rows() + pebble; }
  [[nodiscard]] int index_of_id(int id) const {
    if (id >= n_rubber_balls()) return pebble_index(id - n_rubber_balls());
    return rubber_index(id / k_grain_balls, id % k_grain_balls);
  }

  [[nodiscard]] Vec3 position(int index) const { return read(x, y, z, index); }
  [[nodiscard]] Vec3 velocity(int index) const { return read(vx, vy, vz, index); }
  [[nodiscard]] Vec3 spin(int index) const { return read(wx, wy, wz, index); }
  void set_position(int index, const Vec3& p) { write(x, y, z, index, p); }
  void set_velocity(int index, const Vec3& v) { write(vx, vy, vz, index, v); }
  void set_spin(int index, const Vec3& w) { write(wx, wy, wz, index, w); }

 private:
  static Vec3 read(const AlignedArray<double>& a, const AlignedArray<double>& b, const AlignedArray<double>& c, int i) {
    const auto k = static_cast<std::size_t>(i);
    return {a[k], b[k], c[k]};
  }
  static void write(AlignedArray<double>& a, AlignedArray<double>& b, AlignedArray<double>& c, int i, const Vec3& v) {
    const auto k = static_cast<std::size_t>(i);
    a[k] = v.x;
    b[k] = v.y;
    c[k] = v.z;
  }
};

}  // namespace dem
