// SPDX-License-Identifier: BSD-3-Clause
// Turning of balls, free rotation of rigid bodies, local damping: as formulas, without the engine.
#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"
#include "support/independent_integrator.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;

TEST(Cayley, TurnsByTwiceTheArcTangent) {
  // About z with |w| dt / 2 = 1: exactly 90 degrees, to the left.
  const Quaternion q = turned({}, {0, 0, 4.0}, 0.5);
  const Vec3 x = rotate(q, {1, 0, 0});
  EXPECT_NEAR(x.x, 0.0, 1e-15);
  EXPECT_NEAR(x.y, 1.0, 1e-15);
  EXPECT_NEAR(x.z, 0.0, 1e-15);
}

TEST(Cayley, SeriesForLittleTurnsIsTheSameMap) {
  RandomSequence random(9, RandomStream::test, 0);
  for (int k = 0; k < 1000; ++k) {
    const Quaternion q = random.orientation();
    const Vec3 axis = rotate(random.orientation(), {0, 0, 1});
    const Vec3 spin = axis * random.uniform(0.0, 0.06);
    const Quaternion exact = turned(q, spin, 1.0), series = turned_a_little(q, spin, 1.0);
    EXPECT_NEAR(series.w, exact.w, 5e-16);
    EXPECT_NEAR(series.x, exact.x, 5e-16);
    EXPECT_NEAR(series.y, exact.y, 5e-16);
    EXPECT_NEAR(series.z, exact.z, 5e-16);
  }
  const Quaternion far = turned_a_little({}, {0, 0, 1.5}, 1.0);  // outside its range it must show
  EXPECT_GT(std::fabs(far.w * far.w + far.z * far.z - 1.0), 1e-3);
}

TEST(Cayley, SeriesKeepsTheLengthOverManySteps) {
  Quaternion q = normalized(Quaternion{0.3, -0.5, 0.7, 0.2});
  for (int k = 0; k < 100000; ++k) q = turned_a_little(q, {2e3, -3e3, 5e3}, 3e-6);
  EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-15);
}

TEST(Cayley, SpinIsInSpaceAxes) {
  // Turn about x by 90 degrees first, then about the space z axis: body y, now along z, must stay there.
  const Quaternion first = turned({}, {2.0, 0, 0}, 1.0), second = turned(first, {0, 0, 0.3}, 1.0);
  const Vec3 y = rotate(second, {0, 1, 0});
  EXPECT_NEAR(y.z, 1.0, 1e-15);
}

TEST(Cayley, KeepsUnitLengthOverManySteps) {
  Quaternion q;
  for (int k = 0; k < 100000; ++k) q = turned(q, {300.0, -200.0, 100.0}, 1e-5);
  EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1.0, 1e-14);
}

/// A free body from the start spin in body axes, orientation identity.
struct FreeBody {
  Vec3 inertia, momentum;
  Quaternion orientation;
  Vec3 spin;  // space axes, of the middle of the last step

  FreeBody(const Vec3& principal, const Vec3& w)
      : inertia(principal), momentum{principal.x * w.x, principal.y * w.y, principal.z * w.z} {}
  void advance(double dt) {
    const FreeRotation r = rotate_freely(orientation, momentum, {1 / inertia.x, 1 / inertia.y, 1 / inertia.z}, dt);
    orientation = r.orientation;
    spin = r.spin;
  }
  [[nodiscard]] Vec3 body_spin() const {
    const Vec3 l = to_body(frame_of(orientation), momentum);
    return {l.x / inertia.x, l.y / inertia.y, l.z / inertia.z};
  }
};

TEST(FreeRotation, SphereTurnsByTheCayleyMap) {
  FreeBody body({2, 2, 2}, {0.3, -0.5, 0.7});
  const double dt = 0.01;
  for (int k = 0; k < 100; ++k) body.advance(dt);
  Quaternion q;
  for (int k = 0; k < 100; ++k) q = turned(q, {0.3, -0.5, 0.7}, dt);
  EXPECT_NEAR(std::abs(q.w * body.orientation.w + q.x * body.orientation.x + q.y * body.orientation.y +
                       q.z * body.orientation.z),
              1.0, 1e-10);
  EXPECT_NEAR(norm(body.spin - Vec3{0.3, -0.5, 0.7}), 0.0, 1e-12);
}

