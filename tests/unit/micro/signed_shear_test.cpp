// SPDX-License-Identifier: BSD-3-Clause
// The tangential force with its sign, and the second harmonic of its magnitude, of forces written down as functions of angle.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "dem4grm/micro/force_anisotropy.hpp"
#include "support/contact_builder.hpp"

namespace dem {
namespace {

using test::apart;
using test::k_degree;

constexpr double k_half_circle = std::numbers::pi;

/// n contacts at equal angles of the full circle, each with the force S n of a symmetric tensor in the shear plane: mean
/// stress p, deviator q with its major axis at `axis`.
std::vector<Contact> contacts_under_stress(int n, double p, double q, double axis, double across) {
  std::vector<Contact> contacts;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * k_half_circle * (k + 0.5) / n;
    Contact c = test::plane_contact(angle, p + q * std::cos(2 * (angle - axis)), 0.0);
    const double along_circle = -q * std::sin(2 * (angle - axis));  // of i on j, towards growing theta
    c.shear_force = Vec3{-std::sin(angle), 0.0, std::cos(angle)} * -along_circle + Vec3{0.0, across, 0.0};
    contacts.push_back(c);
  }
  return contacts;
}

TEST(SignedShear, OfForcesThatFollowAStressIsItsDeviator) {
  for (const double axis : {10.0, 60.0, 90.0, 135.0, 179.0}) {
    // A force across the plane changes |f_t|, but not what turns in the plane.
    for (const double across : {0.0, 3.0}) {
      const auto samples = polar_samples(contacts_under_stress(7200, 2.0, 0.6, axis * k_degree, across), {});
      const PolarHistogram histogram = polar_histogram(samples, 36);
      const SignedShearAnisotropy found = signed_shear_anisotropy(histogram, ForceMean::orientations);
      const ForceAnisotropy normal = normal_force_anisotropy(histogram);
      EXPECT_NEAR(found.amplitude, 0.3, 1e-5);
      EXPECT_NEAR(normal.fit.amplitude, 0.3, 1e-5);
      EXPECT_LT(apart(found.direction, axis * k_degree, k_half_circle), 1e-5);
      EXPECT_LT(apart(found.direction, normal.fit.direction, k_half_circle), 1e-5);
      EXPECT_NEAR(found.fourth, 0.0, 1e-9);
      EXPECT_NEAR(found.residual, 0.0, 1e-9);
      // Stress-force-fabric relation of the plane, isotropic fabric: q/p = (a + a_n + a_s) / 2.
      EXPECT_NEAR(0.5 * (normal.fit.amplitude + found.amplitude), 0.6 / 2.0, 1e-5);
    }
  }
}

TEST(SignedShear, KeepsItsSignWhenTheContactIsSeenFromTheOtherSide) {
  const std::vector<Contact> contacts = contacts_under_stress(720, 2.0, 0.6, 40 * k_degree, 0.2);
  std::vector<Contact> turned = contacts;
  for (std::size_t k = 0; k < turned.size(); k += 2) {
    turned[k].normal = -turned[k].normal;
    turned[k].shear_force = -turned[k].shear_force;
  }
  const auto one = polar_samples(contacts, {}), other = polar_samples(turned, {});
  for (std::size_t k = 0; k < one.size(); ++k) {
    ASSERT_EQ(one[k].angle, other[k].angle);
    ASSERT_EQ(one[k].signed_shear, other[k].signed_shear);
  }
}

TEST(SignedShear, FourthHarmonicAndReferenceToEitherMean) {
  // -f0 sin 2(theta - 20) with f0 = 0.5 and 0.25 sin 4 theta; normal force 2 in half of the circle's bins, 1 in the others.
  std::vector<Contact> contacts;
  for (int k = 0; k < 7200; ++k) {
    const double angle = k_half_circle * (k + 0.5) / 7200;
    Contact c = test::plane_contact(angle, angle < 0.5 * k_half_circle ? 2.0 : 1.0, 0.0);
    const double force = -0.5 * std::sin(2 * (angle - 20 * k_degree)) + 0.25 * std::sin(4 * angle);
    c.shear_force = Vec3{-std::sin(angle), 0.0, std::cos(angle)} * -force;
    contacts.push_back(c);
    if (angle < 0.5 * k_half_circle) contacts.push_back(c);  // twice as many of the heavy ones: mean over contacts 5/3
  }
  const PolarHistogram histogram = polar_histogram(polar_samples(contacts, {}), 36);
  const SignedShearAnisotropy found = signed_shear_anisotropy(histogram, ForceMean::orientations);
  EXPECT_NEAR(found.amplitude, 0.5 / 1.5, 1e-5);
  EXPECT_NEAR(found.fourth, 0.25 / 1.5, 1e-5);
  EXPECT_LT(apart(found.direction, 20 * k_degree, k_half_circle), 1e-5);
  EXPECT_NEAR(found.residual, 0.25 * std::sqrt(0.5) / 1.5, 0.01);
  EXPECT_NEAR(signed_shear_anisotropy(histogram, ForceMean::contacts).amplitude, 0.5 / (5.0 / 3.0), 1e-5);
}

TEST(SecondShearHarmonic, StandsBesideTheFourth) {
  std::vector<Contact> contacts;
  for (int k = 0; k < 7200; ++k) {
    const double angle = k_half_circle * (k + 0.5) / 7200;
    const double shear =
        1.0 + 0.3 * std::cos(2 * (angle - 70 * k_degree)) + 0.2 * std::cos(4 * (angle - 15 * k_degree));
    contacts.push_back(test::plane_contact(angle, 1.0, shear));
  }
  const PolarHistogram histogram = polar_histogram(polar_samples(contacts, {}), 36);
  const ForceAnisotropy second = second_shear_harmonic(histogram), fourth = shear_force_anisotropy(histogram);
  EXPECT_NEAR(second.fit.amplitude, 0.3, 1e-5);
  EXPECT_LT(apart(second.fit.direction, 70 * k_degree, k_half_circle), 1e-5);
  EXPECT_NEAR(fourth.fit.amplitude, 0.2, 1e-5);
  EXPECT_LT(apart(fourth.fit.direction, 15 * k_degree, 0.5 * k_half_circle), 1e-5);
}

}  // namespace
}  // namespace dem
