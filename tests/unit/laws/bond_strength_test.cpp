// SPDX-License-Identifier: BSD-3-Clause
// Strength of the incremental bond: each way of loading breaks at its stress and not just below it.
//
// For a bond disc of radius R and length 2r the stresses follow from elementary beam theory:
//   tension  E u / 2r        bending  E R phi / 2r        shear  (E/kappa) u / 2r        torsion  (E/kappa) R phi / 2r
#include <gtest/gtest.h>

#include "dem4grm/laws/parallel_bond.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;

constexpr double k_radius = 1e-3, k_modulus = 10e6, k_ratio = 2.5, k_multiplier = 0.8;
constexpr double k_tensile = 20e3, k_shear = 12e3;  // Pa: strains of 0.2 % and 0.3 %

BondParameters weak_bond() {
  return bond_parameters({k_radius, 1e-5, k_modulus, k_ratio, k_multiplier, 1.0, 0.0, k_tensile, k_shear, true});
}

/// Loads a straight bond in 1000 equal steps to `move` of j and half of `turn` on each ball; true when it broke.
bool breaks(const Vec3& move, const Vec3& turn) {
  const BondParameters p = weak_bond();
  BondHistory h;
  const int n = 1000;
  for (int k = 1; k <= n; ++k) {
    bool broken = false;
    const Vec3 branch = Vec3{0, 0, p.rest_length} + move * (static_cast<double>(k) / n);
    incremental_bond(p, {branch, move, turn * -0.5, turn * 0.5}, 1.0 / n, h, broken);
    if (broken) return true;
  }
  return false;
}

void expect_limit(const Vec3& move, const Vec3& turn) {
  EXPECT_FALSE(breaks(move * 0.998, turn * 0.998));
  EXPECT_TRUE(breaks(move * 1.002, turn * 1.002));
}

TEST(BondStrength, Tension) { expect_limit({0, 0, k_tensile / k_modulus * 2 * k_radius}, {}); }

TEST(BondStrength, CompressionNeverBreaks) { EXPECT_FALSE(breaks({0, 0, -0.1 * k_radius}, {})); }

TEST(BondStrength, Shear) { expect_limit({k_shear * k_ratio / k_modulus * 2 * k_radius, 0, 0}, {}); }

TEST(BondStrength, Bending) {
  expect_limit({}, {k_tensile / k_modulus * 2 * k_radius / (k_multiplier * k_radius), 0, 0});
}

TEST(BondStrength, Torsion) {
  expect_limit({}, {0, 0, k_shear * k_ratio / k_modulus * 2 * k_radius / (k_multiplier * k_radius)});
}

TEST(BondStrength, TensionAndBendingAdd) {
  const double tension = k_tensile / k_modulus * 2 * k_radius, bend = tension / (k_multiplier * k_radius);
  EXPECT_FALSE(breaks({0, 0, 0.598 * tension}, {0, 0.4 * bend, 0}));
  EXPECT_TRUE(breaks({0, 0, 0.602 * tension}, {0, 0.4 * bend, 0}));
}

TEST(BondStrength, CompressionRelievesBending) {
  const double tension = k_tensile / k_modulus * 2 * k_radius, bend = tension / (k_multiplier * k_radius);
  EXPECT_FALSE(breaks({0, 0, -0.5 * tension}, {0, 1.49 * bend, 0}));
  EXPECT_TRUE(breaks({0, 0, -0.5 * tension}, {0, 1.51 * bend, 0}));
}

TEST(BondStrength, ShearAndTorsionAdd) {
  const double slide = k_shear * k_ratio / k_modulus * 2 * k_radius, twist = slide / (k_multiplier * k_radius);
  EXPECT_FALSE(breaks({0.697 * slide, 0, 0}, {0, 0, 0.3 * twist}));
  EXPECT_TRUE(breaks({0.703 * slide, 0, 0}, {0, 0, 0.3 * twist}));
}

}  // namespace
