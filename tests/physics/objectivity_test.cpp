// SPDX-License-Identifier: BSD-3-Clause
// A loaded pair that is turned rigidly must keep its forces in the turned frame, and no work may be done on it.
//
// The bodies are led by hand along an exact rigid rotation (the same map as ball orientations) through the stages of
// the engine. Expected: the forces of the start, turned; to rounding. For bonds: `dem4grm verify --only
// bond-turned`.
#include <gtest/gtest.h>

#include <cmath>

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
    lead(s, 1, s.balls.position(s.balls.pebble_index(1)) + Vec3{0, 0.15e-6, -0.1e-6}, {});
    evaluate_ball_contacts(s);
  }
  lead(s, 1, s.balls.position(s.balls.pebble_index(1)), {});
  evaluate_ball_contacts(s);
  const Vec3 force = s.contacts.force(row), shear = s.contacts.shear(row);
  ASSERT_GT(norm(shear), 0.1 * norm(force));
  const double slip_before = s.ledger.contact_slip;

  const int n = 720;
  const Vec3 spin = spin_for(GetParam(), 2 * k_pi / n, dt);
  const Vec3 start[2] = {s.balls.position(0), s.balls.position(s.balls.pebble_index(1))};
  Quaternion q;
  Vec3 last_force = force, last_couple = s.contacts.couple(row);
  double work = 0.0, worst = 0.0;
  for (int k = 0; k < n; ++k) {
    q = turned(q, spin, dt);
    for (std::size_t c = 0; c < 2; ++c) lead(s, c, rotate(q, start[c]), spin);
    evaluate_ball_contacts(s);
    const Vec3 f = s.contacts.force(row);
    const Vec3 couple = s.contacts.couple(row);
    // Mean of the forces at both ends of the step: that is what leapfrog makes of it.
    const Vec3 mean_force = (f + last_force) * 0.5, mean_couple = (couple + last_couple) * 0.5;
    last_force = f;
    last_couple = couple;
    work += (dot(mean_force, s.balls.velocity(s.balls.pebble_index(0)) - s.balls.velocity(s.balls.pebble_index(1))) +
             dot(mean_couple, spin) * (s.contacts.lever_i(row) + s.contacts.lever_j(row))) *
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
