// SPDX-License-Identifier: BSD-3-Clause
// Sliding that turns into rolling, through the engine.
//
// Closed form: the sphere that starts sliding rolls at 5/7 of its speed (any mechanics textbook). Oblique impacts and
// spinning spheres are cases of the verification suite. Not tested: the incline, since the engine has no body force.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

TEST(RollingSphere, ReachesFiveSeventhsOfItsSpeedAtTheRightTime) {
  // A sphere squeezed between a rough floor and a smooth plate, N on both: slides with mu N until t = 2 u0 m/(7 mu N).
  const double r = 2.5e-3, overlap = 5e-6, friction = 0.3, u0 = 0.5;
  Scene scene = model_scene();
  scene.gravel.friction = 1.0;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                     make_wall("plate", {-1, -1, 2 * r - 2 * overlap}, {0, 2, 0}, {2, 0, 0})};
  scene.wall_list[0].friction = friction;
  add_sphere(scene, {0, 0, r - overlap}, r);
  Simulation s(scene);
  set_motion(s, 0, {u0, 0, 0});
  s.set_time_step(2e-7);
  const double mass = 2710 * 4.0 / 3.0 * k_pi * r * r * r;
  const double normal = 1.712222e7 * std::pow(overlap, 1.5);  // coefficient of the contact table for this pair
  const double sliding_time = 2 * u0 * mass / (7 * friction * normal);
  while (s.time < 0.5 * sliding_time) s.step();
  EXPECT_NEAR(clump(s, 0).velocity.x, u0 - friction * normal / mass * s.time, 1e-3 * u0);
  // The tangential spring needs mu N / k_s / u0 = 2 us of 220 us to fill up.
  EXPECT_NEAR(clump(s, 0).spin.y, 2.5 * friction * normal / (mass * r) * s.time, 4e-3 * u0 / r);
  while (s.time < 3.0 * sliding_time) s.step();
  // The tangential spring swings a little about rolling; its mean is what counts.
  double mean = 0.0, mean_spin = 0.0;
  for (int k = 0; k < 4000; ++k) {
    s.step();
    mean += clump(s, 0).velocity.x / 4000;
    mean_spin += clump(s, 0).spin.y / 4000;
  }
  EXPECT_NEAR(mean, 5.0 / 7.0 * u0, 2e-3 * u0);
  EXPECT_NEAR(mean_spin * r, 5.0 / 7.0 * u0, 5e-3 * u0);
}

}  // namespace
