// SPDX-License-Identifier: BSD-3-Clause
// Bonds that break, through the engine: at the right stress, for good, and as a Hertz contact from the same step on.
//
// Expected: the strain of the strength, sigma_t / E, for a bond that is only stretched; the Hertz force of two rubber
// balls from the contact table (h = 5.679437e5 N/m^1.5 at r = 0.63 mm).
#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

/// A grain of which only bond 0 (centre ball 27, corner ball 0) carries anything worth: all others are slack, since all
/// other balls keep their places and ball 0 has a single bond.
Simulation grain(double tensile, double shear) {
  Scene scene = model_scene();
  scene.bond.form = BondForm::incremental;
  scene.bond.tensile_strength = tensile;
  scene.bond.shear_strength = shear;
  scene.bond.damping_ratio = 0.0;
  scene.grains = {{{0, 0, 0}, {}}};
  Simulation s(scene);
  s.set_time_step(1e-9);
  return s;
}

Vec3 bond_direction(const Simulation& s) {
  const Vec3 d = s.balls.position(BallStore::rubber_index(0, 0)) - s.balls.position(BallStore::rubber_index(0, 27));
  return d * (1.0 / norm(d));
}

/// Moves ball 0 as if by one step, then lets the engine make the step; velocities are reset so that nothing drifts.
void pull(Simulation& s, const Vec3& by) {
  const int i = BallStore::rubber_index(0, 0);
  s.reset_velocities();
  s.balls.set_position(i, s.balls.position(i) + by);
  s.balls.set_velocity(i, by * (1.0 / s.time_step()));
  s.step();
  s.balls.set_position(i, s.balls.position(i) - s.balls.velocity(i) * s.time_step());
  s.reset_velocities();
}

TEST(BrokenBond, BreaksAtItsTensileStrain) {
  const double strength = 2e5, r = 0.63e-3, limit = strength / 20e6 * 2 * r;  // 1 % of the length
  Simulation s = grain(strength, 30e200);
  const Vec3 n = bond_direction(s);
  pull(s, n * (0.999 * limit));
  EXPECT_FALSE(read_bond(s, 0, 0).is_broken);
  EXPECT_NEAR(read_bond(s, 0, 0).normal_force, 0.999 * strength * k_pi * r * r, 1e-3 * strength * k_pi * r * r);
  pull(s, n * (0.002 * limit));
  EXPECT_TRUE(read_bond(s, 0, 0).is_broken);
  EXPECT_EQ(read_bond(s, 0, 0).normal_force, 0.0);
  for (int k = 1; k < k_grain_bonds; ++k) EXPECT_FALSE(read_bond(s, 0, k).is_broken);
}

TEST(BrokenBond, BreaksUnderShear) {
  const double strength = 5e4, r = 0.63e-3, limit = strength * 4.0 / 20e6 * 2 * r;
  Simulation s = grain(30e200, strength);
  const Vec3 n = bond_direction(s), across = perpendicular({1, -1, 0}, n) * (1.0 / norm(perpendicular({1, -1, 0}, n)));
  pull(s, across * (0.998 * limit));
  EXPECT_FALSE(read_bond(s, 0, 0).is_broken);
  pull(s, across * (0.004 * limit));
  EXPECT_TRUE(read_bond(s, 0, 0).is_broken);
}

TEST(BrokenBond, TurnsIntoAHertzContactInTheSameStep) {
  // Shear breaks the bond while the balls are pressed together: that very step has the Hertz force, not the bond's.
  const double r = 0.63e-3, overlap = 20e-6;
  Simulation s = grain(30e200, 1e4);
  const Vec3 n = bond_direction(s), across = perpendicular({1, -1, 0}, n) * (1.0 / norm(perpendicular({1, -1, 0}, n)));
  const int i = BallStore::rubber_index(0, 0), centre = BallStore::rubber_index(0, 27);
  const Vec3 by = n * -overlap + across * 5e-6;
  s.balls.set_position(i, s.balls.position(i) + by);
  s.balls.set_velocity(i, by * (1.0 / s.time_step()));
  const double now = 2 * r - norm(s.balls.position(i) - s.balls.position(centre));
  const Vec3 direction = bond_direction(s), before = s.balls.velocity(i);
  s.step();
  EXPECT_TRUE(read_bond(s, 0, 0).is_broken);
  const double normal = dot((s.balls.velocity(i) - before) * (s.rubber().ball_mass / s.time_step()), direction);
  EXPECT_NEAR(normal, 5.679437e5 * std::pow(now, 1.5), 1e-3 * normal);
  // The friction of the new contact starts from zero and takes up the slide of this step, capped at 0.27 of the force.
  EXPECT_NEAR(norm(read_bond(s, 0, 0).shear), std::min(0.27 * normal, 2.54e3 * 5e-6), 0.03 * 0.27 * normal);
}

TEST(BrokenBond, StaysBroken) {
  Simulation s = grain(2e5, 30e200);
  const Vec3 n = bond_direction(s);
  pull(s, n * 20e-6);
  ASSERT_TRUE(read_bond(s, 0, 0).is_broken);
  pull(s, n * -20e-6);
  run_steps(s, 10);
  EXPECT_TRUE(read_bond(s, 0, 0).is_broken);
  const Vec3 v = s.balls.velocity(BallStore::rubber_index(0, 0));
  EXPECT_LT(norm(v), 1e-9);  // back at its place without bond or contact
}

}  // namespace
