// SPDX-License-Identifier: BSD-3-Clause
// A straight chain of bonded balls as a cantilever: tip deflection, twist and stretch against closed forms.
//
// N bonds, L = 2 r N, first ball clamped, load on the last centre, linear spring off (algebra confirmed by a separate
// stiffness matrix):
//   w = P L^3/(3 E I) (1 - 1/(4 N^2)) + kappa P L/(E A)      theta = kappa T L/(E J)      u = P L/(E A)
// The stiffness matrix is built from the law by central differences, so the law alone is tested, in both forms.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "dem4grm/laws/parallel_bond.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"
#include "support/scene_builder.hpp"

namespace {

using namespace dem;

constexpr double k_radius = 1.0, k_modulus = 1.0;

/// Loads (force, torque) on every ball of a chain along x whose balls are moved and turned by `u`, six values each.
Eigen::VectorXd chain_loads(const BondParameters& p, const Eigen::VectorXd& u, bool incremental) {
  const Eigen::Index balls = u.size() / 6;
  Eigen::VectorXd out = Eigen::VectorXd::Zero(u.size());
  const auto part = [&](Eigen::Index ball, Eigen::Index first) {
    return Vec3{u[6 * ball + first], u[6 * ball + first + 1], u[6 * ball + first + 2]};
  };
  const auto add = [&](Eigen::Index ball, const Vec3& f, const Vec3& t) {
    out.segment<6>(6 * ball) += (Eigen::Matrix<double, 6, 1>() << f.x, f.y, f.z, t.x, t.y, t.z).finished();
  };
  for (Eigen::Index i = 0; i + 1 < balls; ++i) {
    const Vec3 x{1, 0, 0}, move = part(i + 1, 0) - part(i, 0), branch = x * p.rest_length + move;
    const Vec3 turn_i = part(i, 3), turn_j = part(i + 1, 3);
    BondForce f;
    if (incremental) {
      BondHistory h;
      bool broken = false;
      f = incremental_bond(p, {branch, move, turn_i, turn_j}, 1.0, h, broken);
    } else {
      const Quaternion qi = turned({}, turn_i, 1.0), qj = turned({}, turn_j, 1.0);
      f = history_free_bond(p, branch, {}, rotate(qi, x) + rotate(qj, x), qi, qj);
    }
    add(i, f.force, f.couple + f.moment);
    add(i + 1, -f.force, f.couple - f.moment);
  }
  return out;
}

/// Displacement of the last ball under the load on it.
Eigen::Matrix<double, 6, 1> tip_motion(int bonds, bool incremental, int loaded_direction) {
  const BondParameters p = bond_parameters({k_radius, 1.0, k_modulus, 4.0, 1.0, 1.0, 0.0, 30e200, 30e200, false});
  const Eigen::Index n = 6 * (bonds + 1);
  Eigen::MatrixXd stiffness(n, n);
  const double step = 1e-5;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd u = Eigen::VectorXd::Unit(n, k) * step;
    stiffness.col(k) = (chain_loads(p, -u, incremental) - chain_loads(p, u, incremental)) / (2.0 * step);
  }
  const Eigen::VectorXd load = Eigen::VectorXd::Unit(n - 6, n - 12 + loaded_direction);
  const Eigen::VectorXd u = stiffness.bottomRightCorner(n - 6, n - 6).partialPivLu().solve(load);
  return u.tail<6>();
}

class Cantilever : public ::testing::TestWithParam<bool> {};

TEST_P(Cantilever, TipDeflection) {
  // Numbers of the closed form for r = E = P = 1, kappa = 4.
  const std::vector<std::pair<int, double>> expected = {
      {1, 5.092958}, {2, 30.557749}, {5, 432.901445}, {10, 3412.281980}};
  for (const auto& [bonds, deflection] : expected) {
    EXPECT_NEAR(tip_motion(bonds, GetParam(), 1)[1], deflection, 2e-6 * deflection) << bonds << " bonds";
    EXPECT_NEAR(tip_motion(bonds, GetParam(), 2)[2], deflection, 2e-6 * deflection) << bonds << " bonds";
  }
}

TEST_P(Cantilever, TwistAndStretch) {
  for (const int bonds : {1, 3, 10}) {
    const double length = 2.0 * bonds;
    // J = pi/2, A = pi.
    EXPECT_NEAR(tip_motion(bonds, GetParam(), 3)[3], 4.0 * length / (0.5 * test::k_pi), 1e-6 * length);
    EXPECT_NEAR(tip_motion(bonds, GetParam(), 0)[0], length / test::k_pi, 1e-6 * length);
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, Cantilever, ::testing::Values(false, true),
                         [](const auto& tested) { return tested.param ? "incremental" : "history_free"; });

}  // namespace
