// SPDX-License-Identifier: BSD-3-Clause
// A loaded pair that is turned rigidly must keep its forces in the turned frame, and no work may be done on it.
//
// The bodies are led by hand along an exact rigid rotation (the same map as ball orientations) through the stages of
// the engine. Expected: the forces of the start, turned; for ball contacts and both forms of bond to rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

/// Spin whose Cayley turn over dt is the given angle about the axis.
Vec3 spin_for(const Vec3& axis, double angle, double dt) {
  return axis * (2.0 / dt * std::tan(0.5 * angle) / norm(axis));
}

/// Places sphere c as if it had come there in one step.
void lead(Simulation& s, std::size_t c, const Vec3& to, const Vec3& spin) {
  const int i = s.balls.pebble_index(static_cast<int>(c));
  s.balls.set_velocity(i, (to - s.balls.position(i)) * (1.0 / s.time_step()));
  s.balls.set_position(i, to);
  s.balls.set_spin(i, spin);
}

class TurnedContact : public ::testing::TestWithParam<Vec3> {};

TEST_P(TurnedContact, KeepsItsForcesOverAFullTurn) {
  Scene scene = model_scene();
  const double r = 2.5e-3, dt = 1e-6;
  add_sphere(scene, {0, 0, 0}, r);
  add_sphere(scene, {2 * r - 20e-6, 0, 0}, 0.5 * r);
  scene.clumps[1].pose.position.x = 1.5 * r - 20e-6;
  Simulation s(scene);
  s.set_time_step(dt);
  refresh_candidates(s);
  const auto row = static_cast<std::size_t>(pair_row(s, 0, 1));
  // A tangential load below slip, with components along y and z.
  for (int k = 0; k < 20; ++k) {
    lead(s, 1, s.balls.position(1) + Vec3{0, 0.15e-6, -0.1e-6}, {});
    evaluate_ball_contacts(s);
  }
  lead(s, 1, s.balls.position(1), {});
  evaluate_ball_contacts(s);
  const Vec3 force = s.contacts.force(row), shear = s.contacts.shear(row);
  ASSERT_GT(norm(shear), 0.1 * norm(force));
  const double slip_before = s.ledger.contact_slip;

  const int n = 720;
  const Vec3 spin = spin_for(GetParam(), 2 * k_pi / n, dt);
  const Vec3 start[2] = {s.balls.position(0), s.balls.position(1)};
  Quaternion q;
  Vec3 last_force = force, last_couple{s.contacts.couple_x[row], s.contacts.couple_y[row], s.contacts.couple_z[row]};
  double work = 0.0, worst = 0.0;
  for (int k = 0; k < n; ++k) {
    q = turned(q, spin, dt);
    for (std::size_t c = 0; c < 2; ++c) lead(s, c, rotate(q, start[c]), spin);
    evaluate_ball_contacts(s);
    const Vec3 f = s.contacts.force(row);
    const Vec3 couple{s.contacts.couple_x[row], s.contacts.couple_y[row], s.contacts.couple_z[row]};
    // Mean of the forces at both ends of the step: that is what leapfrog makes of it.
    const Vec3 mean_force = (f + last_force) * 0.5, mean_couple = (couple + last_couple) * 0.5;
    last_force = f;
    last_couple = couple;
    work += (dot(mean_force, s.balls.velocity(0) - s.balls.velocity(1)) +
             dot(mean_couple, spin) * (s.contacts.lever_i[row] + s.contacts.lever_j[row])) *
            dt;
    worst = std::max(worst, norm(f - rotate(q, force)) / norm(force));
    worst = std::max(worst, norm(s.contacts.shear(row) - rotate(q, shear)) / norm(shear));
  }
  EXPECT_LT(worst, 1e-10);
  // sin(a) against 2 tan(a/2) for the turning couple: (half a degree)^2 / 4 of it may remain.
  EXPECT_LT(std::abs(work), 2e-5 * norm(force) * r * 2 * k_pi);
  EXPECT_EQ(s.ledger.contact_slip, slip_before);
}

INSTANTIATE_TEST_SUITE_P(Axes, TurnedContact,
                         ::testing::Values(Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, -1}));

