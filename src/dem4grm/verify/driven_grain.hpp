// SPDX-License-Identifier: BSD-3-Clause
// Rubber grains whose balls are led by hand or loaded from outside, and grains that are cut down to a few bonds.
#pragma once

#include <array>
#include <vector>

#include "dem4grm/laws/rigid_rotation.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

inline Quaternion orientation_of(const Simulation& s, int i) { return s.balls.orientation(i); }

inline void set_orientation(Simulation& s, int i, const Quaternion& q) { s.balls.set_orientation(i, q); }

/// Moment of inertia of a rubber ball, kg m2.
inline double ball_inertia(const Simulation& s) {
  return 0.4 * s.rubber().ball_mass * s.scene.rubber_ball_radius * s.scene.rubber_ball_radius;
}

/// One grain with the cube axes of the world.
inline Scene lone_grain_scene(const BondSettings& bond) {
  Scene scene = model_scene();
  scene.bond = bond;
  scene.grains = {{{0, 0, 0}, {}}};
  return scene;
}

/// The straight row of five balls along a body diagonal, corner - centre - middle - centre - corner, and its bonds.
inline constexpr std::array<int, 5> k_diagonal_slots{0, 27, 13, 34, 26};
inline constexpr std::array<int, 4> k_diagonal_bonds{0, 7, 56, 63};

/// Breaks every bond of the grain but the first n_bonds of the diagonal, and moves all balls that no longer belong to
/// it three times as far out. Incremental form only.
inline void keep_only_diagonal(Simulation& s, int grain, int n_bonds) {
  const auto g = static_cast<std::size_t>(grain);
  for (std::size_t k = 0; k < k_grain_bonds; ++k) {
    bool kept = false;
    for (int b = 0; b < n_bonds; ++b)
      kept = kept || k_diagonal_bonds[static_cast<std::size_t>(b)] == static_cast<int>(k);
    s.grain_history.bond_is_broken[(g / k_lanes * k_grain_bonds + k) * k_lanes + g % k_lanes] = kept ? 0 : 1;
  }
  const Vec3 centre = s.scene.grains[g].position;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    bool kept = false;
    for (int b = 0; b <= n_bonds; ++b) kept = kept || k_diagonal_slots[static_cast<std::size_t>(b)] == slot;
    const int i = BallStore::rubber_index(grain, slot);
    if (!kept) s.balls.set_position(i, centre + (s.balls.position(i) - centre) * 3.0);
  }
  s.invalidate_candidates();
}

/// What acts on one ball from outside while it moves.
struct OutsideLoad {
  int ball = 0;        ///< index
  Vec3 force, torque;  ///< N, N m
  bool is_held = false;
};

/// One step of the engine with outside loads, viscous drag and held balls added: velocities of the listed balls change
/// by load * dt / mass and are multiplied by `kept`, and their places follow the changed velocities.
inline void step_with_loads(Simulation& s, const std::vector<OutsideLoad>& loads, double kept) {
  struct Place {
    Vec3 position;
    Quaternion orientation;
  };
  std::vector<Place> before;
  before.reserve(loads.size());
  for (const OutsideLoad& l : loads) before.push_back({s.balls.position(l.ball), orientation_of(s, l.ball)});
  s.step();
  const double dt = s.time_step(), per_mass = dt / s.rubber().ball_mass, per_inertia = dt / ball_inertia(s);
  for (std::size_t k = 0; k < loads.size(); ++k) {
    const OutsideLoad& l = loads[k];
    const double share = l.is_held ? 0.0 : kept;
    const Vec3 v = (s.balls.velocity(l.ball) + l.force * per_mass) * share;
    const Vec3 w = (s.balls.spin(l.ball) + l.torque * per_inertia) * share;
    s.balls.set_velocity(l.ball, v);
    s.balls.set_spin(l.ball, w);
    s.balls.set_position(l.ball, before[k].position + v * dt);
    set_orientation(s, l.ball, turned(before[k].orientation, w, dt));
  }
}

/// Force and torque on a ball, N and N m.
struct BallLoad {
  Vec3 force, torque;
};

/// A grain (number 0) whose balls go where they are led; its forces are read from what one step of the engine does to
/// the velocities.
class LedGrain {
 public:
  explicit LedGrain(const Scene& scene, double dt = 1e-6) : s_(scene) { s_.set_time_step(dt); }

  [[nodiscard]] static int index(int slot) { return BallStore::rubber_index(0, slot); }
  [[nodiscard]] Vec3 position(int slot) const { return s_.balls.position(index(slot)); }
  [[nodiscard]] Simulation& simulation() { return s_; }
  [[nodiscard]] const Simulation& simulation() const { return s_; }

  /// Moves a ball to a place and turns it by a small vector, as if both had happened in the step that is over.
  void lead(int slot, const Vec3& to, const Vec3& turn) {
    const int i = index(slot);
    const double per_second = 1.0 / s_.time_step();
    s_.balls.set_velocity(i, (to - s_.balls.position(i)) * per_second);
    s_.balls.set_spin(i, turn * per_second);
    set_orientation(s_, i, turned(orientation_of(s_, i), turn, 1.0));
    s_.balls.set_position(i, to);
  }

  /// Forces on all balls at their present places; afterwards they are at those places again and at rest.
  std::array<BallLoad, k_grain_balls> loads() {
    std::array<Vec3, k_grain_balls> place, velocity, spin;
    std::array<Quaternion, k_grain_balls> orientation;
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      place[k] = position(slot);
      velocity[k] = s_.balls.velocity(index(slot));
      spin[k] = s_.balls.spin(index(slot));
      orientation[k] = orientation_of(s_, index(slot));
    }
    s_.step();
    std::array<BallLoad, k_grain_balls> out;
    const double per_speed = s_.rubber().ball_mass / s_.time_step(), per_spin = ball_inertia(s_) / s_.time_step();
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const auto k = static_cast<std::size_t>(slot);
      const int i = index(slot);
      out[k] = {(s_.balls.velocity(i) - velocity[k]) * per_speed, (s_.balls.spin(i) - spin[k]) * per_spin};
      s_.balls.set_position(i, place[k]);
      set_orientation(s_, i, orientation[k]);
    }
    s_.reset_velocities();
    return out;
  }

 private:
  Simulation s_;
};

}  // namespace dem::verify
