// SPDX-License-Identifier: BSD-3-Clause
// Rubber grains of several sizes: similar motion, one stability limit, and no effect on grains of the reference size.
// Not tested here: how sizes are drawn (draw_grains_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_reference = 0.63e-3;

/// Sixteen grains in a row along x, far apart: eight of the reference size, eight of another one.
Scene two_sizes(double other) {
  Scene scene = model_scene();
  scene.rubber_ball_radius = k_reference;
  for (int g = 0; g < 16; ++g) {
    scene.grains.push_back({{0.02 * g, 0, 0}, normalized({1.0, 0.1 * g, 0.2, 0.3})});
    scene.rubber_ball_radii.push_back(g < 8 ? k_reference : other);
  }
  return scene;
}

/// Squeezes a grain along z by a fifth about its centre, so that second neighbours touch, and lets it go.
void squeeze(Simulation& s, int grain) {
  const Vec3 centre = s.scene.grains[static_cast<std::size_t>(grain)].position;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(grain, slot);
    const Vec3 from = s.balls.position(i) - centre;
    s.balls.set_position(i, centre + Vec3{from.x, from.y, 0.8 * from.z});
  }
}

TEST(RubberSizes, SmallerGrainsMoveAsTheReferenceDoesOnlySmaller) {
  // Every stiffness goes as r at equal strain and so does the mass: positions are similar at every instant.
  const double ratio = 0.6;
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    Scene scene = two_sizes(ratio * k_reference);
    scene.bond.form = form;
    for (int g = 8; g < 16; ++g) scene.grains[static_cast<std::size_t>(g)].orientation = scene.grains[0].orientation;
    Simulation s(scene);
    s.set_time_step(3e-6);
    squeeze(s, 0);
    squeeze(s, 12);
    double largest = 0.0;
    for (int step = 0; step < 300; ++step) {
      s.step();
      for (int slot = 0; slot < k_grain_balls; ++slot) {
        const Vec3 a = s.balls.position(BallStore::rubber_index(0, slot)) - scene.grains[0].position;
        const Vec3 b = s.balls.position(BallStore::rubber_index(12, slot)) - scene.grains[12].position;
        largest = std::max(largest, norm(b - a * ratio) / k_reference);
      }
    }
    // Rounding of places of 0.24 m, carried through 300 steps.
    EXPECT_LT(largest, 1e-8);
    // It did move: by far more than that.
    EXPECT_GT(norm(s.balls.position(BallStore::rubber_index(0, 0)) - scene.grains[0].position), 0.0);
    EXPECT_GT(s.energy().kinetic, 0.0);
  }
}

TEST(RubberSizes, SmallerGrainsHaveTheLimitOfTheReferenceLargerOnesALongerOne) {
  const auto limit = [](double other) {
    Scene scene = two_sizes(other);
    Simulation s(scene);
    s.set_time_step(3e-6);
    s.step();
    return stable_time_step(s, 4e-6);
  };
  const double reference = limit(k_reference);
  EXPECT_NEAR(limit(0.5 * k_reference) / reference, 1.0, 1e-3);  // accuracy of the search for the stiffest mode
  EXPECT_NEAR(limit(1.5 * k_reference) / reference, 1.0, 1e-3);  // the reference grains decide
  Scene large = two_sizes(1.5 * k_reference);
  for (double& radius : large.rubber_ball_radii) radius = 1.5 * k_reference;
  Simulation s(large);
  s.set_time_step(3e-6);
  s.step();
  // A free grain of the same density: k / m goes as 1 / r^2, dashpots alike.
  EXPECT_NEAR(stable_time_step(s, 6e-6) / reference, 1.5, 2e-3);
}

TEST(RubberSizes, MassesOfLargeGrainsAreTheirOwn) {
  const Simulation s(two_sizes(1.5 * k_reference));
  const double ball = 4.0 / 3.0 * k_pi * std::pow(k_reference, 3) * 1610.0;
  EXPECT_NEAR(s.rubber_of_grain(0).ball_mass / ball, 1.0, 1e-12);
  EXPECT_NEAR(s.rubber_of_grain(15).ball_mass / ball, 3.375, 1e-12);
  EXPECT_NEAR(Simulation(two_sizes(0.5 * k_reference)).rubber_of_grain(8).ball_mass / ball, 0.5, 1e-12);
}

TEST(RubberSizes, GrainsOfTheReferenceSizeKeepTheirBits) {
  // Eight grains in a heap, then the same with eight others of another size far away.
  Scene scene = model_scene();
  for (int g = 0; g < 8; ++g) {
    const int x = g % 2, y = g / 2 % 2, z = g / 4;
    scene.grains.push_back({{3.6e-3 * x, 3.7e-3 * y, 3.5e-3 * z}, normalized({1.0, 0.1 * g, 0, 0.2})});
  }
  Scene more = scene;
  more.rubber_ball_radii.assign(8, scene.rubber_ball_radius);
  for (int g = 0; g < 8; ++g) more.grains.push_back({{0.1 + 0.01 * g, 0, 0}, {}});
  more.rubber_ball_radii.resize(16, 0.4e-3);
  Simulation a(scene), b(more);
  a.set_time_step(2e-6);
  b.set_time_step(2e-6);
  std::size_t most_pairs = 0;
  for (int step = 0; step < 100; ++step) {
    a.step();
    b.step();
    most_pairs = std::max(most_pairs, a.contacts.n_rubber_pairs);
  }
  EXPECT_GT(most_pairs, 20U);
  for (int id = 0; id < a.balls.n_balls(); ++id) {
    ASSERT_EQ(norm(a.balls.position(a.balls.index_of_id(id)) - b.balls.position(b.balls.index_of_id(id))), 0.0) << id;
  }
}

TEST(RubberSizes, SizesThatDoNotComeInRunsAreRefused) {
  Scene scene = two_sizes(0.5e-3);
  scene.rubber_ball_radii[3] = 0.5e-3;
  EXPECT_THROW(Simulation{scene}, InputError);
  scene.rubber_ball_radii.pop_back();
  EXPECT_THROW(Simulation{scene}, InputError);
  scene = two_sizes(-0.5e-3);
  EXPECT_THROW(Simulation{scene}, InputError);
}

}  // namespace
