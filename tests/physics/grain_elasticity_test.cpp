// SPDX-License-Identifier: BSD-3-Clause
// Small-strain elasticity of the 35-ball grain through the engine: stiffness matrix, platen stiffness, Poisson's ratio.
//
// Expected: own assembly of beam energies (support/grain_statics.hpp); numbers of two separate earlier calculations of
// the same statics (Poisson's ratio to three digits, platen stiffness 1.737 E r at kappa 4); the infinite lattice.
#include <gtest/gtest.h>

#include "support/grain_statics.hpp"

namespace {

using namespace dem;
using namespace dem::test;

constexpr double k_radius = 0.65e-3, k_modulus = 20e6;

class GrainElasticity : public ::testing::TestWithParam<BondForm> {};

TEST_P(GrainElasticity, EngineHasTheStiffnessMatrixOfTheBeams) {
  Scene scene = lone_grain(k_radius);
  scene.bond.linear_spring = false;
  scene.bond.form = GetParam();
  scene.bond.stiffness_ratio = 3.0;
  scene.bond.moment_scale = 0.7;
  const Eigen::MatrixXd engine = engine_stiffness(scene);
  const Eigen::MatrixXd beams = beam_grain_stiffness(k_radius, beam_stiffness(k_radius, k_modulus, 3.0, 0.7));
  // Blocks have different units; compare each with the largest of its kind.
  for (const auto& [row, column] : {std::pair{0, 0}, {0, 3}, {3, 0}, {3, 3}}) {
    double largest = 0.0, worst = 0.0;
    for (int i = 0; i < k_grain_balls; ++i) {
      for (int j = 0; j < k_grain_balls; ++j) {
        const auto a = engine.block<3, 3>(6 * i + row, 6 * j + column),
                   b = beams.block<3, 3>(6 * i + row, 6 * j + column);
        worst = std::max(worst, (a - b).cwiseAbs().maxCoeff());
        largest = std::max(largest, b.cwiseAbs().maxCoeff());
      }
    }
    EXPECT_LT(worst, 1e-5 * largest) << "block " << row << "," << column;
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, GrainElasticity, ::testing::Values(BondForm::history_free, BondForm::incremental),
                         [](const auto& tested) {
                           return tested.param == BondForm::incremental ? "incremental" : "history_free";
                         });

TEST(GrainPlatens, StiffnessAndPoissonsRatioOfTheModel) {
  Scene scene = lone_grain(k_radius);
  scene.bond.linear_spring = false;
  const PlatenTest t = squeeze(engine_stiffness(scene), k_radius);
  EXPECT_NEAR(t.stiffness / (k_modulus * k_radius), 1.737, 5e-4);
  EXPECT_NEAR(t.poisson_ratio, 0.371, 5e-4);
}

TEST(GrainPlatens, WithoutMomentsPoissonsRatioIsOneHalf) {
  Scene scene = lone_grain(k_radius);
  scene.bond.linear_spring = false;
  scene.bond.moment_scale = 0.0;
  const PlatenTest t = squeeze(engine_stiffness(scene), k_radius);
  EXPECT_NEAR(t.poisson_ratio, 0.5, 1e-5);
  EXPECT_NEAR(t.stiffness / (k_modulus * k_radius), 0.8494, 1e-4);
}

TEST(GrainPlatens, ThinBonds) {
  Scene scene = lone_grain(k_radius);
  scene.bond.linear_spring = false;
  scene.bond.radius_multiplier = 0.5;
  const PlatenTest t = squeeze(engine_stiffness(scene), k_radius);
  EXPECT_NEAR(t.stiffness / (k_modulus * k_radius), 0.343, 5e-4);
  EXPECT_NEAR(t.poisson_ratio, 0.412, 5e-4);
}

TEST(GrainPlatens, PoissonsRatioAgainstStiffnessRatioAndMomentScale) {
  // The beams stand for the engine here: the first test has shown that the matrices are equal.
  const auto ratio = [](double kappa, double scale) {
    return squeeze(beam_grain_stiffness(k_radius, beam_stiffness(k_radius, k_modulus, kappa, scale)), k_radius)
        .poisson_ratio;
  };
  const double with_moments[][2] = {{1, 0.0},   {2, 0.229}, {3, 0.322},   {4, 0.371},
                                    {5, 0.400}, {8, 0.441}, {1000, 0.499}};
  for (const auto& [kappa, nu] : with_moments) EXPECT_NEAR(ratio(kappa, 1.0), nu, 6e-4) << "kappa " << kappa;
  const double without[][2] = {{2, 0.327}, {3, 0.445}, {5, 0.529}, {8, 0.559}};
  for (const auto& [kappa, nu] : without) EXPECT_NEAR(ratio(kappa, 0.0), nu, 6e-4) << "kappa " << kappa;
  const double scaled[][2] = {{0.05, 0.466}, {0.25, 0.412}, {0.5, 0.389}};
  for (const auto& [scale, nu] : scaled) EXPECT_NEAR(ratio(4.0, scale), nu, 6e-4) << "scale " << scale;
}

/// With the linear springs: solve, mark the squeezed bonds, solve again until the set stands still.
PlatenTest squeeze_with_springs(double kappa) {
  std::array<bool, k_grain_bonds> squeezed{};
  for (int round = 0; round < 30; ++round) {
    const PlatenTest t =
        squeeze(beam_grain_stiffness(k_radius, beam_stiffness(k_radius, k_modulus, kappa), squeezed), k_radius);
    std::array<bool, k_grain_bonds> next{};
    for (std::size_t b = 0; b < k_grain_bonds; ++b) {
      const SlotPair pair = k_bonds_of_grain[b];
      const Eigen::Vector3d n = eigen_vector(grain_site(pair.j) - grain_site(pair.i)).normalized();
      next[b] = n.dot(t.motion.segment<3>(6 * pair.j) - t.motion.segment<3>(6 * pair.i)) < 0.0;
    }
    if (next == squeezed) return t;
    squeezed = next;
  }
  ADD_FAILURE() << "the set of squeezed bonds does not settle";
  return {};
}

TEST(GrainPlatens, LinearSpringsThatOnlyPush) {
  const double expected[][2] = {{1, 0.240}, {2, 0.387}, {3, 0.435}, {4, 0.456}, {5, 0.467}};
  for (const auto& [kappa, nu] : expected) {
    EXPECT_NEAR(squeeze_with_springs(kappa).poisson_ratio, nu, 6e-4) << "kappa " << kappa;
  }
}

TEST(GrainPlatens, EngineIsInEquilibriumInThatSolution) {
  const Scene scene = lone_grain(k_radius);  // springs on
  const PlatenTest t = squeeze_with_springs(4.0);
  const double approach = 1e-6 * k_radius;
  const Eigen::VectorXd loads = engine_loads(scene, t.motion * (0.5 * approach));
  double top = 0.0, worst = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const double z = grain_site(slot).z;
    const bool held = z == 1.0 || z == -1.0;
    if (z == 1.0) top += loads[6 * slot + 2];
    for (int c = 0; c < 6; ++c) {
      if (held && c == 2) continue;
      worst = std::max(worst, std::abs(loads[6 * slot + c]) / (c < 3 ? 1.0 : k_radius));
    }
  }
  EXPECT_NEAR(top, t.stiffness * approach, 1e-4 * top);
  EXPECT_LT(worst, 1e-4 * top);
}

}  // namespace
