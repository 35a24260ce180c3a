// SPDX-License-Identifier: BSD-3-Clause
// The limit of a whole assembly, and when the time step follows it. That the engine obeys the limit is a verification
// case (time-step-of-state).
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "support/mixture_case.hpp"
#include "support/pressed_sphere.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_sphere_radius = k_pressed_radius;

/// The turning mode, 2 k_s l^2 / (0.4 m r^2): walls do not move, so nothing is counted twice.
double limit_of_pressed_sphere() {
  const double lever = k_sphere_radius - 10e-6,
               mass = 4.0 / 3.0 * k_pi * k_sphere_radius * k_sphere_radius * k_sphere_radius * 2710;
  return 2.0 / std::sqrt(2 * 9.459451e4 * lever * lever / (0.4 * mass * k_sphere_radius * k_sphere_radius));
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
  add_sphere(scene, {0, 0, 0}, k_sphere_radius);
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.step();
  EXPECT_EQ(stiffest_mode(s, 1e-6), 0.0);
  EXPECT_EQ(stable_time_step(s, 1e-6), std::numeric_limits<double>::infinity());
}

/// More balls than the blocks of the parallel loops hold.
Simulation pressed_mixture() {
  Simulation s(mixture_stand(0.4).assembly.scene);
  s.set_time_step(k_frozen_time_step);
  s.step();
  return s;
}

TEST(StiffestMode, SameBitsOnAnyNumberOfThreads) {
  const Simulation s = pressed_mixture();
  ASSERT_GT(s.balls.n_balls(), 4096);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const double one = stiffest_mode(s, 4e-6);
  for (const int threads : {2, 3, 8}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(stiffest_mode(s, 4e-6), one) << threads;
  }
  omp_set_num_threads(before);
}

TEST(StiffestMode, ThirtyProductsAreEnough) {
  const Simulation s = pressed_mixture();
  const double found = stiffest_mode(s, 4e-6), exact = stiffest_mode(s, 4e-6, 300);
  EXPECT_LE(found, exact * (1.0 + 1e-12));
  EXPECT_GT(found, 0.99 * exact);
}

TEST(TimeStepReview, ComesAtWholeIntervalsOnly) {
  Simulation s = pressed_sphere();
  ASSERT_EQ(s.steps, 1);
  review_time_step(s, 1.0);
  EXPECT_EQ(s.dt, 1e-7);
  s.set_time_step(0.78 * limit_of_pressed_sphere());
  s.steps = 3 * k_review_interval;
  review_time_step(s, 1.0);
  EXPECT_NEAR(s.dt, s.scene.integration.time_step_safety * limit_of_pressed_sphere(), 2e-2 * s.dt);
  EXPECT_NEAR(s.dt * 1e9, std::round(s.dt * 1e9), 1e-6);
}

TEST(TimeStepReview, NeverPassesTheLongestAllowed) {
  Simulation s = pressed_sphere();
  s.set_time_step(1.99e-6);
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

TEST(TimeStepReview, RubberIsLookedAtLessOften) {
  Scene scene = model_scene();
  scene.grains = {{{0, 0, 0}, {}}};
  Simulation s(scene);
  s.set_time_step(3e-6);
  s.steps = k_review_interval;
  review_time_step(s, 1.0);
  EXPECT_EQ(s.dt, 3e-6);
  s.steps = k_review_interval_with_rubber;
  review_time_step(s, 1.0);
  EXPECT_NEAR(s.dt, 1.05 * 3e-6, 1e-9);  // the bonds would allow more
}

TEST(TimeStepReview, AStateGoneWrongIsReported) {
  Simulation s = pressed_sphere();
  s.set_time_step(1e-3);
  s.steps = k_review_interval;
  EXPECT_THROW(review_time_step(s, 1.0), PhysicsError);
  s = pressed_sphere();
  s.contacts.state[s.contacts.n_pair_rows()].normal.z = std::numeric_limits<double>::quiet_NaN();
  s.steps = k_review_interval;
  EXPECT_THROW(review_time_step(s, 1.0), PhysicsError);
}

TEST(ChangeOfTheTimeStep, ContactsSeeTheDisplacementThatWasMade) {
  // A plate slides under a sphere too heavy to follow: whatever the steps, the shear force is k_s times its path.
  Scene scene = model_scene();
  scene.gravel.density = 1e12;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  scene.wall_list[0].friction = 1e3;
  scene.gravel.friction = 1e3;
  add_sphere(scene, {0, 0, k_sphere_radius - 20e-6}, k_sphere_radius);
  Simulation s(scene);
  s.set_time_step(1e-7);
  s.walls[0].velocity = {0.01, 0, 0};
  for (int k = 0; k < 12; ++k) {
    const double path = s.walls[0].corner.x + 1.0;
    s.step();
    EXPECT_NEAR(s.contacts.shear(s.contacts.n_pair_rows()).x, 9.459451e4 * path, 1e-6 * 9.459451e4 * 1e-8) << k;
    s.change_time_step(k % 2 == 0 ? 2.5e-7 : 1.5e-7);
  }
}

}  // namespace
