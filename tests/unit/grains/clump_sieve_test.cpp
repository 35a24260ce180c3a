// SPDX-License-Identifier: BSD-3-Clause
// Smallest square opening of clumps: closed forms, independence of orientation, and a plain scan of all orientations.
#include "dem4grm/grains/clump_sieve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dem4grm/core/random.hpp"

namespace {

using namespace dem;

std::vector<Pebble> equal_pebbles(const std::vector<Vec3>& centres, double radius) {
  std::vector<Pebble> pebbles;
  pebbles.reserve(centres.size());
  for (const Vec3& centre : centres) pebbles.push_back({centre, radius});
  return pebbles;
}

std::vector<Pebble> triangle(double edge) {
  return equal_pebbles({{0, 0, 0}, {edge, 0, 0}, {edge / 2, edge * std::sqrt(3.0) / 2, 0}}, 1.0);
}

std::vector<Pebble> tetrahedron(double edge) {
  const double c = edge / std::sqrt(8.0);
  return equal_pebbles({{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}}, 1.0);
}

std::vector<Pebble> irregular() {
  return {{{0, 0, 0}, 1},
          {{0.5, 0.1, 0}, 0.8},
          {{-0.45, 0.15, 0.1}, 0.8},
          {{0.05, -0.45, 0.1}, 0.78},
          {{-0.05, 0.1, -0.35}, 0.85}};
}

double extent(const std::vector<Pebble>& pebbles, const Vec3& u) {
  double low = 1e300, high = -1e300;
  for (const Pebble& pebble : pebbles) {
    low = std::min(low, dot(pebble.position, u) - pebble.radius);
    high = std::max(high, dot(pebble.position, u) + pebble.radius);
  }
  return high - low;
}

/// Scan over viewing directions on a spiral and turns in the plane; at most a few per mille above the minimum.
double scanned_opening(const std::vector<Pebble>& pebbles) {
  const int n_directions = 6000, n_turns = 180;
  double smallest = 1e300;
  for (int i = 0; i < n_directions; ++i) {
    const double z = (i + 0.5) / n_directions, s = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
    const Vec3 view{s * std::cos(turn), s * std::sin(turn), z};
    const Vec3 across = std::abs(view.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 a = perpendicular(across, view) * (1.0 / norm(perpendicular(across, view)));
    const Vec3 b = cross(view, a);
    for (int j = 0; j < n_turns; ++j) {
      const double angle = 0.5 * std::numbers::pi * j / n_turns;
      const Vec3 u = a * std::cos(angle) + b * std::sin(angle), v = cross(view, u);
      smallest = std::min(smallest, std::max(extent(pebbles, u), extent(pebbles, v)));
    }
  }
  return smallest;
}

TEST(SmallestSquareOpening, SphereNeedsItsDiameter) {
  EXPECT_DOUBLE_EQ(smallest_square_opening(equal_pebbles({{3, -2, 1}}, 0.7)), 1.4);
}

TEST(SmallestSquareOpening, TwoEqualSpheresPassLengthwise) {
  EXPECT_NEAR(smallest_square_opening(equal_pebbles({{0.1, 0.2, 0.3}, {0.5, 0.9, -0.2}}, 1.0)), 2.0, 1e-8);
}

TEST(SmallestSquareOpening, AStraightRowPassesLengthwise) {
  EXPECT_NEAR(smallest_square_opening(std::vector<Pebble>{{{-.6, 0, 0}, .85}, {{0, 0, 0}, 1}, {{.6, 0, 0}, .85}}), 2.0,
              1e-8);
}

TEST(SmallestSquareOpening, TriangleMatchesTheClosedForm) {
  // In direction u a triangle of edge a is at least sqrt(3)/2 a |u_p| wide, u_p the part of u in its plane. For
  // perpendicular u, v: |u_p|^2 + |v_p|^2 >= 1, so one of them is at least 1/sqrt(2): width >= a sqrt(6)/4. Both reach
  // it at 45 degrees to the plane with their in-plane parts along a height of the triangle.
  EXPECT_NEAR(smallest_square_opening(triangle(0.7)), 2.0 + 0.7 * std::sqrt(6.0) / 4.0, 1e-8);
}

TEST(SmallestSquareOpening, TetrahedronMatchesTheClosedForm) {
  // The least width of a regular tetrahedron is edge/sqrt(2), between opposite edges; there are three such directions,
  // perpendicular to each other, so the opening is no larger.
  EXPECT_NEAR(smallest_square_opening(tetrahedron(0.75)), 2.0 + 0.75 / std::sqrt(2.0), 1e-8);
}

TEST(SmallestSquareOpening, NoOrientationOfAScanIsBetter) {
  for (const auto& pebbles : {triangle(0.7), tetrahedron(0.75), irregular()}) {
    const double opening = smallest_square_opening(pebbles), scanned = scanned_opening(pebbles);
    EXPECT_GE(scanned, opening * (1 - 1e-8));
    EXPECT_LE(scanned, opening * 1.01);
  }
}

TEST(SmallestSquareOpening, DoesNotDependOnOrientationOrPlace) {
  for (const auto& pebbles : {triangle(0.7), tetrahedron(0.75), irregular()}) {
    const double opening = smallest_square_opening(pebbles);
    for (std::uint64_t trial = 0; trial < 5; ++trial) {
      RandomSequence random(3, RandomStream::test, trial);
      const Quaternion q = random.orientation();
      const Vec3 shift{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
      std::vector<Pebble> turned = pebbles;
      for (Pebble& pebble : turned) pebble.position = rotate(q, pebble.position) + shift;
      EXPECT_NEAR(smallest_square_opening(turned) / opening, 1.0, 2e-8);
    }
  }
}

TEST(SmallestSquareOpening, ScalesWithTheClump) {
  std::vector<Pebble> large = irregular();
  for (Pebble& pebble : large) pebble = {pebble.position * 250.0, pebble.radius * 250.0};
  EXPECT_NEAR(smallest_square_opening(large) / smallest_square_opening(irregular()), 250.0, 1e-5);
}

}  // namespace
