// SPDX-License-Identifier: BSD-3-Clause
// The velocity that an inertial number asks for, against numbers worked out by hand from I = v / H D sqrt(rho / sigma_n).
// Not tested here: that a run records the number (tests/lab/quasi_static_test.cpp).
#include "dem4grm/lab/shear_velocity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/laws/inertial_number.hpp"
#include "support/mixture_case.hpp"

namespace dem {
namespace {

SpecimenReport specimen_of(double height, double size, double density) {
  SpecimenReport specimen;
  specimen.height = height;
  specimen.mean_size = size;
  specimen.mean_density = density;
  return specimen;
}

// D50 and densities of the published materials, and a quarter of rubber: 0.75 * 5.6 + 0.25 * 3.7 mm, 0.75 * 2710 + 0.25 * 1150.
const SpecimenReport k_gravel = specimen_of(0.053, 5.6e-3, 2710.0);
const SpecimenReport k_rubber = specimen_of(0.053, 3.7e-3, 1150.0);
const SpecimenReport k_mixture = specimen_of(0.053, 5.125e-3, 2320.0);

ShearSettings chosen(double normal_stress) {
  ShearSettings shear;
  shear.normal_stress = normal_stress;
  shear.velocity.reset();
  return shear;
}

TEST(InertialNumber, OfThePublishedTests) {
  // 2 mm/s over 53 mm: 0.037736 1/s. With sqrt(2710 / 30e3) = 0.30056 gravel has 0.037736 * 0.0056 * 0.30056.
  EXPECT_NEAR(inertial_number_at(2e-3, k_gravel, 30e3), 6.351e-5, 1e-8);
  EXPECT_NEAR(inertial_number_at(2e-3, k_gravel, 100e3), 3.479e-5, 1e-8);
  EXPECT_NEAR(inertial_number_at(2e-3, k_rubber, 30e3), 2.734e-5, 1e-8);
  EXPECT_NEAR(inertial_number_at(2e-3, k_rubber, 100e3), 1.497e-5, 1e-8);
}

TEST(ShearVelocity, ByHand) {
  // Gravel: 5e-5 * 0.053 / (0.0056 * sqrt(2710 / 100e3)) = 2.65e-6 / 9.2188e-4 = 2.8746 mm/s; the others in the same way.
  EXPECT_EQ(shear_velocity(chosen(100e3), k_gravel), 2.87e-3);
  EXPECT_EQ(shear_velocity(chosen(100e3), k_mixture), 3.39e-3);
  EXPECT_EQ(shear_velocity(chosen(100e3), k_rubber), 6.67e-3);
  EXPECT_EQ(shear_velocity(chosen(30e3), k_gravel), 1.57e-3)
      << "slower than the published velocity, whose number is larger";
}

TEST(ShearVelocity, ThatIsGivenStays) {
  ShearSettings shear = chosen(100e3);
  shear.velocity = 0.02;
  shear.inertial_number = 1e-5;
  EXPECT_EQ(shear_velocity(shear, k_rubber), 0.02);
}

TEST(ShearVelocity, FollowsEveryQuantityOfItsFormula) {
  // Rounding may take up to 1 % from either side of a ratio.
  const double v = shear_velocity(chosen(100e3), k_mixture);
  const auto ratio = [&](const ShearSettings& shear, const SpecimenReport& specimen) {
    return shear_velocity(shear, specimen) / v;
  };
  ShearSettings faster = chosen(100e3);
  faster.inertial_number = 2.0 * k_default_inertial_number;
  EXPECT_NEAR(ratio(faster, k_mixture), 2.0, 0.02);
  EXPECT_NEAR(ratio(chosen(400e3), k_mixture), 2.0, 0.02);
  EXPECT_NEAR(ratio(chosen(100e3), specimen_of(0.106, 5.125e-3, 2320.0)), 2.0, 0.02);
  EXPECT_NEAR(ratio(chosen(100e3), specimen_of(0.053, 10.25e-3, 2320.0)), 0.5, 0.005);
  EXPECT_NEAR(ratio(chosen(100e3), specimen_of(0.053, 5.125e-3, 9280.0)), 0.5, 0.005);
}

TEST(ShearVelocity, HasTheNumberAndCanBeTyped) {
  for (double number = 1e-6; number < 1.1e-3; number *= 1.37) {
    for (const SpecimenReport& specimen : {k_gravel, k_mixture, k_rubber}) {
      ShearSettings shear = chosen(60e3);
      shear.inertial_number = number;
      const double v = shear_velocity(shear, specimen);
      const double reached = inertial_number_at(v, specimen, 60e3) / number;
      EXPECT_LE(reached, 1.0 + 1e-12);
      EXPECT_GT(reached, 0.99);
      const std::string text = format_quantity(v, Dimension::speed);
      EXPECT_EQ(parse_quantity(text, Dimension::speed).value, v) << text;
      EXPECT_LE(text.size(), std::string("0.00123 mm/s").size()) << text;
    }
  }
}

TEST(ShearVelocity, ExpectedOneIsThatOfTheDrawnGrains) {
  for (const double rubber_content : {0.0, 0.3, 1.0}) {
    DirectShearCase test = test::mixture_case(rubber_content);
    EXPECT_EQ(expected_shear_velocity(test), 0.002);
    test.shear.velocity.reset();
    const GrainList grains = draw_grains(test.specimen, test.box, test.rubber.density, test.rubber_solid_density, 1);
    const SpecimenReport expected = expected_specimen(test, grains);
    const double vrc = grains.rubber_content();
    // Solid densities, not that of the balls; sizes between those of the gradings, 3.7 mm and 4 to 6 mm.
    EXPECT_NEAR(expected.mean_density, 2710.0 * (1.0 - vrc) + 1150.0 * vrc, 1e-9);
    EXPECT_NEAR(expected.mean_size, 5.0e-3 * (1.0 - vrc) + 3.7e-3 * vrc, 0.05e-3);
    EXPECT_EQ(expected.height, test.box.height);
    EXPECT_EQ(expected_shear_velocity(test), shear_velocity(test.shear, expected));
    EXPECT_NEAR(inertial_number_at(expected_shear_velocity(test), expected, 100e3), 5e-5, 0.5e-6);
  }
}

TEST(PlateSpeedCap, KeepsItsDistanceFromAChosenVelocity) {
  DirectShearCase test;
  EXPECT_EQ(plate_speed_cap(test, 0.002), 0.01);
  EXPECT_EQ(plate_speed_cap(test, 0.05), 0.05) << "of a given velocity the user decides";
  test.shear.velocity.reset();
  EXPECT_EQ(plate_speed_cap(test, 0.0015), 0.01);
  EXPECT_EQ(plate_speed_cap(test, 0.00667), 0.03335);
}

}  // namespace
}  // namespace dem
