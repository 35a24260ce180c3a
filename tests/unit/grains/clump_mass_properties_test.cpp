// SPDX-License-Identifier: BSD-3-Clause
// Mass properties of unions of pebbles against closed forms, and the rules of principal axes.
#include "dem4grm/grains/clump_mass_properties.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "dem4grm/core/random.hpp"

namespace {

using namespace dem;

/// Integrals along the axis x of a body of revolution.
struct Revolved {
  double volume = 0.0, first = 0.0, axial = 0.0, transverse = 0.0;  // moments of inertia about the origin
};

/// Adds the slice from x = a to b of a sphere at x = c on the axis: squared profile p = R^2 - t^2 with t = x - c.
/// Disc at x: volume pi p, axial moment pi p^2 / 2, transverse moment pi p^2 / 4 + pi p x^2, all polynomials in t.
void add_slice(Revolved& body, double c, double radius, double a, double b) {
  const double r2 = radius * radius;
  const auto antiderivatives = [r2](double t) {
    return std::array<double, 4>{r2 * t - t * t * t / 3, r2 * t * t / 2 - t * t * t * t / 4,
                                 r2 * t * t * t / 3 - std::pow(t, 5) / 5,
                                 r2 * r2 * t - 2 * r2 * t * t * t / 3 + std::pow(t, 5) / 5};
  };
  const auto high = antiderivatives(b - c), low = antiderivatives(a - c);
  const double p0 = high[0] - low[0], p1 = high[1] - low[1], p2 = high[2] - low[2], pp = high[3] - low[3];
  body.volume += std::numbers::pi * p0;
  body.first += std::numbers::pi * (p1 + c * p0);
  body.axial += std::numbers::pi / 2 * pp;
  body.transverse += std::numbers::pi / 4 * pp + std::numbers::pi * (p2 + 2 * c * p1 + c * c * p0);
}

/// Exact union of spheres of radius r1 at x = 0 and r2 at x = d: they part at the plane of their common circle.
Revolved two_spheres(double r1, double r2, double d) {
  const double plane = (d * d + r1 * r1 - r2 * r2) / (2 * d);
  Revolved body;
  add_slice(body, 0.0, r1, -r1, plane);
  add_slice(body, d, r2, plane, d + r2);
  return body;
}

std::vector<Pebble> moved(std::vector<Pebble> pebbles, const Quaternion& q, const Vec3& shift) {
  for (Pebble& pebble : pebbles) pebble.position = rotate(q, pebble.position) + shift;
  return pebbles;
}

double quadratic_form(const SymmetricTensor& t, const Vec3& a, const Vec3& b) {
  return dot(a, Vec3{t.xx * b.x + t.xy * b.y + t.xz * b.z, t.xy * b.x + t.yy * b.y + t.yz * b.z,
                     t.xz * b.x + t.yz * b.y + t.zz * b.z});
}

TEST(UnionProperties, OnePebbleIsExact) {
  const std::vector<Pebble> pebbles{{{1.5, -2.0, 0.7}, 0.8}};
  const UnionProperties body = union_properties(pebbles);
  const double volume = 4.0 / 3.0 * std::numbers::pi * 0.512;
  EXPECT_NEAR(body.volume, volume, 1e-14);
  EXPECT_NEAR(norm(body.centroid - pebbles[0].position), 0.0, 1e-14);
  EXPECT_NEAR(body.inertia.xx, 0.4 * volume * 0.64, 1e-14);
  EXPECT_NEAR(body.inertia.yz, 0.0, 1e-14);
}

TEST(UnionProperties, TwoEqualSpheresMatchTheLensFormula) {
  const double r = 1.0, c = 0.6;  // V = 8/3 pi R^3 - pi/12 (4R + c)(2R - c)^2
  const UnionProperties body = union_properties(std::vector<Pebble>{{{-0.3, 0, 0}, r}, {{0.3, 0, 0}, r}});
  const double exact = 8.0 / 3.0 * std::numbers::pi - std::numbers::pi / 12.0 * (4 * r + c) * (2 * r - c) * (2 * r - c);
  EXPECT_NEAR(exact, 6.017, 0.0005);  // physics reference, 5.3
  EXPECT_NEAR(body.volume / exact, 1.0, 2e-5);
}

TEST(UnionProperties, TwoUnequalSpheresInAnyPositionMatchTheClosedForm) {
  for (int trial = 0; trial < 12; ++trial) {
    RandomSequence random(11, RandomStream::test, static_cast<std::uint64_t>(trial));
    const double r1 = random.uniform(0.6, 1.2), r2 = random.uniform(0.6, 1.2), d = random.uniform(0.65, 1.1);
    const Quaternion q = random.orientation();
    const Vec3 shift{random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9)};
    const UnionProperties body = union_properties(moved({{{0, 0, 0}, r1}, {{d, 0, 0}, r2}}, q, shift));

    const Revolved exact = two_spheres(r1, r2, d);
    const double along = exact.first / exact.volume;
    const double transverse = exact.transverse - exact.volume * along * along;
    const Frame frame = frame_of(q);
    EXPECT_NEAR(body.volume / exact.volume, 1.0, 3e-5);
    EXPECT_NEAR(norm(body.centroid - (shift + frame.e1 * along)), 0.0, 3e-5 * r1);
    EXPECT_NEAR(quadratic_form(body.inertia, frame.e1, frame.e1) / exact.axial, 1.0, 3e-5);
    EXPECT_NEAR(quadratic_form(body.inertia, frame.e2, frame.e2) / transverse, 1.0, 3e-5);
    EXPECT_NEAR(quadratic_form(body.inertia, frame.e3, frame.e3) / transverse, 1.0, 3e-5);
    EXPECT_NEAR(quadratic_form(body.inertia, frame.e1, frame.e2) / transverse, 0.0, 3e-5);
  }
}

