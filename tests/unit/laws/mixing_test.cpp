// SPDX-License-Identifier: BSD-3-Clause
// Mixing of unlike materials, and the contact constants that follow, against numbers worked out by hand.
//
// The table was computed from the definitions of E* and G* of two touching half-spaces (Johnson, Contact Mechanics,
// 1985, eq. 4.12 and 7.37), G_c = 2 G1 G2 / (G1 + G2) and the compliance-weighted mean of Poisson's ratios; gravel
// 90 MPa / 0.30, wall 80 GPa / 0.25, rubber 12 MPa with 0.5 or 0.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "dem4grm/laws/hertz_mindlin.hpp"
#include "dem4grm/laws/mixing.hpp"

namespace {

using namespace dem;

constexpr Elastic k_gravel_elastic{90e6, 0.30}, k_wall{80e9, 0.25}, k_soft{12e6, 0.5}, k_softest{12e6, 0.0};

struct MixingRow {
  std::string name;
  Elastic a, b;
  double shear_modulus, poisson_ratio, effective_modulus, stiffness_ratio;  // Pa, -, Pa, -
};

void PrintTo(const MixingRow& row, std::ostream* out) { *out << row.name; }

class Mixing : public ::testing::TestWithParam<MixingRow> {};

TEST_P(Mixing, AgreesWithTheTableInBothOrders) {
  const MixingRow& row = GetParam();
  for (const MixedElastic& m : {mix(row.a, row.b), mix(row.b, row.a)}) {
    EXPECT_NEAR(m.shear_modulus, row.shear_modulus, 1e-6 * row.shear_modulus);
    EXPECT_NEAR(m.poisson_ratio, row.poisson_ratio, 6e-6);
    EXPECT_NEAR(m.effective_modulus, row.effective_modulus, 3e-6 * row.effective_modulus);
    EXPECT_NEAR(mindlin_ratio(m), row.stiffness_ratio, 6e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Table, Mixing,
    ::testing::Values(MixingRow{"gravel_gravel", k_gravel_elastic, k_gravel_elastic, 90e6, 0.30, 128.5714e6, 0.8235},
                      MixingRow{"gravel_wall", k_gravel_elastic, k_wall, 179.79773e6, 0.29994, 256.833e6, 0.8236},
                      MixingRow{"rubber_rubber", k_soft, k_soft, 12e6, 0.5, 24e6, 0.6667},
                      MixingRow{"rubber0_rubber0", k_softest, k_softest, 12e6, 0.0, 12e6, 1.0},
                      MixingRow{"gravel_rubber", k_gravel_elastic, k_soft, 21.17647e6, 0.47647, 40.4494e6, 0.6873},
                      MixingRow{"gravel_rubber0", k_gravel_elastic, k_softest, 21.17647e6, 0.03529, 21.9512e6, 0.9820},
                      MixingRow{"rubber_wall", k_soft, k_wall, 23.99640e6, 0.49996, 47.9892e6, 0.6667},
                      MixingRow{"rubber0_wall", k_softest, k_wall, 23.99640e6, 0.00004, 23.9973e6, 1.0}),
    [](const auto& tested) { return tested.param.name; });

TEST(MixingLaw, FrictionIsTheSmallerSide) {
  EXPECT_EQ(mix_friction(0.72, 0.27), 0.27);
  EXPECT_EQ(mix_friction(0.27, 0.70), 0.27);
  EXPECT_EQ(mix_friction(0.0, 2.0), 0.0);
}

struct ContactRow {
  std::string name;
  Elastic a, b;
  double radius_a, radius_b;  // m; 0 for a plane
  double hertz, force, normal_stiffness, shear_stiffness;
};

void PrintTo(const ContactRow& row, std::ostream* out) { *out << row.name; }

class ContactNumbers : public ::testing::TestWithParam<ContactRow> {};

/// Force and stiffnesses at an overlap of 20 um, with the shear stiffness read from a small tangential step.
TEST_P(ContactNumbers, AtTwentyMicrometres) {
  const ContactRow& row = GetParam();
  const MixedElastic mixed = mix(row.a, row.b);
  const HertzParameters p{hertz_coefficient(mixed, row.radius_a, row.radius_b), mindlin_ratio(mixed), 1.0, 0, 0};
  EXPECT_NEAR(p.hertz, row.hertz, 1e-6 * row.hertz);

  const double overlap = 20e-6, slide = 1e-9, dt = 1e-6;
  const auto at = [&](double d) {
    HertzMotion m;
    m.overlap = m.old_overlap = d;
    m.shear_velocity = {0, slide / dt, 0};
    return hertz_mindlin<HertzOptions{}>(p, m, dt);
  };
  const HertzForce f = at(overlap);
  EXPECT_NEAR(f.normal, row.force, 5e-7 * row.force);
  EXPECT_NEAR(f.shear.y / slide, row.shear_stiffness, 2e-6 * row.shear_stiffness);
  const double step = 1e-9;  // the tangent from the force itself
  EXPECT_NEAR((at(overlap + step).normal - at(overlap - step).normal) / (2 * step), row.normal_stiffness,
              2e-6 * row.normal_stiffness);
}

INSTANTIATE_TEST_SUITE_P(Table, ContactNumbers,
                         ::testing::Values(ContactRow{"gravel_gravel", k_gravel_elastic, k_gravel_elastic, 2.5e-3,
                                                      2.5e-3, 6.060915e6, 0.5421047, 4.065786e4, 3.348294e4},
                                           ContactRow{"gravel_rubber", k_gravel_elastic, k_soft, 2.5e-3, 0.63e-3,
                                                      1.209816e6, 0.1082092, 8.115693e3, 5.577580e3},
                                           ContactRow{"rubber_rubber", k_soft, k_soft, 0.63e-3, 0.63e-3, 5.679437e5,
                                                      0.05079843, 3.809882e3, 2.539921e3},
                                           ContactRow{"gravel_wall", k_gravel_elastic, k_wall, 2.5e-3, 0.0, 1.712222e7,
                                                      1.531458, 1.148593e5, 9.459451e4},
                                           ContactRow{"rubber_wall", k_soft, k_wall, 0.63e-3, 0.0, 1.606026e6,
                                                      0.1436473, 1.077355e4, 7.182725e3}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
