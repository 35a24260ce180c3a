// SPDX-License-Identifier: BSD-3-Clause
// A clump that nothing touches, through the engine.
//
// Expected: conservation of momentum, angular momentum and energy; Euler's and Jacobi's solutions for the free top
// (Landau & Lifshitz, Mechanics, 37). Not tested here: a vibrating rubber grain (`dem4grm verify`).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

/// A clump that is a lone pebble by shape but has the given principal moments (kg m2).
Simulation top(const Vec3& inertia, const Vec3& spin) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2e-3);
  Simulation s(scene);
  s.clumps.clumps[0].inertia = inertia;
  set_motion(s, 0, {}, spin);
  return s;
}

Vec3 body_spin(const Clump& c) {
  const Vec3 l = to_body(frame_of(c.orientation), c.angular_momentum);
  return {l.x / c.inertia.x, l.y / c.inertia.y, l.z / c.inertia.z};
}

double rotation_energy(const Clump& c) {
  const Vec3 w = body_spin(c);
  return 0.5 * (c.inertia.x * w.x * w.x + c.inertia.y * w.y * w.y + c.inertia.z * w.z * w.z);
}

TEST(FreeTop, KeepsAngularMomentumExactlyAndEnergyBounded) {
  Simulation s = top({1e-9, 2e-9, 3e-9}, {10, 100, 10});
  s.set_time_step(1e-4);
  const Vec3 momentum = clump(s, 0).angular_momentum;
  const double energy = rotation_energy(clump(s, 0));
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    s.step();
    worst = std::max(worst, std::abs(rotation_energy(clump(s, 0)) / energy - 1.0));
  }
  EXPECT_EQ(norm(clump(s, 0).angular_momentum - momentum), 0.0);
  EXPECT_LT(worst, 1e-4);  // bounded: 320 turns
}

TEST(FreeTop, MiddleAxisFlipsWithJacobisPeriod) {
  // I = (1,2,3), spin (0.1, 1, 0.1) rad/s in units of 100: the spin about the middle axis swings with period
  //   T = 4 K(k) sqrt(I1 I2 I3 / ((I3 - I2)(L^2 - 2 E I1))),  k^2 = (I2 - I1)(2 E I3 - L^2) / ((I3 - I2)(L^2 - 2 E I1))
  // and the two passages of w2 through zero lie half of it apart.
  const double i1 = 1, i2 = 2, i3 = 3, w1 = 0.1, w2 = 1.0, w3 = 0.1;
  const double e2 = i1 * w1 * w1 + i2 * w2 * w2 + i3 * w3 * w3;
  const double l2 = i1 * i1 * w1 * w1 + i2 * i2 * w2 * w2 + i3 * i3 * w3 * w3;
  // L^2 = 4.10 and 2 E I2 = 4.08: L^2 > 2 E I2, the formula's case.
  ASSERT_GT(l2, e2 * i2);
  const double k = std::sqrt((i2 - i1) * (e2 * i3 - l2) / ((i3 - i2) * (l2 - e2 * i1)));
  const double period = 4.0 * std::comp_ellint_1(k) * std::sqrt(i1 * i2 * i3 / ((i3 - i2) * (l2 - e2 * i1))) / 100.0;

  Simulation s = top({1e-9, 2e-9, 3e-9}, {10, 100, 10});
  s.set_time_step(1e-5);
  std::vector<double> passages;
  double before = body_spin(clump(s, 0)).y;
  while (passages.size() < 4 && s.steps < 200000) {
    s.step();
    const double now = body_spin(clump(s, 0)).y;
    if (before * now < 0.0) passages.push_back(s.time - s.time_step() * now / (now - before));
    before = now;
  }
  ASSERT_EQ(passages.size(), 4U);
  EXPECT_NEAR(passages[2] - passages[0], period, 1e-4 * period);
  EXPECT_NEAR(passages[3] - passages[1], period, 1e-4 * period);
}

TEST(FreeTop, SymmetricTopPrecesses) {
  // In space the axis circles the angular momentum at L / I1.
  Simulation s = top({1e-9, 1e-9, 2e-9}, {30, 0, 100});
  s.set_time_step(2e-5);
  const double rate = norm(clump(s, 0).angular_momentum) / 1e-9;
  const Vec3 l = clump(s, 0).angular_momentum * (1.0 / norm(clump(s, 0).angular_momentum));
  const Vec3 start = perpendicular(frame_of(clump(s, 0).orientation).e3, l);
  while (s.time < 0.5 / rate) s.step();
  const Vec3 now = perpendicular(frame_of(clump(s, 0).orientation).e3, l);
  const double angle = std::atan2(dot(l, cross(start, now)), dot(start, now));
  EXPECT_NEAR(angle, rate * s.time, 2e-4);
}

TEST(FreeTop, PebblesFollowTheBody) {
  Scene scene = model_scene();
  scene.shapes.push_back(*find_clump_template("T6"));
  scene.clumps.push_back({0, 5e-3, {{0.01, 0.02, 0.03}, normalized({1, 2, 3, 4})}, k_gravel});
  Simulation s(scene);
  set_motion(s, 0, {0.5, -0.3, 0.2}, {50, -80, 30});
  s.set_time_step(1e-5);
  run_steps(s, 3000);
  const Clump& c = clump(s, 0);
  EXPECT_NEAR(norm(c.position - Vec3{0.01 + 0.5 * 0.03, 0.02 - 0.3 * 0.03, 0.03 + 0.2 * 0.03}), 0.0, 1e-14);
  for (int p = 0; p < c.n_pebbles; ++p) {
    const Vec3 arm = rotate(c.orientation, scene.shapes[0].pebbles[static_cast<std::size_t>(p)].position * 5e-3);
    EXPECT_LT(norm(s.balls.position(p) - c.position - arm), 1e-15);
    EXPECT_LT(norm(s.balls.velocity(p) - c.velocity - cross(c.spin, arm)), 1e-4);
  }
}

}  // namespace
