// SPDX-License-Identifier: BSD-3-Clause
// A gravel sphere between two rough plates, the smallest scene with a stiffness that can be written down.
#pragma once

#include "support/scene_builder.hpp"

namespace dem::test {

inline constexpr double k_pressed_radius = 2.5e-3, k_pressed_overlap = 20e-6;  // m

/// The overlap is there on each side: k_n 1.148593e5 and k_s 9.459451e4 N/m apiece.
inline Simulation pressed_sphere(const ContactSettings& contact = {}) {
  Scene scene = model_scene();
  scene.contact = contact;
  const double r = k_pressed_radius, d = k_pressed_overlap;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                     make_wall("lid", {-1, -1, 2 * (r - d)}, {0, 2, 0}, {2, 0, 0})};
  for (Wall& w : scene.wall_list) w.friction = 0.7;
  add_sphere(scene, {0, 0, r - d}, r);
  Simulation s(scene);
  s.set_time_step(1e-7);
  s.step();
  return s;
}

}  // namespace dem::test
