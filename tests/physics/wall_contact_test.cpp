// SPDX-License-Identifier: BSD-3-Clause
// Balls at walls made of several rectangles: seams are not felt, edges and corners count once, corners that open
// inwards count for both faces, walls move and have friction of their own.
//
// Expected: the force of one large rectangle; plain geometry with the Hertz force of gravel on wall, 1.531458 N at 20
// um.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_sphere_radius = 2.5e-3, k_depth = 20e-6, k_force = 1.531458;

/// One gravel ball among the walls, placed by hand.
struct Probe {
  Simulation s;
  explicit Probe(const std::vector<Wall>& walls, double friction = 1.0) : s(make_scene(walls, friction)) {
    s.set_time_step(1e-6);
  }
  static Scene make_scene(const std::vector<Wall>& walls, double friction) {
    Scene scene = model_scene();
    scene.gravel.friction = friction;
    scene.wall_list = walls;
    add_sphere(scene, {0, 0, 1.0}, k_sphere_radius);
    return scene;
  }
  /// Net force on the ball after it was moved there in one step.
  Vec3 force_at(const Vec3& to) {
    s.balls.set_velocity(0, (to - s.balls.position(0)) * (1.0 / s.time_step()));
    s.balls.set_position(0, to);
    s.invalidate_candidates();
    refresh_candidates(s);
    evaluate_wall_contacts(s);
    Vec3 sum, reactions;
    for (std::size_t c = 0; c < s.contacts.wall_pairs.size(); ++c)
      sum += s.contacts.force(s.contacts.n_pair_rows() + c);
    for (const WallReaction& r : s.reactions) reactions += r.force;
    EXPECT_LT(norm(sum + reactions), 1e-12 * k_force);  // the walls feel the opposite
    return sum;
  }
  void start_at(const Vec3& to) {
    s.balls.set_position(0, to + Vec3{0, 0, 0.5});
    force_at(to + Vec3{0, 0, 0.5});
    s.balls.set_position(0, to);  // no motion, no shear
    force_at(to);
  }
  [[nodiscard]] int contacts() const {
    int n = 0;
    for (const WallReaction& r : s.reactions) n += r.contacts;
    return n;
  }
};

std::vector<Wall> whole_floor(double friction) {
  std::vector<Wall> w{make_wall("whole", {-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0})};
  w[0].friction = friction;
  return w;
}

/// The same floor cut at x = 0; `flip` walks the second piece the other way round, so that two far ends meet.
std::vector<Wall> cut_floor(double friction, bool flip) {
  std::vector<Wall> w{make_wall("left", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0})};
  w.push_back(flip ? make_wall("right", {0.1, 0.1, 0}, {-0.1, 0, 0}, {0, -0.2, 0})
                   : make_wall("right", {0, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}));
  for (Wall& wall : w) wall.friction = friction;
  return w;
}

class Seam : public ::testing::TestWithParam<std::tuple<bool, double>> {};

TEST_P(Seam, IsNotFeltAtAnyPosition) {
  const auto [flip, friction] = GetParam();
  Probe one(whole_floor(friction)), two(cut_floor(friction, flip));
  // Across the seam and back, through x = 0 exactly, in steps that stay below slip at 0.7 for the first stretch.
  const Vec3 start{-3e-3, 0, k_sphere_radius - k_depth};
  one.start_at(start);
  two.start_at(start);
  std::vector<double> path;
  for (int k = -300; k <= 300; ++k) path.push_back(k * 1e-5);
  for (int k = 300; k >= -300; --k) path.push_back(k * 1e-5 * 0.999);
  for (int k = -20; k <= 20; ++k) path.push_back(k * 1e-7);  // slowly, sticking, through zero
  for (const double x : path) {
    const Vec3 to{x, 0.3 * x, k_sphere_radius - k_depth};
    const Vec3 a = one.force_at(to), b = two.force_at(to);
    ASSERT_LT(norm(a - b), 1e-9 * norm(a))
        << "x = " << x << " whole " << a.x << ' ' << a.z << " cut " << b.x << ' ' << b.z;
    ASSERT_EQ(two.contacts(), 1) << "x = " << x;
  }
}

