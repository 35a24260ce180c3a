// SPDX-License-Identifier: BSD-3-Clause
// The limit of a whole assembly, and when the time step follows it. That the engine obeys the limit is a verification
// case (time-step-of-state).
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_radius = 2.5e-3;

/// A gravel sphere between two rough plates, 20 um overlap on each: k_s 9.459451e4 N/m apiece.
Simulation pressed_sphere() {
  Scene scene = model_scene();
  const double d = 20e-6;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                     make_wall("lid", {-1, -1, 2 * (k_radius - d)}, {0, 2, 0}, {2, 0, 0})};
  for (Wall& w : scene.wall_list) w.friction = 0.7;
  add_sphere(scene, {0, 0, k_radius - d}, k_radius);
  Simulation s(scene);
  s.set_time_step(1e-7);
  s.step();
  return s;
}

/// The turning mode, 2 k_s l^2 / (0.4 m r^2): walls do not move, so nothing is counted twice.
double limit_of_pressed_sphere() {
  const double lever = k_radius - 10e-6, mass = 4.0 / 3.0 * k_pi * k_radius * k_radius * k_radius * 2710;
  return 2.0 / std::sqrt(2 * 9.459451e4 * lever * lever / (0.4 * mass * k_radius * k_radius));
}

TEST(StiffestMode, OfASpherePressedBetweenPlates) {
  const Simulation s = pressed_sphere();
  const double expected = limit_of_pressed_sphere();
  EXPECT_NEAR(stiffest_mode(s, expected), 4.0, 1e-4);
  EXPECT_NEAR(stiffest_mode(s, 0.5 * expected), 1.0, 1e-4);
  EXPECT_NEAR(stable_time_step(s, 0.5 * expected), expected, 1e-4 * expected);
}

TEST(StiffestMode, FromTooLongAStepTheAnswerIsOnTheSafeSide) {
  const Simulation s = pressed_sphere();
  const double expected = limit_of_pressed_sphere();
  EXPECT_NEAR(stable_time_step(s, 1.25 * expected), 0.8 * expected, 1e-3 * expected);
}

TEST(StiffestMode, NothingJoinedNothingLimits) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, k_radius);
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.step();
  EXPECT_EQ(stiffest_mode(s, 1e-6), 0.0);
  EXPECT_EQ(stable_time_step(s, 1e-6), std::numeric_limits<double>::infinity());
}

TEST(StiffestMode, SameBitsOnAnyNumberOfThreads) {
  Scene scene = model_scene();
  for (int k = 0; k < 40; ++k) scene.grains.push_back({{4e-3 * k, 0, 0}, {}});
  const Simulation s(scene);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const double one = stiffest_mode(s, 4e-6);
  omp_set_num_threads(3);
  EXPECT_EQ(stiffest_mode(s, 4e-6), one);
  omp_set_num_threads(before);
}

TEST(TimeStepReview, ComesAtWholeIntervalsOnly) {
  Simulation s = pressed_sphere();
  ASSERT_EQ(s.steps, 1);
  review_time_step(s, 1.0);
  EXPECT_EQ(s.dt, 1e-7);
  s.steps = 3 * k_review_interval;
  review_time_step(s, 1.0);
  EXPECT_NEAR(s.dt, s.scene.integration.time_step_safety * limit_of_pressed_sphere(), 1e-3 * s.dt);
  EXPECT_NEAR(s.dt * 1e9, std::round(s.dt * 1e9), 1e-6);
}

TEST(TimeStepReview, NeverPassesTheLongestAllowed) {
  Simulation s = pressed_sphere();
  s.steps = k_review_interval;
  review_time_step(s, 2e-6);
  EXPECT_EQ(s.dt, 2e-6);
}

TEST(TimeStepReview, LeavesTheDiagonalRuleAlone) {
  Simulation s = pressed_sphere();
  s.scene.integration.time_step_rule = TimeStepRule::diagonal;
  s.steps = k_review_interval;
  review_time_step(s, 1.0);
  EXPECT_EQ(s.dt, 1e-7);
}

}  // namespace
