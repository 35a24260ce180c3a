// SPDX-License-Identifier: BSD-3-Clause
// Contacts led along prescribed paths through whole steps of the engine.
//
// The time step is so short that forces move nothing by a noticeable amount (some 1e-18 m a step), so positions are
// those of the path; forces of the contact laws do not depend on it, except those of dashpots.
#pragma once

#include <cmath>

#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

inline constexpr double k_leading_time_step = 1e-12;  // s

/// Sets what clump c will do in the next step; what led to its present place stays in its pebbles.
inline void lead(Simulation& s, std::size_t c, const Vec3& velocity, const Vec3& spin = {}) {
  Clump& body = s.clumps.clumps[c];
  const Frame f = frame_of(body.orientation);
  const Vec3 w = to_body(f, spin);
  body.velocity = velocity;
  body.angular_momentum = to_space(f, {body.inertia.x * w.x, body.inertia.y * w.y, body.inertia.z * w.z});
}

inline void hold_all(Simulation& s) {
  for (std::size_t c = 0; c < s.clumps.clumps.size(); ++c) lead(s, c, {});
  for (Wall& w : s.walls) w.velocity = {};
}

/// Evaluates the forces of the present positions: one step in which nothing moves.
inline void settle(Simulation& s) {
  hold_all(s);
  s.step();
}

/// Moves clump c by so much (m) in one step and evaluates the forces there.
inline void move_clump(Simulation& s, std::size_t c, const Vec3& by) {
  hold_all(s);
  lead(s, c, by * (1.0 / s.time_step()));
  s.step();
  settle(s);
}

/// Moves a wall by so much (m) in one step and evaluates the forces there.
inline void move_wall(Simulation& s, std::size_t wall, const Vec3& by) {
  hold_all(s);
  s.walls[wall].velocity = by * (1.0 / s.time_step());
  s.step();
  settle(s);
}

/// Spin (rad/s) that turns a sphere by the angle (rad) about the axis in one step.
inline Vec3 spin_for(const Simulation& s, const Vec3& axis, double angle) {
  return axis * (2.0 * std::tan(0.5 * angle) / (s.time_step() * norm(axis)));
}

/// The only contact of a scene of one sphere and one wall, or of two spheres.
inline std::size_t only_row(const Simulation& s) {
  return static_cast<std::size_t>(s.walls.empty() ? pair_row(s, 0, 1) : wall_row(s, 0, 0));
}

/// Elastic normal force and shear force of a row, N: compression and the force on the first body.
struct LedForces {
  double normal = 0.0;
  Vec3 shear;
};
inline LedForces led_forces(const Simulation& s, const Vec3& normal) {
  const std::size_t row = only_row(s);
  return {-dot(s.contacts.force(row), normal), s.contacts.shear(row)};
}

/// What a led contact is made of; without a partner radius the partner is a wall.
struct LedPair {
  Material first = k_gravel, second = k_gravel;
  double radius = 0.0, partner_radius = 0.0;  ///< m
  double overlap = 0.0;                       ///< m
};

/// Sphere 0 at the origin, its partner (sphere 1 or wall 0) in +x. `scene` gives materials and settings.
inline Simulation led_pair(Scene scene, const LedPair& pair) {
  add_sphere(scene, {0, 0, 0}, pair.radius, pair.first);
  const double reach = pair.radius + pair.partner_radius - pair.overlap;
  if (pair.partner_radius > 0.0) {
    add_sphere(scene, {reach, 0, 0}, pair.partner_radius, pair.second);
  } else {
    scene.wall_list = {make_wall("wall", {reach, -1, -1}, {0, 0, 2}, {0, 2, 0})};
    scene.wall_list[0].friction = scene.walls.friction;
  }
  Simulation s(scene);
  s.set_time_step(k_leading_time_step);
  settle(s);
  return s;
}

}  // namespace dem::verify