TEST(FreeRotation, SymmetricTopPrecessesAtEulersRate) {
  // Euler: with I1 = I2 the body spin turns about the third axis at (I3 - I1)/I1 * w3 = 1 rad/s here, exactly.
  FreeBody body({1, 1, 2}, {0.1, 0, 1.0});
  const double dt = 1e-3;
  for (int k = 0; k < 2000; ++k) body.advance(dt);
  const Vec3 w = body.body_spin();
  EXPECT_NEAR(w.x, 0.1 * std::cos(2.0), 1e-6);
  EXPECT_NEAR(w.y, 0.1 * std::sin(2.0), 1e-6);
  EXPECT_NEAR(w.z, 1.0, 1e-12);
}

/// Error of the body spin after 4 s against Euler's equations by Runge-Kutta.
double error_after_four_seconds(double dt) {
  const Vec3 inertia{1, 2, 3};
  FreeBody body(inertia, {0.3, 1.0, 0.2});
  const int steps = static_cast<int>(std::lround(4.0 / dt));
  for (int k = 0; k < steps; ++k) body.advance(dt);
  test::StateVector<3> w{0.3, 1.0, 0.2};
  const auto euler = [&](double, const test::StateVector<3>& s) {
    return test::StateVector<3>{(inertia.y - inertia.z) / inertia.x * s[1] * s[2],
                                (inertia.z - inertia.x) / inertia.y * s[2] * s[0],
                                (inertia.x - inertia.y) / inertia.z * s[0] * s[1]};
  };
  for (int k = 0; k < 4000; ++k) w = test::runge_kutta_step(euler, 0.0, w, 1e-3);
  return norm(body.body_spin() - Vec3{w[0], w[1], w[2]});
}

TEST(FreeRotation, ErrorFallsWithTheSquareOfTheTimeStep) {
  const double coarse = error_after_four_seconds(0.02), fine = error_after_four_seconds(0.01);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

TEST(FreeRotation, MidStepSpinIsSecondOrder) {
  // The spin handed to the contact law is that of the middle of the step.
  const auto error = [](double dt) {
    FreeBody body({1, 2, 3}, {0.3, 1.0, 0.2}), half = body;
    half.advance(0.5 * dt);
    const Vec3 w = to_space(frame_of(half.orientation), half.body_spin());
    body.advance(dt);
    return norm(body.spin - w);
  };
  EXPECT_LT(error(0.05), 1e-3);
  EXPECT_NEAR(error(0.05) / error(0.025), 4.0, 0.6);
}

TEST(LocalDamping, WorksAgainstTheMotionInEachComponent) {
  const Vec3 f = locally_damped(Vec3{10, -10, 4}, Vec3{1, 1, 0}, 0.2);
  EXPECT_DOUBLE_EQ(f.x, 8.0);    // speeds up less
  EXPECT_DOUBLE_EQ(f.y, -12.0);  // slows down more
  EXPECT_DOUBLE_EQ(f.z, 4.0);    // at rest: nothing
  EXPECT_DOUBLE_EQ(locally_damped(10.0, -1.0, 0.2), 12.0);
}

TEST(LocalDamping, OscillatorLosesItsKnownShare) {
  // Inwards against (1-a) k, outwards against (1+a) k: amplitude per half swing sqrt((1-a)/(1+a)) = 0.8165 at 0.2.
  double x = 1.0, v = 0.0;
  const double dt = 1e-4;
  int crossings = 0;
  double extreme = 0.0;
  for (int k = 0; k < 1000000 && crossings < 4; ++k) {
    v += locally_damped(-x, v, 0.2) * dt;
    const double before = x;
    x += v * dt;
    if ((x - before) * extreme < 0.0) ++crossings;  // a turning point
    extreme = x - before;
  }
  EXPECT_NEAR(std::abs(x), std::pow(0.816497, 4), 1e-3);
}

}  // namespace
