// SPDX-License-Identifier: BSD-3-Clause
// The watchdog names what is wrong, and the numbers that describe a state are what they say.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/engine/observe.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

const std::array k_room{Bounds{{-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}}};

/// A rubber grain, a T1 clump and a sphere, all apart, over a floor.
Simulation three_bodies() {
  Scene scene = model_scene();
  scene.grains = {{{0, 0, 0}, {}}};
  scene.shapes = {*find_clump_template("T1")};
  scene.clumps = {{0, 5e-3, {{0.02, 0, 0}, {}}, k_gravel}};
  add_sphere(scene, {-0.02, 0, 0}, 2e-3);
  scene.wall_list = {make_wall("floor", {-1, -1, -0.04}, {2, 0, 0}, {0, 2, 0})};
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.step();
  return s;
}

bool names(const Trouble& trouble, const std::string& what) { return trouble.text.find(what) != std::string::npos; }

TEST(Watchdog, IsSilentWhenAllIsWell) { EXPECT_EQ(find_trouble(three_bodies(), k_room, 0.5).kind, TroubleKind::none); }

TEST(Watchdog, NamesWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  Simulation s = three_bodies();
  s.balls.at(BallComponent::x, BallStore::rubber_index(0, 20)) = nan;
  EXPECT_TRUE(
      names(find_trouble(s, k_room, 0.5), "rubber grain 0, ball 20 has a position or velocity that is no number"));
  s = three_bodies();
  s.balls.at(BallComponent::vy, s.balls.pebble_index(1)) = infinite;
  EXPECT_TRUE(names(find_trouble(s, k_room, 0.5), "clump 0, pebble 1"));
  s = three_bodies();
  s.balls.at(BallComponent::wz, s.balls.pebble_index(2)) = nan;
  EXPECT_TRUE(names(find_trouble(s, k_room, 0.5), "clump 1, pebble 0"));
}

TEST(Watchdog, NamesTheOneThatLeft) {
  for (const Vec3& away : {Vec3{0.051, 0, 0}, Vec3{0, -0.051, 0}, Vec3{0, 0, 1e9}}) {
    Simulation s = three_bodies();
    s.balls.set_position(s.balls.pebble_index(2), away);
    const Trouble found = find_trouble(s, k_room, 0.5);
    EXPECT_TRUE(names(found, "clump 1, pebble 0 left the box")) << found.text;
    EXPECT_EQ(found.kind, TroubleKind::outside);
    EXPECT_EQ(norm(found.place - away), 0.0);
    EXPECT_EQ(count_lost_bodies(s, k_room), 1);
  }
  EXPECT_EQ(count_lost_bodies(three_bodies(), k_room), 0);
}

TEST(Watchdog, NamesTheDeepestOverlapOfTwoGrains) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2e-3);
  add_sphere(scene, {2.6e-3, 0, 0}, 1e-3);  // 0.4 mm: 0.4 of the smaller radius
  add_sphere(scene, {0, 3.9e-3, 0}, 2e-3);  // 0.05
  Simulation s(scene);
  s.set_time_step(1e-9);
  s.step();
  EXPECT_EQ(find_trouble(s, k_room, 0.45).text, "");
  const Trouble text = find_trouble(s, k_room, 0.3);
  EXPECT_TRUE(names(text, "clump 0, pebble 0") && names(text, "clump 1, pebble 0") && names(text, "0.40")) << text.text;
  const OverlapReport report = worst_overlap(s);
  EXPECT_NEAR(report.largest, 0.4, 1e-4);
  EXPECT_EQ(report.caught, 0);
  // The centre of the small ball inside the large one.
  s.balls.set_position(s.balls.pebble_index(1), {1.9e-3, 0, 0});
  EXPECT_EQ(worst_overlap(s).caught, 1);
}

