// SPDX-License-Identifier: BSD-3-Clause
// Ribs of rough plates: where they stand, what they push, and that their plate counts for them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/walls/shear_box.hpp"
#include "support/scene_builder.hpp"

namespace dem {
namespace {

BoxSettings rough_box() {
  BoxSettings s;
  s.length = 0.050;
  s.width = 0.030;
  s.height = 0.040;
  s.plate_roughness = 2e-3;
  s.plate_roughness_pitch = 5e-3;  // ten ribs
  return s;
}

TEST(RoughPlates, FlanksCoverThePlateAboutItsMeanPlane) {
  const BoxSettings s = rough_box();
  const ShearBox box(s, 0.040);
  ASSERT_EQ(box.walls().size(), static_cast<std::size_t>(ShearBox::k_walls + 2 * 2 * 10));
  for (const int plate : {ShearBox::k_bottom_plate, ShearBox::k_top_plate}) {
    const Wall& mean = box.walls()[static_cast<std::size_t>(plate)];
    EXPECT_FALSE(mean.is_solid);
    const double inward = mean.normal.z;
    double covered = 0.0, volume = 0.0;  // m2; m3 between flanks and mean plane
    for (const Wall& w : box.walls()) {
      if (w.carrier != plate) continue;
      EXPECT_NEAR(w.normal.z * inward, 2.5 / std::hypot(2.5, 2.0), 1e-12) << w.name << " faces the grains";
      EXPECT_TRUE(w.is_solid);
      const Vec3 far = w.corner + w.u * w.length_u + w.v * w.length_v;
      EXPECT_NEAR(std::fabs(w.corner.z - mean.corner.z), 1e-3, 1e-15);
      EXPECT_NEAR(std::fabs(far.z - w.corner.z), 2e-3, 1e-15);
      EXPECT_NEAR(std::fabs(far.y - w.corner.y), 0.030, 1e-15);
      covered += std::fabs((far.x - w.corner.x) * (far.y - w.corner.y));
      volume += 0.5 * (w.corner.z + far.z - 2 * mean.corner.z) * 2.5e-3 * 0.030;
    }
    EXPECT_NEAR(covered, 0.050 * 0.030, 1e-15);
    EXPECT_NEAR(volume, 0.0, 1e-15);
  }
  // Sides begin at the valleys, where grains may be too.
  EXPECT_NEAR(box.walls()[1].corner.z, -1e-3, 1e-15);
  const auto [lower, upper] = ShearBox::rooms_of(box.walls());
  EXPECT_NEAR(lower.low.z, -1e-3, 1e-15);
  EXPECT_NEAR(upper.high.z, 0.041, 1e-15);
}

TEST(RoughPlates, PitchIsTwiceTheHeightUnlessGivenAndFitsTheLength) {
  BoxSettings s = rough_box();
  s.plate_roughness_pitch = 0.0;  // 4 mm: 12.5 ribs, rounded to 13
  EXPECT_EQ(ShearBox(s, 0.04).walls().size(), static_cast<std::size_t>(ShearBox::k_walls + 2 * 2 * 13));
  s.plate_roughness = 0.0;
  EXPECT_EQ(ShearBox(s, 0.04).walls().size(), static_cast<std::size_t>(ShearBox::k_walls));
}

TEST(RoughPlates, FrictionMotionAndPartingReachTheRibs) {
  const BoxSettings s = rough_box();
  ShearBox box(s, 0.040);
  ShearBox::set_plate_friction(box.walls(), 0.4);
  ShearBox::set_velocities(box.walls(), MovingHalf::both, 0.002, -0.01);
  for (const Wall& w : box.walls()) {
    const bool is_plate = w.carrier >= 0 || w.name == "bottom plate" || w.name == "top plate";
    EXPECT_EQ(w.friction, is_plate ? 0.4 : 0.0) << w.name;
    if (w.carrier < 0) continue;
    EXPECT_EQ(w.velocity.x, w.carrier == ShearBox::k_bottom_plate ? 0.001 : -0.001);
    EXPECT_EQ(w.velocity.z, w.carrier == ShearBox::k_bottom_plate ? 0.0 : -0.01);
  }
  ShearBox::part_at(box.walls(), s, 0.018);
  EXPECT_NEAR(ShearBox::split_height(box.walls()), 0.018, 1e-15);
  EXPECT_NEAR(box.walls()[1].corner.z, -1e-3, 1e-15);
}

TEST(RoughPlates, ASphereInAValleyPushesBothFlanksAndThePlateCountsForThem) {
  // Flanks at 45 degrees, 2.5 mm high; a sphere of 2.5 mm pressed 20 um into both: 1.531458 N on each (physics of the law:
  // gravel against a wall), straight down together; moved to one side it pushes that flank alone.
  BoxSettings s = rough_box();
  s.plate_roughness = 5e-3;
  s.plate_roughness_pitch = 10e-3;
  const double r = 2.5e-3, d = 20e-6, root = std::numbers::sqrt2;
  const Vec3 valley{20e-3, 15e-3, -2.5e-3};
  for (const double aside : {0.0, 1.0}) {
    Scene scene = test::model_scene();
    scene.wall_list = ShearBox(s, 0.040).walls();
    // Aside: up along one flank, away from the other.
    const Vec3 centre = valley + Vec3{0, 0, (r - d) * root} + Vec3{aside * 1e-3, 0, aside * 1e-3};
    test::add_sphere(scene, centre, r);
    Simulation sim(scene);
    sim.set_time_step(1e-9);
    sim.step();
    const WallReaction& plate = sim.reactions[ShearBox::k_bottom_plate];
    const double force = 1.531458;
    EXPECT_EQ(plate.contacts, aside == 0.0 ? 2 : 1);
    EXPECT_NEAR(plate.force.z, aside == 0.0 ? -root * force : -force / root, 2e-6);
    EXPECT_NEAR(plate.force.x, aside == 0.0 ? 0.0 : force / root, 2e-6);
    EXPECT_NEAR(plate.stiffness, plate.contacts * 1.148593e5, 1.0);
    const ContactNetwork network = contact_network_of(sim);
    ASSERT_EQ(network.wall_contacts.size(), static_cast<std::size_t>(plate.contacts));
    for (const WallContact& c : network.wall_contacts) {
      EXPECT_GE(c.wall, ShearBox::k_walls);
      EXPECT_EQ(network.box.plate_of(c.wall), ShearBox::k_bottom_plate);
    }
  }
}

TEST(RoughPlates, RibsFollowTheServoOfTheirPlateAndItsWorkCountsOnce) {
  BoxSettings s = rough_box();
  Scene scene = test::model_scene();
  scene.wall_list = ShearBox(s, 0.040).walls();
  test::add_sphere(scene, {25e-3, 15e-3, 20e-3}, 2.5e-3);  // touches nothing
  Simulation sim(scene);
  sim.set_time_step(1e-6);
  sim.servo = {ShearBox::k_top_plate, 10.0, 0.5, 0.01};
  for (int k = 0; k < 100; ++k) sim.step();
  const Wall& plate = sim.walls[ShearBox::k_top_plate];
  EXPECT_NEAR(plate.corner.z, 0.040 - 100 * 1e-6 * 0.01, 1e-9);
  for (const Wall& w : sim.walls) {
    if (w.carrier != ShearBox::k_top_plate) continue;
    EXPECT_EQ(w.velocity.z, plate.velocity.z);
    EXPECT_NEAR(std::fabs(w.corner.z - plate.corner.z), 1e-3, 1e-12);
  }
}

}  // namespace
}  // namespace dem
