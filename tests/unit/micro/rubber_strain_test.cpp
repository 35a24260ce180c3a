// SPDX-License-Identifier: BSD-3-Clause
// Volume, shape and bonds of rubber grains that are deformed by hand.
#include "dem4grm/micro/rubber_strain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/random.hpp"
#include "support/scene_builder.hpp"

namespace dem {
namespace {

constexpr double k_radius = 0.63e-3;
constexpr double k_a = k_grain_lattice * k_radius;

/// The balls of a grain at rest, moved by a map.
template <class Map>
std::vector<Vec3> grain_after(const Map& map) {
  std::vector<Vec3> balls;
  balls.reserve(k_grain_balls);
  for (int slot = 0; slot < k_grain_balls; ++slot) balls.push_back(map(grain_site(slot) * k_a));
  return balls;
}

TEST(GrainShape, AtRestIsTheCubeOfTwoCells) {
  const auto balls = grain_after([](const Vec3& x) { return x + Vec3{0.1, 0.2, 0.3}; });
  EXPECT_NEAR(grain_volume(balls) / std::pow(2 * k_a, 3), 1.0, 1e-12);
  EXPECT_NEAR(grain_aspect_ratio(balls), 1.0, 1e-10);
  EXPECT_EQ(closed_second_neighbours(balls, 2 * k_radius), 0);
}

TEST(GrainShape, AffineDeformationScalesVolumeAndAxes) {
  // Compressed to 0.8 along an inclined axis: determinant 0.8, axes 1 : 1/0.8.
  const Vec3 axis = Vec3{1, 2, -2} * (1.0 / 3.0);
  const auto squeezed = grain_after([&](const Vec3& x) { return x - axis * (0.2 * dot(x, axis)); });
  EXPECT_NEAR(grain_volume(squeezed) / std::pow(2 * k_a, 3), 0.8, 1e-12);
  EXPECT_NEAR(grain_aspect_ratio(squeezed), 1.25, 1e-12);
  const auto sheared = grain_after([](const Vec3& x) { return Vec3{x.x + 0.3 * x.z, x.y, x.z}; });
  EXPECT_NEAR(grain_volume(sheared) / std::pow(2 * k_a, 3), 1.0, 1e-12);
  // Left stretch of simple shear g: largest over smallest is ((g + sqrt(g^2 + 4)) / 2)^2.
  EXPECT_NEAR(grain_aspect_ratio(sheared), std::pow((0.3 + std::sqrt(4.09)) / 2, 2), 1e-12);
  const auto turned_inside_out = grain_after([](const Vec3& x) { return Vec3{-x.x, x.y, x.z}; });
  EXPECT_LT(grain_volume(turned_inside_out), 0.0);
}

TEST(GrainShape, OneCornerMoves) {
  // Trilinear cell with the corner (1,1,1) moved by d: det(1 + d x grad(xyz)) = 1 + d . grad(xyz), each mean slope 1/4.
  const Vec3 d{0.3, -0.1, 0.2};
  auto balls = grain_after([](const Vec3& x) { return x; });
  balls[26] += d * k_a;
  EXPECT_NEAR(grain_volume(balls) / std::pow(k_a, 3), 8.0 + (0.3 - 0.1 + 0.2) / 4, 1e-12);
  // The ball amid the face z = +a (slot 22) is a corner of four outer faces: moved out by d it adds four cells' d/4.
  balls = grain_after([](const Vec3& x) { return x; });
  balls[22].z += 0.2 * k_a;
  EXPECT_NEAR(grain_volume(balls) / std::pow(k_a, 3), 8.0 + 4 * 0.2 / 4, 1e-12);
}

TEST(GrainShape, SecondNeighboursCloseAtThirteenPercent) {
  // a = 2.309 r: pairs along x touch once a shrinks to 2 r, 18 pairs of corners and 4 of centres.
  for (const auto& [factor, expected] : {std::pair{0.867, 0}, std::pair{0.865, 22}}) {
    const auto balls = grain_after([f = factor](const Vec3& x) { return Vec3{f * x.x, x.y, x.z}; });
    EXPECT_EQ(closed_second_neighbours(balls, 2 * k_radius), expected);
  }
}

TEST(RubberReport, AveragesOverBondsAndGrains) {
  RubberState state;
  for (const double f : {0.9, 1.2}) {  // the second grain is a larger one at rest
    const auto balls = grain_after([f](const Vec3& x) { return x * f; });
    state.rest_length.push_back(2.0 * k_radius * std::max(1.0, f));
    state.ball_position.insert(state.ball_position.end(), balls.begin(), balls.end());
  }
  // Strains 0.1 in the first grain, 0 in the second, and one bond torn: it counts for nothing.
  for (int b = 0; b < 128; ++b) {
    state.bond_length.push_back(b < 64 ? 0.9 * state.rest_length[0] : state.rest_length[1]);
    state.bond_normal_force.push_back(b % 2 == 0 ? 3.0 : -1.0);
    state.bond_shear_force.push_back(0.0);
    state.bond_moment.push_back(2e-6);
    state.is_broken.push_back(b == 0 ? 1 : 0);
  }
  state.bond_length[0] = 100.0;
  const RubberReport r = rubber_report(state);
  EXPECT_NEAR(r.bond_strain.mean, 0.1 * 63 / 127, 1e-12);
  EXPECT_NEAR(r.bond_strain.deviation, 0.1 * std::sqrt(63.0 * 64.0) / 127, 1e-12);
  EXPECT_NEAR(r.bond_strain.p05, 0.0, 1e-12);
  EXPECT_NEAR(r.bond_strain.p95, 0.1, 1e-12);
  // 63 whole bonds of the first grain are shorter by a tenth, the 64 of the other as at rest or longer.
  EXPECT_NEAR(r.bond_strain_compressed, 0.1, 1e-12);
  EXPECT_NEAR(r.bonds_compressed, 63.0 / 127, 1e-12);
  ASSERT_EQ(r.grain_bond_strain.size(), 2U);
  EXPECT_NEAR(r.grain_bond_strain[0], 0.1, 1e-12);
  EXPECT_NEAR(r.grain_bond_strain[1], 0.0, 1e-12);
  EXPECT_NEAR(r.bond_force, (63 * 3.0 - 64.0) / 127, 1e-12);
  EXPECT_NEAR(r.bond_force_size, (63 * 3.0 + 64.0) / 127, 1e-12);
  EXPECT_NEAR(r.bond_moment, 2e-6, 1e-18);
  EXPECT_NEAR(r.volume_strain.mean, 0.5 * (1 - 0.729), 1e-12);
  EXPECT_NEAR(r.aspect_ratio.mean, 1.0, 1e-10);
  EXPECT_TRUE(std::isnan(rubber_report({}).bond_strain.mean));
}

TEST(GrainDeformation, IsFoundWhateverTheGrainsTurnAndPlace) {
  // Squeezed by 20 % along an axis of its own, swollen by 5 % across, sheared, turned by 40 degrees about y and moved.
  const double turn = 40 * test::k_pi / 180, c = std::cos(turn), s = std::sin(turn);
  const auto map = [&](const Vec3& x) {
    const Vec3 y{1.05 * x.x + 0.1 * x.z, 1.05 * x.y, 0.8 * x.z};
    return Vec3{c * y.x + s * y.z, y.y, c * y.z - s * y.x} + Vec3{0.3, -0.2, 0.1};
  };
  const Tensor3 f = deformation_of(grain_after(map), 2 * k_radius);
  const double expected[] = {1.05 * c, 0, 0.1 * c + 0.8 * s, 0, 1.05, 0, -1.05 * s, 0, 0.8 * c - 0.1 * s};
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(f.value[k], expected[k], 1e-12) << k;
  EXPECT_NEAR(strain_along(f, {0, 1, 0}), -0.05, 1e-12);
  // The line that was along x lies along (cos, 0, -sin) now, and is 5 % longer.
  EXPECT_NEAR(strain_along(f, {c, 0, -s}), -0.05, 1e-12);
  // The line that was along z: 0.1 and 0.8 of it turned, so it is sqrt(0.65) long.
  const double x = 0.1 * c + 0.8 * s, z = 0.8 * c - 0.1 * s, length = std::hypot(x, z);
  EXPECT_NEAR(length, std::sqrt(0.65), 1e-12);
  EXPECT_NEAR(strain_along(f, {x / length, 0, z / length}), 1 - std::sqrt(0.65), 1e-12);
}

TEST(GrainDeformation, MeanOverGrainsAlongADirection) {
  RubberState state;
  for (const double squeeze : {0.9, 0.7}) {
    const std::vector<Vec3> grain = grain_after([&](const Vec3& x) { return Vec3{x.x, x.y, squeeze * x.z}; });
    state.ball_position.insert(state.ball_position.end(), grain.begin(), grain.end());
    state.rest_length.push_back(2 * k_radius);
  }
  EXPECT_NEAR(mean_strain_along(state, {0, 0, 1}), 0.2, 1e-12);
  EXPECT_NEAR(mean_strain_along(state, {1, 0, 0}), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(mean_strain_along({}, {0, 0, 1})));
}

TEST(NeighbourStrains, EveryTouchingPairCountsOnce) {
  // Rubber grains 0, 1, 2 and gravel 3, 4. Grain 0 touches 3 twice, 4 and 1; grain 1 touches 0 and 3; grain 2 nothing.
  ContactNetwork network;
  network.body_material = {k_rubber, k_rubber, k_rubber, k_gravel, k_gravel};
  const auto join = [&](int i, int j) {
    Contact c;
    c.body_i = i;
    c.body_j = j;
    network.contacts.push_back(c);
  };
  join(0, 3), join(3, 0), join(4, 0), join(0, 1), join(1, 3), join(3, 4);
  const double strain[] = {0.3, 0.1, 0.9};
  const NeighbourStrain found = strain_by_neighbour(strain, network);
  EXPECT_NEAR(found.at_gravel, (0.3 + 0.3 + 0.1) / 3, 1e-15);  // 0-3, 0-4, 1-3
  EXPECT_NEAR(found.at_rubber, (0.3 + 0.1) / 2, 1e-15);        // 0-1 from both sides
  EXPECT_TRUE(std::isnan(strain_by_neighbour({}, network).at_gravel));
}

TEST(RubberReport, ReadsASimulation) {
  // A uniform compression by hand: every bond 5 % shorter.
  Scene scene = test::model_scene();
  scene.grains = {{{0, 0, 0}, {}}, {{0.02, 0, 0}, RandomSequence(1, RandomStream::test, 0).orientation()}};
  Simulation s(scene);
  for (int g = 0; g < 2; ++g) {
    const Vec3 centre{0.02 * g, 0, 0};
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const int i = BallStore::rubber_index(g, slot);
      s.balls.set_position(i, centre + (s.balls.position(i) - centre) * 0.95);
    }
  }
  const RubberState state = rubber_state_of(s);
  EXPECT_EQ(state.n_grains(), 2U);
  const RubberReport r = rubber_report(state);
  EXPECT_NEAR(r.bond_strain.mean, 0.05, 1e-12);
  EXPECT_NEAR(r.bond_strain.p95, 0.05, 1e-12);
  EXPECT_NEAR(r.volume_strain.mean, 1 - std::pow(0.95, 3), 1e-12);
  // Bond and linear spring, each E pi r^2 / 2r times the shortening 0.05 * 2r: E pi r^2 * 0.05 * 2.
  EXPECT_NEAR(r.bond_force, 2 * 20e6 * test::k_pi * k_radius * k_radius * 0.05, 1e-6);
}

TEST(Distributions, OfKnownNumbers) {
  std::vector<double> values;
  for (int k = 100; k >= 0; --k) values.push_back(k);
  const Distribution d = distribution_of(values);
  EXPECT_EQ(d.mean, 50.0);
  EXPECT_NEAR(d.deviation, std::sqrt((101.0 * 101.0 - 1) / 12), 1e-12);
  EXPECT_EQ(d.p05, 5.0);
  EXPECT_EQ(d.p50, 50.0);
  EXPECT_EQ(d.p95, 95.0);
}

}  // namespace
}  // namespace dem