TEST(TurnedBond, IncrementalFormKeepsItsForcesOverAFullTurn) {
  const double r = 0.63e-3, dt = 1e-6;
  const BondParameters p = bond_parameters({r, 1.7e-6, 20e6, 4.0, 1.0, 1.0, 0.0, 30e200, 30e200, true});
  // Without the dashpot: its speed, taken along the normal of the end of the step, is that of the middle plus
  // L (angle per step)^2 / (2 dt), which is nothing at the angles of a real run but not at half a degree per step.
  BondHistory h;
  bool broken = false;
  Vec3 branch{0, 0, 2 * r};
  BondForce f;
  for (int k = 0; k < 100; ++k) {  // stretch, slide, bend and twist it
    const Vec3 v{0.3 * r / 1e-4, -0.2 * r / 1e-4, 0.1 * r / 1e-4};
    branch += v * dt;
    f = incremental_bond(p, {branch, v, {2000, 0, 500}, {-1000, 800, -400}}, dt, h, broken);
  }
  f = incremental_bond(p, {branch, {}, {}, {}}, dt, h, broken);
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, branch, Vec3{1, -2, 3}}) {
    const int n = 720;
    const Vec3 spin = spin_for(axis, 2 * k_pi / n, dt);
    BondHistory turning = h;
    Quaternion q;
    double worst = 0.0;
    Vec3 old = branch;
    for (int k = 0; k < n; ++k) {
      q = turned(q, spin, dt);
      const Vec3 now = rotate(q, branch);
      const BondForce g = incremental_bond(p, {now, (now - old) * (1 / dt), spin, spin}, dt, turning, broken);
      old = now;
      worst = std::max(worst, norm(g.force - rotate(q, f.force)) / norm(f.force));
      worst = std::max(worst, norm(g.moment - rotate(q, f.moment)) / norm(f.moment));
    }
    EXPECT_LT(worst, 1e-10);
  }
}

TEST(TurnedBond, HistoryFreeGrainKeepsAllItsForces) {
  // A grain with every ball moved and turned at random, against the same grain turned as a whole.
  Scene scene = model_scene();
  const double r = scene.rubber_ball_radius;
  scene.grains = {{{0, 0, 0}, {}}};
  Simulation straight(scene), turned_grain(scene);
  RandomSequence random(1, RandomStream::test, 7);
  const Quaternion turn = random.orientation();
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const auto k = static_cast<std::size_t>(i);
    const auto draw = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    const Vec3 at = straight.balls.position(i) + draw(0.05 * r);
    const Quaternion q = turned({}, draw(0.1), 1.0), qt = turn * q;
    straight.balls.set_position(i, at);
    turned_grain.balls.set_position(i, rotate(turn, at));
    straight.balls.qw[k] = q.w, straight.balls.qx[k] = q.x, straight.balls.qy[k] = q.y, straight.balls.qz[k] = q.z;
    turned_grain.balls.qw[k] = qt.w, turned_grain.balls.qx[k] = qt.x;
    turned_grain.balls.qy[k] = qt.y, turned_grain.balls.qz[k] = qt.z;
  }
  for (int bond = 0; bond < k_grain_bonds; ++bond) {
    const BondReading a = read_bond(straight, 0, bond), b = read_bond(turned_grain, 0, bond);
    EXPECT_NEAR(b.normal_force, a.normal_force, 1e-10 * straight.bond.normal_stiffness * r);
    EXPECT_LT(norm(b.shear - rotate(turn, a.shear)), 1e-10 * norm(a.shear));
    EXPECT_LT(norm(b.moment - rotate(turn, a.moment)), 1e-10 * norm(a.moment));
  }
  // The stages see it the same way: one step changes the velocities by turned vectors.
  for (Simulation* s : {&straight, &turned_grain}) {
    s->set_time_step(1e-8);
    s->step();
  }
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const Vec3 v = straight.balls.velocity(i), w = straight.balls.spin(i);
    EXPECT_LT(norm(turned_grain.balls.velocity(i) - rotate(turn, v)), 1e-10 * norm(v));
    EXPECT_LT(norm(turned_grain.balls.spin(i) - rotate(turn, w)), 1e-10 * norm(w));
  }
}

TEST(WallContact, ShearForceTurnsWithHalfTheSpinAboutTheNormal) {
  // The mean of ball and wall turns with half the ball's spin. One full turn of the ball turns the shear force by half
  // a turn, against the wall that stands still: what the law says, written down so that nobody changes it unseen.
  Scene scene = model_scene();
  const double r = 2.5e-3, dt = 1e-6;
  scene.wall_list = {make_wall("plane", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  scene.wall_list[0].friction = 0.7;
  add_sphere(scene, {0, 0, r - 20e-6}, r);
  Simulation s(scene);
  s.set_time_step(dt);
  refresh_candidates(s);
  for (int k = 0; k < 10; ++k) {
    lead(s, 0, s.balls.position(0) + Vec3{0.1e-6, 0, 0}, {});
    evaluate_wall_contacts(s);
  }
  const auto row = static_cast<std::size_t>(wall_row(s, 0, 0));
  const Vec3 shear = s.contacts.shear(row);
  EXPECT_LT(shear.x, 0.0);  // the wall holds the ball back
  const int n = 720;
  for (int k = 0; k < n; ++k) {
    lead(s, 0, s.balls.position(0), spin_for({0, 0, 1}, 2 * k_pi / n, dt));
    evaluate_wall_contacts(s);
  }
  EXPECT_LT(norm(s.contacts.shear(row) + shear), 1e-4 * norm(shear));
}

}  // namespace
