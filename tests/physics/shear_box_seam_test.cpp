// SPDX-License-Identifier: BSD-3-Clause
// No ball gets out of the shear box when its halves have parted, and the seam, the wings and their edges neither make
// nor lose energy.
//
// A gas of smooth elastic balls in a box parted by 10 mm hits every wall, edge and corner from all sides many times;
// then a bed of rough balls is pressed and sheared. Expected: geometry of the two half spaces; conservation of energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/random.hpp"
#include "dem4grm/walls/shear_box.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_parted = 0.010;  // m
const BoxSettings k_box{0.030, 0.012, 0.020, 0.020, 0.0, 0.015};

/// The inside of the parted box: the lower half shifted by `parted` in x.
bool is_inside(const Vec3& p, double parted, double plate) {
  if (p.y < 0.0 || p.y > k_box.width || p.z < 0.0 || p.z > plate) return false;
  return p.z < 0.5 * k_box.height ? p.x > parted && p.x < k_box.length + parted : p.x > 0.0 && p.x < k_box.length;
}

/// Balls on a grid in both halves, sizes drawn; those that would touch a wall are left out.
Scene filled_box(double parted, double friction, double plate_height) {
  Scene scene = model_scene();
  scene.gravel.friction = scene.rubber.friction = friction;
  ShearBox box(k_box, plate_height);
  for (int w = 0; w < ShearBox::k_walls; ++w) {
    if (ShearBox::half_of(w) == BoxHalf::lower) box.walls()[static_cast<std::size_t>(w)].corner.x += parted;
  }
  scene.wall_list = box.walls();
  RandomSequence random(11, RandomStream::test, 0);
  const double pitch = 3.3e-3;
  for (double z = 0.5 * pitch; z < plate_height - 0.5 * pitch; z += pitch) {
    for (double y = 0.5 * pitch; y < k_box.width - 0.5 * pitch; y += pitch) {
      for (double x = 0.5 * pitch; x < k_box.length + parted; x += pitch) {
        const double r = random.uniform(0.4e-3, 1.6e-3);
        const Vec3 at{x, y, z};
        bool fits = is_inside(at, parted, plate_height);
        for (const Wall& w : scene.wall_list) fits = fits && look_at(w, at).distance > r;
        if (fits) add_sphere(scene, at, r, r < 0.8e-3 ? k_rubber : k_gravel);
      }
    }
  }
  return scene;
}

TEST(ShearBoxSeam, ElasticGasStaysInsideAndKeepsItsEnergy) {
  Simulation s(filled_box(k_parted, 0.0, k_box.upper_height));
  ASSERT_GT(s.clumps.clumps.size(), 150U);
  RandomSequence random(12, RandomStream::test, 0);
  for (std::size_t c = 0; c < s.clumps.clumps.size(); ++c) set_motion(s, c, frame_of(random.orientation()).e1 * 2.0);
  s.set_time_step(1e-6);
  const double start = s.energy().kinetic;
  double worst_energy = 0.0;
  int wing_hits = 0;
  for (int k = 0; k < 20000; ++k) {
    s.step();
    wing_hits += s.reactions[5].contacts + s.reactions[11].contacts;
    if (k % 50 != 0) continue;
    const EnergyReport e = s.energy();
    worst_energy = std::max(worst_energy, std::abs((e.kinetic + e.contact_strain) / start - 1.0));
    for (const Clump& c : s.clumps.clumps) {
      ASSERT_TRUE(is_inside(c.position, k_parted, k_box.upper_height))
          << "at " << c.position.x * 1e3 << ' ' << c.position.y * 1e3 << ' ' << c.position.z * 1e3 << " mm, step " << k;
    }
  }
  EXPECT_GT(wing_hits, 1000);  // the wings were really at work
  EXPECT_LT(worst_energy, 2e-3);
}

TEST(ShearBoxSeam, PressedAndShearedBedStaysInside) {
  Scene scene = filled_box(0.0, 0.5, k_box.upper_height);
  scene.integration.local_damping = 0.5;
  Simulation s(scene);
  s.set_time_step(1.5e-6);
  s.servo = {ShearBox::k_top_plate, 100e3 * k_box.length * k_box.width, 0.5, 2.0};
  double moved = 0.0;
  for (int k = 0; k < 14000; ++k) {
    const bool shearing = k >= 4000;
    ShearBox::set_velocities(s.walls, MovingHalf::lower, shearing ? 0.7 : 0.0,
                             s.walls[ShearBox::k_top_plate].velocity.z);
    s.step();
    moved += shearing ? 0.7 * s.time_step() : 0.0;
    if (k % 100 != 0) continue;
    for (const Clump& c : s.clumps.clumps) {
      ASSERT_TRUE(is_inside(c.position, moved, s.walls[ShearBox::k_top_plate].corner.z))
          << "at " << c.position.x * 1e3 << ' ' << c.position.y * 1e3 << ' ' << c.position.z * 1e3 << " mm, step " << k;
    }
  }
  EXPECT_NEAR(moved, 0.0105, 1e-9);
  EXPECT_NEAR(s.walls[0].corner.x, 0.0105, 1e-9);
  EXPECT_EQ(s.walls[7].corner.x, 0.0);
}

}  // namespace