INSTANTIATE_TEST_SUITE_P(Pieces, Seam, ::testing::Combine(::testing::Bool(), ::testing::Values(0.0, 0.7)));

TEST(Seam, WhereFourPiecesMeet) {
  std::vector<Wall> walls;
  for (const double x : {-0.1, 0.0}) {
    for (const double y : {-0.1, 0.0}) walls.push_back(make_wall("piece", {x, y, 0}, {0.1, 0, 0}, {0, 0.1, 0}));
  }
  Probe four(walls);
  for (const Vec3& at :
       {Vec3{0, 0, 0}, Vec3{1e-5, 0, 0}, Vec3{0, -1e-5, 0}, Vec3{1e-4, 1e-4, 0}, Vec3{-1e-9, 1e-9, 0}}) {
    const Vec3 f = four.force_at(at + Vec3{0, 0, k_sphere_radius - k_depth});
    EXPECT_NEAR(f.z, k_force, 1e-6 * k_force) << at.x << ' ' << at.y;
    EXPECT_NEAR(f.x, 0.0, 1e-9);
    EXPECT_EQ(four.contacts(), 1);
  }
}

TEST(ConvexEdge, OfTwoWallsCountsOnceAlongTheLineToTheBall) {
  // A block's top (z = 0, x < 0) and side (x = 0, z < 0): the ball sits off the edge at 30 degrees.
  Probe p({make_wall("top", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}),
           make_wall("side", {0, -0.1, -0.1}, {0, 0.2, 0}, {0, 0, 0.1})});
  const double a = k_pi / 6, distance = k_sphere_radius - k_depth;
  const Vec3 f = p.force_at({distance * std::sin(a), 0.01, distance * std::cos(a)});
  EXPECT_EQ(p.contacts(), 1);
  EXPECT_NEAR(f.x, k_force * std::sin(a), 1e-6);
  EXPECT_NEAR(f.z, k_force * std::cos(a), 1e-6);
  // Seen by one face only: the edge of the other lies on it.
  EXPECT_NEAR(p.force_at({-1e-3, 0.01, distance}).z, k_force, 1e-6);
  EXPECT_EQ(p.contacts(), 1);
}

TEST(ConvexCorner, OfThreeWallsCountsOnce) {
  Probe p({make_wall("top", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.1, 0}),
           make_wall("side x", {0, -0.1, -0.1}, {0, 0.1, 0}, {0, 0, 0.1}),
           make_wall("side y", {-0.1, 0, -0.1}, {0, 0, 0.1}, {0.1, 0, 0})});
  const double c = (k_sphere_radius - k_depth) / std::sqrt(3.0);
  const Vec3 f = p.force_at({c, c, c});
  EXPECT_EQ(p.contacts(), 1);
  for (const double part : {f.x, f.y, f.z}) EXPECT_NEAR(part, k_force / std::sqrt(3.0), 1e-6);
}

TEST(ConcaveCorner, BothFacesPush) {
  Probe p({make_wall("floor", {0, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}),
           make_wall("wall", {0, -0.1, 0}, {0, 0.2, 0}, {0, 0, 0.1})});
  const Vec3 f = p.force_at({k_sphere_radius - k_depth, 0, k_sphere_radius - k_depth * std::pow(2.0, 2.0 / 3.0)});
  EXPECT_EQ(p.contacts(), 2);
  EXPECT_NEAR(f.x, k_force, 1e-6);
  EXPECT_NEAR(f.z, 2 * k_force, 1e-6);
}

TEST(ConcaveCorner, ThreeFacesPush) {
  Probe p(closed_box({0.1, 0.1, 0.1}));
  const double c = k_sphere_radius - k_depth;
  const Vec3 f = p.force_at({c, c, c});
  EXPECT_EQ(p.contacts(), 3);
  for (const double part : {f.x, f.y, f.z}) EXPECT_NEAR(part, k_force, 1e-6);
}

