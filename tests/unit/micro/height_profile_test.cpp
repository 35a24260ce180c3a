// SPDX-License-Identifier: BSD-3-Clause
// Profiles of states that are put together by hand: every number of every layer is known.
#include "dem4grm/micro/height_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem4grm/micro/rubber_strain.hpp"
#include "support/contact_builder.hpp"

namespace dem {
namespace {

using test::k_degree;

constexpr double k_gravel_radius = 2e-3;  // m, of the gravel spheres
constexpr double k_ball_radius = 0.6e-3;  // m, of the rubber
constexpr double k_box_height = 40e-3, k_box_area = 40e-3 * 40e-3;

double ball_volume(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

Quaternion turn_about_y(double angle) { return {std::cos(angle / 2), 0.0, std::sin(angle / 2), 0.0}; }

/// The 35 balls of a grain, turned and moved.
std::vector<Vec3> rubber_balls(const Quaternion& turn, const Vec3& centre) {
  std::vector<Vec3> balls;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    balls.push_back(centre + rotate(turn, grain_site(slot) * (k_grain_lattice * k_ball_radius)));
  }
  return balls;
}

/// One rubber grain at z = 5 mm and spheres of gravel at 15, 25, 26 and 35 mm, in a box of 40 mm.
ProfileState state_with(const Quaternion& rubber_turn, const std::vector<Quaternion>& turns,
                        const std::vector<Vec3>& moved) {
  ProfileState s;
  s.network.box = {0, 6, k_box_area, k_box_height};
  const Vec3 places[] = {
      {20e-3, 20e-3, 5e-3}, {10e-3, 10e-3, 15e-3}, {10e-3, 10e-3, 25e-3}, {30e-3, 30e-3, 26e-3}, {20e-3, 20e-3, 35e-3}};
  for (std::size_t body = 0; body < 5; ++body) {
    const Vec3 at = places[body] + moved[body];
    s.network.body_position.push_back(at);
    s.network.body_material.push_back(body == 0 ? k_rubber : k_gravel);
    s.orientation.push_back(body == 0 ? rubber_turn : turns[body - 1]);
    const std::vector<Vec3> balls = body == 0 ? rubber_balls(rubber_turn, at) : std::vector<Vec3>{at};
    for (const Vec3& ball : balls) {
      s.packing.position.push_back(ball);
      s.packing.radius.push_back(body == 0 ? k_ball_radius : k_gravel_radius);
      s.packing.body.push_back(static_cast<int>(body));
    }
  }
  s.packing.n_rubber_grains = 1;
  return s;
}

ProfileState state_at_rest() { return state_with({}, {{}, {}, {}, {}}, std::vector<Vec3>(5)); }

ProfileState sheared_state() {
  // Moved by 8, 6, 4, 2 and 1 mm along x, the topmost by 0.5 mm up; turned about y by -30 (rubber), -20, 10, -50 and 0.
  std::vector<Vec3> moved{{8e-3, 0, 0}, {6e-3, 0, 0}, {4e-3, 0, 0}, {2e-3, 0, 0}, {1e-3, 0, 0.5e-3}};
  ProfileState s = state_with(turn_about_y(-30 * k_degree),
                              {turn_about_y(-20 * k_degree),
                               turn_about_y(10 * k_degree),
                               turn_about_y(-50 * k_degree),
                               {std::sqrt(0.5), std::sqrt(0.5), 0, 0}},
                              moved);
  s.displacement = 8e-3;
  const auto touch = [&](double z, double force) {
    Contact c = test::plane_contact(90 * k_degree, force, 0.0);
    c.point = {20e-3, 20e-3, z};
    s.network.contacts.push_back(c);
  };
  touch(2e-3, 1.0), touch(3e-3, 9.0), touch(21e-3, 1.0), touch(39e-3, 9.0);  // mean 5
  return s;
}

StateProfile profile_of(const ProfileState& now, int layers = 4) {
  return height_profile(state_at_rest(), now, {.layers = layers, .mean_size = 4e-3, .rubber_fill = 1.4});
}

TEST(HeightProfile, MeansOfDisplacementAndRotation) {
  const StateProfile p = profile_of(sheared_state());
  ASSERT_EQ(p.layers.size(), 4U);
  const double grains[] = {1, 1, 2, 1}, ux[] = {8e-3, 6e-3, 3e-3, 1e-3}, turn[] = {-30, -20, -20, 0};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(p.layers[k].low, 10e-3 * static_cast<double>(k), 1e-15);
    EXPECT_NEAR(p.layers[k].high, 10e-3 * static_cast<double>(k + 1), 1e-15);
    EXPECT_EQ(p.layers[k].grains, grains[k]);
    EXPECT_NEAR(p.layers[k].displacement_x, ux[k], 1e-15);
    EXPECT_NEAR(p.layers[k].rotation, turn[k] * k_degree, 1e-12);
  }
  EXPECT_NEAR(p.layers[3].displacement_z, 0.5e-3, 1e-15);
  EXPECT_NEAR(p.layers[2].rotation_size, 30 * k_degree, 1e-12);  // of 10 and 50
  EXPECT_NEAR(p.layers[3].rotation_size, 90 * k_degree, 1e-12);  // about x
  EXPECT_NEAR(p.layers[0].rotation_rubber, -30 * k_degree, 1e-12);
  EXPECT_TRUE(std::isnan(p.layers[0].rotation_gravel));
  EXPECT_NEAR(p.layers[1].rotation_gravel, -20 * k_degree, 1e-12);
  EXPECT_TRUE(std::isnan(p.layers[1].rotation_rubber));
}

TEST(HeightProfile, SolidIsCutAtTheBordersOfTheLayers) {
  const double layer = k_box_area * 10e-3, rubber = 1.4 * k_grain_balls * ball_volume(k_ball_radius),
               gravel = ball_volume(k_gravel_radius);
  const StateProfile p = profile_of(state_at_rest());
  EXPECT_NEAR(p.layers[0].void_ratio, layer / rubber - 1, 0.02 * layer / rubber);
  EXPECT_EQ(p.layers[0].rubber_content, 1.0);
  EXPECT_NEAR(p.layers[2].void_ratio, layer / (2 * gravel) - 1, 0.01 * layer / gravel);
  EXPECT_EQ(p.layers[2].rubber_content, 0.0);
  // Eight layers of 5 mm: the sphere at 26 mm is cut at 25, where another has its middle.
  const StateProfile fine = profile_of(state_at_rest(), 8);
  const double cap =
      std::numbers::pi * 1e-3 * 1e-3 * (3 * k_gravel_radius - 1e-3) / 3.0;  // 1 mm high: pi h^2 (3 R - h) / 3
  EXPECT_NEAR(fine.layers[4].void_ratio, 0.5 * layer / (0.5 * gravel + cap) - 1, 0.02 * 0.5 * layer / gravel);
  // What the halves carry out of the box counts: the lower half has moved by 38 mm.
  std::vector<Vec3> far(5, Vec3{38e-3, 0, 0});
  const StateProfile moved = profile_of(state_with({}, {{}, {}, {}, {}}, far));
  EXPECT_NEAR(moved.layers[2].void_ratio, p.layers[2].void_ratio, 0.02 * p.layers[2].void_ratio);
}

TEST(HeightProfile, ContactsAboveTheMeanOfAllAreStrong) {
  const StateProfile p = profile_of(sheared_state());
  const double contacts[] = {2, 0, 1, 1}, strong[] = {0.5, 0, 0.0, 1.0};
  for (const std::size_t k : {0U, 2U, 3U}) {
    EXPECT_EQ(p.layers[k].contacts, contacts[k]);
    EXPECT_EQ(p.layers[k].strong_share, strong[k]);
  }
  EXPECT_EQ(p.layers[1].contacts, 0.0);
  EXPECT_TRUE(std::isnan(p.layers[1].strong_share));
}

TEST(HeightProfile, DefaultIsOneLayerForEachMeanSizeButFourAtLeast) {
  EXPECT_EQ(profile_of(state_at_rest(), 0).layers.size(), 10U);
  const ProfileState s = state_at_rest();
  EXPECT_EQ(height_profile(s, s, {.layers = 0, .mean_size = 30e-3, .rubber_fill = 1.4}).layers.size(), 4U);
}

TEST(GrainOrientation, IsTheRotationWithoutTheStretch) {
  for (const double angle : {-150.0, -20.0, 0.0, 75.0}) {
    const Quaternion turn = turn_about_y(angle * k_degree);
    std::vector<Vec3> balls;
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const Vec3 site = grain_site(slot) * (k_grain_lattice * k_ball_radius);
      balls.push_back(rotate(turn, {1.1 * site.x, site.y, 0.7 * site.z}) + Vec3{1, 2, 3});
    }
    const Vec3 found = rotation_between({}, grain_orientation(balls, 2 * k_ball_radius));
    EXPECT_NEAR(found.x, 0.0, 1e-12);
    EXPECT_NEAR(found.y, angle * k_degree, 1e-12);
    EXPECT_NEAR(found.z, 0.0, 1e-12);
  }
}

TEST(RotationBetween, IsTheShorterWayWhateverTheSignsOfTheQuaternions) {
  const Quaternion from = turn_about_y(170 * k_degree), to = turn_about_y(-170 * k_degree);
  EXPECT_NEAR(rotation_between(from, to).y, 20 * k_degree, 1e-12);
  EXPECT_NEAR(rotation_between(from, {-to.w, -to.x, -to.y, -to.z}).y, 20 * k_degree, 1e-12);
  EXPECT_EQ(norm(rotation_between(from, from)), 0.0);
}

}  // namespace
}  // namespace dem