TEST(UnionProperties, TouchingAndSeparatePebblesAddUpExactly) {
  const UnionProperties body = union_properties(std::vector<Pebble>{{{0, 0, 0}, 1.0}, {{0, 0, 3.0}, 1.0}});
  EXPECT_NEAR(body.volume, 8.0 / 3.0 * std::numbers::pi, 1e-13);
  EXPECT_NEAR(body.inertia.zz, 2 * 0.4 * 4.0 / 3.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(body.inertia.xx, 8.0 / 3.0 * std::numbers::pi * (0.4 + 2.25), 1e-12);
}

TEST(UnionProperties, APebbleInsideAnotherAddsNothing) {
  const UnionProperties body = union_properties(std::vector<Pebble>{{{0, 0, 0}, 1.0}, {{0.2, 0.1, 0}, 0.5}});
  EXPECT_NEAR(body.volume / (4.0 / 3.0 * std::numbers::pi), 1.0, 1e-4);
}

TEST(PrincipalAxes, MomentsAreSortedAndTheFrameIsRightHanded) {
  // diag(3, 1, 2) turned by nothing: the axes are y, z, x with positive components.
  const PrincipalAxes p = principal_axes({3, 1, 2, 0, 0, 0});
  EXPECT_NEAR(p.moments.x, 1, 1e-14);
  EXPECT_NEAR(p.moments.y, 2, 1e-14);
  EXPECT_NEAR(p.moments.z, 3, 1e-14);
  EXPECT_NEAR(p.axes.e1.y, 1, 1e-14);
  EXPECT_NEAR(p.axes.e2.z, 1, 1e-14);
  EXPECT_NEAR(p.axes.e3.x, 1, 1e-14);
  EXPECT_NEAR(dot(cross(p.axes.e1, p.axes.e2), p.axes.e3), 1, 1e-14);
}

TEST(PrincipalAxes, EqualMomentsFollowTheGivenFrame) {
  // Differences like those of rounding must not choose the axes.
  const PrincipalAxes ball = principal_axes({2, 2 + 1e-9, 2 - 1e-9, 1e-9, 0, -1e-9});
  EXPECT_EQ(ball.axes.e1.x, 1.0);
  EXPECT_EQ(ball.axes.e2.y, 1.0);
  EXPECT_EQ(ball.moments.x, ball.moments.z);
  const PrincipalAxes needle = principal_axes({1, 2, 2 + 1e-9, 0, 0, 1e-9});
  EXPECT_NEAR(needle.axes.e1.x, 1.0, 1e-8);
  EXPECT_NEAR(needle.axes.e2.y, 1.0, 1e-8);
  EXPECT_EQ(needle.moments.y, needle.moments.z);
  const PrincipalAxes disc = principal_axes({2, 2 + 1e-9, 3, 1e-9, 0, 0});
  EXPECT_NEAR(disc.axes.e3.z, 1.0, 1e-8);
  EXPECT_NEAR(disc.axes.e1.x, 1.0, 1e-8);
  EXPECT_EQ(disc.moments.x, disc.moments.y);
}

}  // namespace