TEST(FreeEdge, PushesAlongTheLineAndCarriesFriction) {
  Probe p(whole_floor(0.5));
  const double a = 0.7, d = k_sphere_radius - k_depth;
  const Vec3 at{0.1 + d * std::sin(a), 0, d * std::cos(a)};
  p.start_at(at);
  const Vec3 f = p.force_at(at);
  EXPECT_NEAR(f.x, k_force * std::sin(a), 1e-6);
  EXPECT_NEAR(f.z, k_force * std::cos(a), 1e-6);
  // Along the edge: k_s times the slide, against the motion. k_s of gravel on wall at 20 um is 9.459451e4 N/m.
  const Vec3 g = p.force_at(at + Vec3{0, 1e-6, 0});
  EXPECT_NEAR(g.y, -9.459451e4 * 1e-6, 1e-6);
}

TEST(MovingWall, DragsAndPushes) {
  // The wall goes sideways under a ball that stands still: friction follows the wall; then it comes closer.
  std::vector<Wall> floor = whole_floor(0.7);
  Probe p(floor);
  p.start_at({0, 0, k_sphere_radius - k_depth});
  p.s.balls.set_velocity(0, {});
  p.s.last_wall_velocity[0] = {0.5, 0, 0};
  evaluate_wall_contacts(p.s);
  EXPECT_NEAR(-p.s.reactions[0].force.x, 9.459451e4 * 0.5e-6, 1e-6);  // on the ball: along the wall's motion
  p.s.last_wall_velocity[0] = {50.0, 0, 0};
  for (int k = 0; k < 3; ++k) evaluate_wall_contacts(p.s);
  EXPECT_NEAR(-p.s.reactions[0].force.x, 0.7 * k_force, 1e-5);  // slips
  p.s.walls[0].corner.z += k_depth;
  evaluate_wall_contacts(p.s);
  EXPECT_NEAR(-p.s.reactions[0].force.z, k_force * std::pow(2.0, 1.5), 1e-5);
}

TEST(MovingWall, CarriesABallThroughTheEngine) {
  Scene scene = model_scene();
  scene.wall_list = {make_wall("pusher", {0, -1, -1}, {0, 2, 0}, {0, 0, 2})};
  add_sphere(scene, {k_sphere_radius, 0, 0}, k_sphere_radius);
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.walls[0].velocity = {0.1, 0, 0};
  run_steps(s, 5000);
  // An elastic ball hit by a moving wall flies off at twice its speed; the wall did exactly that work.
  EXPECT_NEAR(clump(s, 0).velocity.x, 0.2, 2e-4);
  EXPECT_NEAR(s.walls[0].corner.x, 0.1 * 5e-3, 1e-12);
  EXPECT_NEAR(s.energy().boundary_work, 0.5 * clump(s, 0).mass * 0.04, 1e-3 * s.energy().boundary_work);
}

TEST(PlateFriction, IsTheSmallerOfGrainAndWall) {
  for (const auto& [grain, wall, expected] : {std::tuple{0.72, 0.70, 0.70}, {0.27, 0.70, 0.27}, {0.72, 0.0, 0.0}}) {
    Probe p(whole_floor(wall), grain);
    p.start_at({0, 0, k_sphere_radius - k_depth});
    for (int k = 1; k < 30; ++k) p.force_at({k * 5e-6, 0, k_sphere_radius - k_depth});
    const Vec3 f = p.force_at({150e-6, 0, k_sphere_radius - k_depth});
    EXPECT_NEAR(f.x, -expected * k_force, 1e-5);
  }
  // A friction table of a stage caps the grain's side.
  Probe p(whole_floor(0.70), 0.72);
  FrictionTable table = p.s.material_friction();
  table.against_walls = {0.1, 0.1};
  p.s.set_friction(table);
  p.start_at({0, 0, k_sphere_radius - k_depth});
  for (int k = 1; k < 30; ++k) p.force_at({k * 5e-6, 0, k_sphere_radius - k_depth});
  EXPECT_NEAR(p.force_at({150e-6, 0, k_sphere_radius - k_depth}).x, -0.1 * k_force, 1e-5);
}

}  // namespace
