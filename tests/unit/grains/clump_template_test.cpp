// SPDX-License-Identifier: BSD-3-Clause
// Clump templates: the shipped shapes against the table of the physics reference and Monte Carlo, and bad input.
#include "dem4grm/grains/clump_template.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/grains/clump_mass_properties.hpp"

namespace {

using namespace dem;

constexpr double k_pi = 3.14159265358979323846;

/// Row of the table in the physics reference, 5.3 (Monte Carlo of 1.5e6 points, +-0.3 %; radius of the largest pebble
/// 1). The sieve sizes of T3, T5 and T6 are not from there: the table has 2.447, 2.664 and 2.209, but its orientations
/// were not searched to the end. T3 and T5 have closed forms (clump_sieve_test.cpp), T6 is held by the scan of that
/// test.
struct TableRow {
  const char* name;
  double volume, sieve;
  std::array<double, 3> moments;  // over mass times the square of the volume-equivalent diameter
};
const std::array<TableRow, 6> k_table{{{"T1", 6.017, 2.000, {.0836, .1140, .1141}},
                                       {"T2", 5.026, 2.000, {.0844, .1145, .1145}},
                                       {"T3", 7.758, 2.42866, {.0963, .0965, .1191}},
                                       {"T4", 5.907, 2.000, {.0753, .1264, .1264}},
                                       {"T5", 9.276, 2.53033, {.1024, .1026, .1028}},
                                       {"T6", 5.686, 2.15333, {.0934, .1043, .1115}}}};

double largest_radius(const ClumpTemplate& shape) {
  double radius = 0.0;
  for (const Pebble& pebble : shape.pebbles) radius = std::max(radius, pebble.radius);
  return radius;
}

bool holds(const ClumpTemplate& shape, const Vec3& point) {
  return std::any_of(shape.pebbles.begin(), shape.pebbles.end(), [&](const Pebble& pebble) {
    const Vec3 d = point - pebble.position;
    return dot(d, d) <= pebble.radius * pebble.radius;
  });
}

std::string message_of(std::vector<Pebble> pebbles) {
  try {
    make_clump_template("bad", std::move(pebbles));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClumpTemplate, ShippedShapesMatchTheTable) {
  ASSERT_EQ(standard_clump_templates().size(), k_table.size());
  for (std::size_t i = 0; i < k_table.size(); ++i) {
    const ClumpTemplate& shape = standard_clump_templates()[i];
    SCOPED_TRACE(shape.name);
    EXPECT_EQ(shape.name, k_table[i].name);
    const double unit = 1.0 / largest_radius(shape);  // sieve size in units of the largest pebble
    EXPECT_NEAR(unit / k_table[i].sieve, 1.0, 1e-5);
    EXPECT_NEAR(shape.volume * unit * unit * unit / k_table[i].volume, 1.0, 0.003);
    const double diameter = std::cbrt(6.0 * shape.volume / k_pi);
    const Vec3 moments = shape.moment_of_inertia * (1.0 / (shape.volume * diameter * diameter));
    EXPECT_NEAR(moments.x / k_table[i].moments[0], 1.0, 0.003);
    EXPECT_NEAR(moments.y / k_table[i].moments[1], 1.0, 0.003);
    EXPECT_NEAR(moments.z / k_table[i].moments[2], 1.0, 0.003);
  }
}

TEST(ClumpTemplate, MonteCarloAgreesWithinItsStatisticalError) {
  const int n_points = 400'000;
  for (std::size_t s = 0; s < standard_clump_templates().size(); ++s) {
    const ClumpTemplate& shape = standard_clump_templates()[s];
    SCOPED_TRACE(shape.name);
    const double half = shape.bounding_radius, box = 8.0 * half * half * half;
    RandomSequence random(2024, RandomStream::monte_carlo, 100 + s);
    // Sums of f and f^2 over the points, f being zero outside the clump: 1, x, y, z, and the three moments.
    std::array<double, 7> sum{}, square{};
    for (int n = 0; n < n_points; ++n) {
      const Vec3 p{random.uniform(-half, half), random.uniform(-half, half), random.uniform(-half, half)};
      if (!holds(shape, p)) continue;
      const std::array<double, 7> f{
          1.0, p.x, p.y, p.z, p.y * p.y + p.z * p.z, p.x * p.x + p.z * p.z, p.x * p.x + p.y * p.y};
      for (std::size_t k = 0; k < f.size(); ++k) {
        sum[k] += f[k];
        square[k] += f[k] * f[k];
      }
    }
    const Vec3& moment = shape.moment_of_inertia;
    const std::array<double, 7> expected{shape.volume, 0.0, 0.0, 0.0, moment.x, moment.y, moment.z};
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double mean = sum[k] / n_points;
      const double error = box * std::sqrt((square[k] / n_points - mean * mean) / n_points);
      EXPECT_NEAR(box * mean, expected[k], 4.0 * error) << "integral " << k;
    }
  }
}

TEST(ClumpTemplate, PebblesLieInPrincipalAxesAboutTheCentroid) {
  for (const ClumpTemplate& shape : standard_clump_templates()) {
    SCOPED_TRACE(shape.name);
    const UnionProperties body = union_properties(shape.pebbles);
    const Vec3& moment = shape.moment_of_inertia;
    EXPECT_NEAR(body.volume / shape.volume, 1.0, 2e-5);
    EXPECT_NEAR(norm(body.centroid), 0.0, 1e-5);
    EXPECT_NEAR(body.inertia.xx / moment.x, 1.0, 3e-5);
    EXPECT_NEAR(body.inertia.yy / moment.y, 1.0, 3e-5);
    EXPECT_NEAR(body.inertia.zz / moment.z, 1.0, 3e-5);
    EXPECT_NEAR(body.inertia.xy / moment.z, 0.0, 3e-5);
    EXPECT_NEAR(body.inertia.xz / moment.z, 0.0, 3e-5);
    EXPECT_NEAR(body.inertia.yz / moment.z, 0.0, 3e-5);
    EXPECT_LE(moment.x, moment.y);
    EXPECT_LE(moment.y, moment.z);
    for (const Pebble& p : shape.pebbles) EXPECT_LE(norm(p.position) + p.radius, shape.bounding_radius * (1 + 1e-15));
  }
}

TEST(ClumpTemplate, SphereHasSieveSizeOne) {
  const ClumpTemplate* sphere = find_clump_template("sphere");
  ASSERT_NE(sphere, nullptr);
  EXPECT_DOUBLE_EQ(sphere->pebbles.at(0).radius, 0.5);
  EXPECT_DOUBLE_EQ(sphere->volume, k_pi / 6.0);
  EXPECT_DOUBLE_EQ(sphere->moment_of_inertia.x, k_pi / 60.0);
  EXPECT_DOUBLE_EQ(sphere->bounding_radius, 0.5);
}

TEST(ClumpTemplate, SumOfPebblesWouldCountTheOverlapTwice) {
  const std::array<double, 6> ratio{1.392, 1.260, 1.620, 1.580, 1.806, 2.293};  // physics reference, 5.3
  for (std::size_t i = 0; i < ratio.size(); ++i) {
    const ClumpTemplate& shape = standard_clump_templates()[i];
    double sum = 0.0;
    for (const Pebble& p : shape.pebbles) sum += 4.0 / 3.0 * k_pi * p.radius * p.radius * p.radius;
    EXPECT_NEAR(sum / shape.volume / ratio[i], 1.0, 0.003) << shape.name;
  }
}

TEST(ClumpTemplate, UnknownNamesAreNotFound) {
  EXPECT_EQ(find_clump_template("T7"), nullptr);
  EXPECT_EQ(find_clump_template("t1"), nullptr);
  EXPECT_EQ(find_clump_template("T4"), &standard_clump_templates()[3]);
}

TEST(ClumpTemplate, SameInputGivesTheSameBits) {
  const std::vector<Pebble> pebbles{{{0, 0, 0}, 1}, {{0.5, 0.1, 0}, 0.8}, {{0.05, -0.45, 0.1}, 0.78}};
  const ClumpTemplate a = make_clump_template("a", pebbles), b = make_clump_template("b", pebbles);
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.pebbles[1].position.y, b.pebbles[1].position.y);
}