TEST(Watchdog, NamesTheWall) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 1.2e-3}, 2e-3);
  scene.wall_list = {make_wall("bottom plate", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  Simulation s(scene);
  s.set_time_step(1e-9);
  s.step();
  const Trouble text = find_trouble(s, k_room, 0.3);
  EXPECT_TRUE(names(text, "bottom plate") && names(text, "clump 0, pebble 0") && names(text, "0.40")) << text.text;
}

TEST(Alignment, IsSixTenthsAtRandomAndOneWhenSquare) {
  Scene scene = model_scene();
  RandomSequence random(4, RandomStream::test, 0);
  for (int k = 0; k < 800; ++k) scene.grains.push_back({{0.02 * k, 0, 0}, random.orientation()});
  // Fourth moments of a random direction: 3/5 by the sphere average of x^4 = 1/5. The scatter of one grain is 0.14.
  EXPECT_NEAR(rubber_alignment(Simulation(scene)), 0.6, 4 * 0.14 / std::sqrt(800.0));
  scene.grains = {{{0, 0, 0}, {}}, {{0.02, 0, 0}, normalized({1, 1, 0, 0})}};  // a quarter turn is square as well
  EXPECT_NEAR(rubber_alignment(Simulation(scene)), 1.0, 1e-12);
  scene.grains = {{{0, 0, 0}, normalized({std::cos(k_pi / 8), 0, 0, std::sin(k_pi / 8)})}};  // 45 degrees about z
  EXPECT_NEAR(rubber_alignment(Simulation(scene)), 2.0 / 3.0, 1e-12);                        // (1/2 + 1/2 + 1) / 3
}

TEST(Alignment, CountsClumpsOfRubberAndNothingElse) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2e-3);
  EXPECT_EQ(rubber_alignment(Simulation(scene)), 0.0);
  add_sphere(scene, {0.01, 0, 0}, 2e-3, k_rubber);
  EXPECT_NEAR(rubber_alignment(Simulation(scene)), 1.0, 1e-12);
}

TEST(BalanceOfForces, OfThreeBallsInARow) {
  // Outer balls pressed 20 and 10 um into the middle one: forces 0.5421047 N and that over 2^1.5.
  Scene scene = model_scene();
  const double r = 2.5e-3, f1 = 0.5421047, f2 = f1 / std::pow(2.0, 1.5);
  add_sphere(scene, {0, 0, 0}, r);
  add_sphere(scene, {2 * r - 20e-6, 0, 0}, r);
  add_sphere(scene, {-(2 * r - 10e-6), 0, 0}, r);
  add_sphere(scene, {0, 0.03, 0}, r);  // touches nothing and must not count
  Simulation s(scene);
  s.set_time_step(1e-9);
  s.step();
  const std::vector<Vec3> net = net_contact_forces(s);
  EXPECT_NEAR(net[0].x, f2 - f1, 1e-6);
  EXPECT_NEAR(net[1].x, f1, 1e-6);
  EXPECT_NEAR(net[2].x, -f2, 1e-6);
  EXPECT_EQ(norm(net[3]), 0.0);
  const Balance b = balance(s);
  EXPECT_EQ(b.active_contacts, 2);
  EXPECT_NEAR(b.mean_contact_force, 0.5 * (f1 + f2), 1e-6);
  EXPECT_NEAR(b.mean_net_force, (f1 - f2 + f1 + f2) / 3, 1e-6);
  EXPECT_NEAR(b.ratio(), (2 * f1 / 3) / (0.5 * (f1 + f2)), 1e-5);
}

TEST(BodyPosition, OfGrainAndClump) {
  const Simulation s = three_bodies();
  EXPECT_LT(norm(body_position(s, 0)), 1e-15);
  EXPECT_LT(norm(body_position(s, 1) - Vec3{0.02, 0, 0}), 1e-15);
}

TEST(SimulationInput, IsRefusedWhenItCannotBeSimulated) {
  Scene scene = model_scene();
  EXPECT_THROW(Simulation{scene}, InputError);  // nothing in it
  scene.grains = {{{0, 0, 0}, {}}};
  scene.rubber_ball_radius = 0.0;
  EXPECT_THROW(Simulation{scene}, InputError);
  Simulation s = three_bodies();
  for (const double dt : {0.0, -1e-6, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(s.set_time_step(dt), InputError);
  }
}

}  // namespace
