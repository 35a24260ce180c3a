// SPDX-License-Identifier: BSD-3-Clause
// Where the halves part, and grains that find a way out.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

/// Contacts with the sides of both halves before shear.
struct SideContacts : LabObserver {
  int lower = 0, upper = 0;
  double highest_of_lower = 0.0, lowest_of_upper = 1.0;  // m

  void frame(const Simulation& state, const FrameInfo& info) override {
    if (info.number > 0) return;
    for (const WallContact& c : contact_network_of(state).wall_contacts) {
      const int side = c.wall % ShearBox::k_top_plate;
      if (side < ShearBox::k_side_x_min || side > ShearBox::k_side_y_max) continue;
      if (ShearBox::half_of(c.wall) == BoxHalf::lower) {
        highest_of_lower = std::max(highest_of_lower, c.point.z);
        ++lower;
      } else {
        lowest_of_upper = std::min(lowest_of_upper, c.point.z);
        ++upper;
      }
    }
  }
};

TEST(SplitPlane, LiesAtHalfOfTheSpecimenWhenAskedFor) {
  DirectShearCase test = test::tiny_shear_case(0.3, 0.025, 0.030);
  test.specimen.expected_void_ratio = 0.9;  // far too loose: the specimen is lower than the box says
  test.shear.displacement = 0.4e-3;
  LabObserver silent;
  const DirectShearResult nominal = run_direct_shear(test, silent);
  EXPECT_EQ(nominal.specimen.split_height, 0.015);
  test.box.split_plane = SplitPlane::specimen;
  SideContacts contacts;
  const DirectShearResult half = run_direct_shear(test, contacts);
  EXPECT_GT(contacts.lower, 20);
  EXPECT_GT(contacts.upper, 20);
  EXPECT_LT(contacts.highest_of_lower, half.specimen.split_height + 1e-9);
  EXPECT_GT(contacts.lowest_of_upper, half.specimen.split_height - 1e-9);
  EXPECT_LT(half.specimen.height, 0.028);
  EXPECT_NEAR(half.specimen.split_height, 0.5 * half.specimen.height, 1e-4);
  // The sides push as before, so the specimen is the same; its lateral stress too, though other walls carry it.
  EXPECT_NEAR(half.specimen.void_ratio_before_shear, nominal.specimen.void_ratio_before_shear, 1e-3);
  EXPECT_NEAR(half.before.lateral.k0_x, nominal.before.lateral.k0_x, 0.02);
  EXPECT_EQ(half.lost_grains, 0);
}

TEST(RoughPlates, GripWithoutFrictionAndKeepTheBooks) {
  DirectShearCase test = test::tiny_shear_case(0.3, 0.025, 0.024);
  test.walls.friction = 0.0;
  test.shear.displacement = 0.8e-3;
  LabObserver silent;
  const DirectShearResult smooth = run_direct_shear(test, silent);
  test.box.plate_roughness = 2e-3;
  test.box.plate_roughness_pitch = 4e-3;
  const DirectShearResult rough = run_direct_shear(test, silent);
  const double area = test.box.length * test.box.width;
  double gripped = 0.0;
  for (const ShearRow& row : rough.rows) {
    double lower = 0.0;
    for (std::size_t w = 0; w < ShearBox::k_top_plate; ++w) lower += row.wall_force[w].x;
    EXPECT_NEAR(-lower / area, row.shear_stress, 1e-6 * row.normal_stress);
    gripped = std::max(gripped, row.plate_shear_stress / row.normal_stress);
  }
  // A smooth plate without friction carries nothing; ribs do.
  for (const ShearRow& row : smooth.rows) EXPECT_NEAR(row.plate_shear_stress, 0.0, 1e-6 * row.normal_stress);
  EXPECT_GT(gripped, 0.05);
  EXPECT_NEAR(rough.normal_stress_mean / 60e3, 1.0, 0.02);
  EXPECT_LT(rough.half_force_imbalance_mean, 0.1);
  EXPECT_EQ(rough.lost_grains, 0);
  const EnergyReport &first = rough.rows.front().energy, &last = rough.rows.back().energy;
  const double stored =
      last.kinetic + last.contact_strain + last.bond_strain - first.kinetic - first.contact_strain - first.bond_strain;
  const double lost = last.slip + last.dashpot + last.local_damping - first.slip - first.dashpot - first.local_damping;
  EXPECT_NEAR((stored + lost) / (last.boundary_work - first.boundary_work), 1.0, 0.02);
  // Stress of the contacts, ribs among them, against the force on the plate.
  for (const MicroRow& row : rough.micro_rows) {
    EXPECT_NEAR(row.numbers.plate_stress / 60e3, 1.0, 0.1);
    EXPECT_NEAR(row.numbers.boundary_zz / row.numbers.plate_stress, 1.0, 0.15);
  }
}

TEST(Gap, AGrainOnItsWayOutIsNamedWithTheGap) {
  DirectShearCase test = test::tiny_shear_case(0.0, 0.025, 0.024);
  test.specimen.clump_shapes = {"sphere"};
  test.specimen.generation_void_ratio = 0.9;
  test.box.gap = 4.6e-3;  // the spheres are 4 to 5 mm thick
  test.shear.displacement = 4e-3;
  LabObserver silent;
  try {
    (void)run_direct_shear(test, silent);
    FAIL() << "no grain found the gap";
  } catch (const PhysicsError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("clump"), std::string::npos) << text;
    EXPECT_NE(text.find("left the box"), std::string::npos) << text;
    EXPECT_NE(text.find("on its way out through the gap between the halves; make box.gap (4.6 mm) smaller"),
              std::string::npos)
        << text;
  }
}

}  // namespace
}  // namespace dem
