// SPDX-License-Identifier: BSD-3-Clause
// All balls of a simulation: the balls of rubber grains first, then the pebbles of clumps.
//
// Balls of rubber lie k_lanes = W side by side, so that one vector register holds the same number of W balls, and the
// numbers of a ball follow each other at a distance of W: lane l of a vector holds grain l of a block of W grains.
// Pebbles, which are moved one by one with their bodies, have all their numbers side by side in a record. A ball is
// named by the *index* of its first number; its component c is
//   state[index + c W]  of rubber,   index of (grain g, slot s) = ((g / W) * 35 + s) * 13 W + g % W
//   state[index + c]    of a pebble, index of pebble p          = end of the rubber + 12 p
// All that a contact wants to know of a ball is in nine neighbouring cache lines, or in two
// (docs/decisions/0011-memory-layout.md, 0018-pebbles-in-records.md). Lanes beyond the last grain hold a resting grain
// far away; no sum and no output includes them.
//
// Two numbers name a ball and must not be mixed: its *index* and its *id*, which counts the balls without gaps
// (grain * 35 + slot, then pebbles). Lists are ordered by id, so results do not depend on W.
#pragma once

#include <cstdint>
#include <vector>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/grains/rubber_grain.hpp"

namespace dem {

/// Numbers of a ball. Velocities and spins are those of the last half step; only rubber balls have an orientation.
enum class BallComponent : std::uint8_t {
  x,  // m
  y,
  z,
  vx,  // m/s
  vy,
  vz,
  wx,  // rad/s, space axes
  wy,
  wz,
  qw,  // unit quaternion
  qx,
  qy,
  qz,
};
inline constexpr std::size_t k_rubber_components = 13, k_pebble_components = 9;
/// A pebble has its radius behind these; two unused numbers keep records on 32 bytes.
inline constexpr std::size_t k_pebble_radius_at = 9, k_pebble_record = 12;

/// Distance in memory from the first number of a rubber ball to that component.
constexpr std::size_t component_offset(BallComponent c) { return static_cast<std::size_t>(c) * k_lanes; }

/// State of the balls, SI units.
struct BallStore {
  int n_grains = 0;   ///< rubber grains
  int n_blocks = 0;   ///< of k_lanes grains each
  int n_pebbles = 0;  ///< of all clumps

  AlignedArray<double> state;
  std::vector<double> grain_radius;  ///< [n_grains] m, of the balls of a rubber grain

  void allocate(int grains, int pebbles) {
    n_grains = grains;
    n_pebbles = pebbles;
    n_blocks = (grains + k_width - 1) / k_width;
    state.resize(static_cast<std::size_t>(pebble_index(pebbles)));
    grain_radius.resize(static_cast<std::size_t>(grains));
  }

  [[nodiscard]] int n_rubber_balls() const { return n_grains * k_grain_balls; }
  [[nodiscard]] int n_balls() const { return n_rubber_balls() + n_pebbles; }

  static int rubber_index(int grain, int slot) {
    return ((grain / k_width) * k_grain_balls + slot) * k_rubber_stride + grain % k_width;
  }
  [[nodiscard]] int pebble_index(int pebble) const {
    return first_pebble_index() + pebble * static_cast<int>(k_pebble_record);
  }
  [[nodiscard]] int index_of_id(int id) const {
    if (id >= n_rubber_balls()) return pebble_index(id - n_rubber_balls());
    return rubber_index(id / k_grain_balls, id % k_grain_balls);
  }

  /// Index of pebble 0; balls of rubber have smaller ones.
  [[nodiscard]] int first_pebble_index() const { return n_blocks * k_grain_balls * k_rubber_stride; }
  /// From one component of a ball to the next.
  [[nodiscard]] std::size_t stride_of(int index) const { return index < first_pebble_index() ? k_lanes : 1; }
  [[nodiscard]] double& at(BallComponent c, int index) { return state[place(c, index)]; }
  [[nodiscard]] const double& at(BallComponent c, int index) const { return state[place(c, index)]; }

  [[nodiscard]] Vec3 position(int index) const { return read(BallComponent::x, index); }
  [[nodiscard]] Vec3 velocity(int index) const { return read(BallComponent::vx, index); }
  [[nodiscard]] Vec3 spin(int index) const { return read(BallComponent::wx, index); }
  /// Of a rubber ball.
  [[nodiscard]] Quaternion orientation(int index) const {
    const double* q = &at(BallComponent::qw, index);
    return {q[0], q[k_lanes], q[2 * k_lanes], q[3 * k_lanes]};
  }
  void set_position(int index, const Vec3& p) { write(BallComponent::x, index, p); }
  void set_velocity(int index, const Vec3& v) { write(BallComponent::vx, index, v); }
  void set_spin(int index, const Vec3& w) { write(BallComponent::wx, index, w); }
  void set_orientation(int index, const Quaternion& value) {
    double* q = &at(BallComponent::qw, index);
    q[0] = value.w;
    q[k_lanes] = value.x;
    q[2 * k_lanes] = value.y;
    q[3 * k_lanes] = value.z;
  }

  /// m
  [[nodiscard]] double pebble_radius(int pebble) const { return state[radius_place(pebble)]; }
  void set_pebble_radius(int pebble, double radius) { state[radius_place(pebble)] = radius; }
  /// Radius of the ball with that id, m.
  [[nodiscard]] double radius_of_id(int id) const {
    const int pebble = id - n_rubber_balls();
    return pebble < 0 ? grain_radius[static_cast<std::size_t>(id / k_grain_balls)] : pebble_radius(pebble);
  }

 private:
  static constexpr int k_width = static_cast<int>(k_lanes);
  static constexpr int k_rubber_stride = static_cast<int>(k_rubber_components * k_lanes);

  [[nodiscard]] std::size_t place(BallComponent c, int index) const {
    return static_cast<std::size_t>(index) + static_cast<std::size_t>(c) * stride_of(index);
  }
  [[nodiscard]] std::size_t radius_place(int pebble) const {
    return static_cast<std::size_t>(pebble_index(pebble)) + k_pebble_radius_at;
  }
  [[nodiscard]] Vec3 read(BallComponent first, int index) const {
    const std::size_t stride = stride_of(index);
    const double* v = state.data() + place(first, index);
    return {v[0], v[stride], v[2 * stride]};
  }
  void write(BallComponent first, int index, const Vec3& value) {
    const std::size_t stride = stride_of(index);
    double* v = state.data() + place(first, index);
    v[0] = value.x;
    v[stride] = value.y;
    v[2 * stride] = value.z;
  }
};

}  // namespace dem