TEST(ClumpTemplate, BadPebblesAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message_of({}), "clump shape 'bad': it has no pebbles");
  const std::string radii = message_of({{{0, 0, 0}, 1}, {{1, 0, 0}, 0}, {{0, 1, 0}, nan}, {{0, 0, inf}, 1}});
  EXPECT_EQ(radii.find("pebble 1 "), std::string::npos);
  EXPECT_NE(radii.find("pebble 2 has radius 0"), std::string::npos) << radii;
  EXPECT_NE(radii.find("pebble 3 has radius nan"), std::string::npos) << radii;
  EXPECT_NE(radii.find("pebble 4 has a position"), std::string::npos) << radii;
  EXPECT_NE(message_of({{{0, 0, 0}, inf}}).find("radius inf"), std::string::npos);
  EXPECT_NE(message_of({{{0, 0, 0}, -1}}).find("radius -1"), std::string::npos);
}

TEST(ClumpTemplate, PebblesMustHangTogether) {
  EXPECT_NE(message_of({{{0, 0, 0}, 1}, {{2.1, 0, 0}, 1}}).find("do not hang together"), std::string::npos);
  EXPECT_NE(message_of({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{9, 0, 0}, 1}, {{10, 0, 0}, 1}}).find("hang together"),
            std::string::npos);
  EXPECT_EQ(message_of({{{0, 0, 0}, 1}, {{2, 0, 0}, 1}}), "");                    // touching is enough
  EXPECT_EQ(message_of({{{0, 0, 0}, 1}, {{3, 0, 0}, 1}, {{1.5, 0, 0}, 1}}), "");  // over the third
}

TEST(ClumpTemplate, UselessPebblesAreNamed) {
  EXPECT_NE(message_of({{{0, 0, 0}, 1}, {{0.2, 0, 0}, 0.5}}).find("pebble 2 lies inside pebble 1"), std::string::npos);
  const std::string twins = message_of({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}});
  EXPECT_NE(twins.find("pebble 2 lies inside pebble 1"), std::string::npos);
  EXPECT_EQ(twins.find("pebble 1 lies"), std::string::npos);
}

}  // namespace
