// SPDX-License-Identifier: BSD-3-Clause
// Rubber grains that are caught in one another, and grains outside the box, in scenes made by hand.
#include "dem4grm/specimen/fill_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "dem4grm/grains/rubber_grain.hpp"
#include "support/scene_builder.hpp"

namespace dem {
namespace {

constexpr double k_ball = 0.6e-3;

ClumpTemplate grain_of_balls() {
  ClumpTemplate t;
  for (int slot = 0; slot < k_grain_balls; ++slot) t.pebbles.push_back({grain_site(slot) * k_grain_lattice, 1.0});
  t.bounding_radius = std::sqrt(3.0) * k_grain_lattice + 1.0;
  t.volume = k_grain_balls * 4.0;
  t.moment_of_inertia = {t.volume, t.volume, t.volume};
  return t;
}

ClumpTemplate one_pebble() {
  ClumpTemplate t;
  t.pebbles = {{{}, 1.0}};
  t.bounding_radius = 1.0;
  t.volume = 4.0;
  t.moment_of_inertia = {1.6, 1.6, 1.6};
  return t;
}

/// A rubber grain at 10, 10, 10 mm and, at a place in ball radii from its middle, a body of the given shape and size (m).
Simulation grain_and(int shape, double size, const Vec3& place) {
  const Vec3 middle{10e-3, 10e-3, 10e-3};
  Scene scene = verify::model_scene();
  scene.shapes = {grain_of_balls(), one_pebble()};
  scene.clumps = {{0, k_ball, {middle, {}}, k_rubber}, {shape, size, {middle + place * k_ball, {}}, k_rubber}};
  Simulation s(scene);
  s.set_time_step(1e-9);
  s.step();
  return s;
}

TEST(FillCheckTest, ABallThatRestsBetweenFourOthersIsNotCaught) {
  const double lattice = k_grain_lattice;
  const double on_face = lattice + std::sqrt(4.0 - 0.5 * lattice * lattice);
  EXPECT_NEAR(on_face - lattice, 1.1547, 1e-4);
  EXPECT_EQ(interlocked_balls(grain_and(1, k_ball, {0.5 * lattice, 0.5 * lattice, 0.999 * on_face}), 0), 0);
  EXPECT_EQ(interlocked_balls(grain_and(1, k_ball, {0.5 * lattice, 0.5 * lattice, lattice + 0.6}), 0), 0);
}

TEST(FillCheckTest, ABallBetweenTheOuterOnesIsCaught) {
  const double lattice = k_grain_lattice;
  EXPECT_EQ(interlocked_balls(grain_and(1, k_ball, {0.5 * lattice, 0.5 * lattice, lattice + 0.4}), 0), 1);
  EXPECT_EQ(interlocked_balls(grain_and(1, k_ball, {0.5 * lattice, 0.0, 0.0}), 0), 1);
  // A small pebble in the room between the balls.
  EXPECT_EQ(interlocked_balls(grain_and(1, 0.4 * k_ball, {0.5 * lattice, 0.0, 0.4 * lattice}), 0), 1);
}

TEST(FillCheckTest, GrainsOfBallsThatStandInOneAnother) {
  // Side by side, then with the outer nine and the next four balls of each inside the other.
  EXPECT_EQ(interlocked_balls(grain_and(0, k_ball, {2.0 * k_grain_lattice + 1.99, 0.0, 0.0}), 0), 0);
  EXPECT_EQ(interlocked_balls(grain_and(0, k_ball, {1.5 * k_grain_lattice, 0.3, 0.3}), 0), 26);
}

TEST(FillCheckTest, TheFirstGrainOutsideIsNamed) {
  const Simulation s = grain_and(1, k_ball, {12.0, 0.0, 0.0});
  EXPECT_EQ(first_outside(s, {0.02, 0.02, 0.02}), -1);
  EXPECT_EQ(first_outside(s, {0.015, 0.02, 0.02}), 1);
  EXPECT_EQ(first_outside(s, {0.02, 0.009, 0.02}), 0);
}

}  // namespace
}  // namespace dem
