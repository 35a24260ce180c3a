// SPDX-License-Identifier: BSD-3-Clause
// Small scenes for verification and tests: lone spheres, clumps, rubber grains and walls, and how to set them in
// motion.
#pragma once

#include <numbers>
#include <vector>

#include "dem4grm/engine/simulation.hpp"

namespace dem::verify {

inline constexpr double k_pi = std::numbers::pi;

/// Materials of the published model (one set of 16 parameters; rubber Poisson's ratio 0.5), no local damping.
inline Scene model_scene() {
  Scene s;
  s.gravel = {2710.0, 0.72, 90e6, 0.30};
  s.rubber = {1610.0, 0.27, 12e6, 0.50};
  s.walls = {0.0, 0.70, 80e9, 0.25};
  s.rubber_ball_radius = 0.63e-3;
  s.integration.local_damping = 0.0;
  return s;
}

/// A lone ball: written down from the definition of a template, without the code that measures clumps.
/// Sieve size 1 = diameter, volume pi/6, moment of inertia (2/5) m (1/2)^2 = pi/60 at unit density.
inline ClumpTemplate sphere_template() {
  ClumpTemplate t;
  t.name = "sphere";
  t.pebbles = {{{0, 0, 0}, 0.5}};
  t.volume = k_pi / 6.0;
  t.moment_of_inertia = {k_pi / 60.0, k_pi / 60.0, k_pi / 60.0};
  t.bounding_radius = 0.5;
  return t;
}

/// Adds a sphere of the radius (m) and returns the index of its clump.
inline std::size_t add_sphere(Scene& s, const Vec3& position, double radius, Material material = k_gravel) {
  int shape = -1;
  for (std::size_t k = 0; k < s.shapes.size(); ++k) {
    if (s.shapes[k].name == "sphere") shape = static_cast<int>(k);
  }
  if (shape < 0) {
    shape = static_cast<int>(s.shapes.size());
    s.shapes.push_back(sphere_template());
  }
  s.clumps.push_back({shape, 2.0 * radius, {position, {}}, material});
  return s.clumps.size() - 1;
}

/// Sets clump c in motion; its pebbles too, since the contact law reads theirs.
inline void set_motion(Simulation& s, std::size_t c, const Vec3& velocity, const Vec3& spin = {}) {
  Clump& body = s.clumps.clumps[c];
  const Frame f = frame_of(body.orientation);
  const Vec3 w = to_body(f, spin);
  body.velocity = velocity;
  body.spin = spin;
  body.angular_momentum = to_space(f, {body.inertia.x * w.x, body.inertia.y * w.y, body.inertia.z * w.z});
  for (int p = body.first_pebble; p < body.first_pebble + body.n_pebbles; ++p) {
    const int i = s.balls.pebble_index(p);
    s.balls.set_velocity(i, velocity + cross(spin, s.balls.position(i) - body.position));
    s.balls.set_spin(i, spin);
  }
}

inline const Clump& clump(const Simulation& s, std::size_t c) { return s.clumps.clumps[c]; }

inline void run_steps(Simulation& s, int n) {
  for (int k = 0; k < n; ++k) s.step();
}

/// Steps until done() holds. False when it does not after most_steps: a broken engine must fail a test, not hang it.
template <class Done>
bool run_until(Simulation& s, int most_steps, const Done& done) {
  for (int k = 0; k < most_steps; ++k) {
    s.step();
    if (done()) return true;
  }
  return false;
}

/// Shear modulus from Young's modulus.
inline double shear_modulus(double young, double poisson) { return young / (2.0 * (1.0 + poisson)); }

/// Row of the contact of two balls, or of ball and wall; -1 when it is not listed.
inline std::ptrdiff_t pair_row(const Simulation& s, int i, int j) {
  for (std::size_t c = 0; c < s.contacts.n_pairs(); ++c) {
    if (s.contacts.pairs[c] == pair_key(i, j)) return static_cast<std::ptrdiff_t>(c);
  }
  return -1;
}
inline std::ptrdiff_t wall_row(const Simulation& s, int ball, int wall) {
  for (std::size_t c = 0; c < s.contacts.wall_pairs.size(); ++c) {
    if (s.contacts.wall_pairs[c] == pair_key(ball, wall)) {
      return static_cast<std::ptrdiff_t>(s.contacts.n_pair_rows() + c);
    }
  }
  return -1;
}

/// Six walls of a closed box from the origin to `size`, normals inward; the last one is the lid.
inline std::vector<Wall> closed_box(const Vec3& size, double friction = 0.0) {
  const double a = size.x, b = size.y, h = size.z;
  std::vector<Wall> w;
  w.push_back(make_wall("floor", {0, 0, 0}, {a, 0, 0}, {0, b, 0}));
  w.push_back(make_wall("-x", {0, 0, 0}, {0, b, 0}, {0, 0, h}));
  w.push_back(make_wall("+x", {a, 0, 0}, {0, 0, h}, {0, b, 0}));
  w.push_back(make_wall("-y", {0, 0, 0}, {0, 0, h}, {a, 0, 0}));
  w.push_back(make_wall("+y", {0, b, 0}, {a, 0, 0}, {0, 0, h}));
  w.push_back(make_wall("lid", {0, 0, h}, {0, b, 0}, {a, 0, 0}));
  for (Wall& wall : w) wall.friction = friction;
  return w;
}

}  // namespace dem::verify
