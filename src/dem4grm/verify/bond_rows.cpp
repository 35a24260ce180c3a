// SPDX-License-Identifier: BSD-3-Clause
// Rows of balls longer than the engine can cut out of a grain: statics of the law functions that it calls.
#include <fmt/format.h>

#include <Eigen/Dense>

#include "dem4grm/grains/material.hpp"
#include "dem4grm/laws/parallel_bond.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"
#include "dem4grm/verify/bond_checks.hpp"

namespace dem::verify {

namespace {

constexpr double k_tolerance = 2e-6;
constexpr double k_law_modulus = 1.0, k_law_radius = 1.0;

/// Loads (force, torque) on every ball of a chain along x whose balls are moved and turned by `u`, six values each.
Eigen::VectorXd chain_loads(const BondParameters& p, const Eigen::VectorXd& u, BondForm form) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(u.size());
  const auto part = [&](Eigen::Index k) { return Vec3{u[k], u[k + 1], u[k + 2]}; };
  const auto add = [&](Eigen::Index ball, const Vec3& f, const Vec3& t) {
    out.segment<6>(6 * ball) += (Eigen::Matrix<double, 6, 1>() << f.x, f.y, f.z, t.x, t.y, t.z).finished();
  };
  for (Eigen::Index i = 0; i + 1 < u.size() / 6; ++i) {
    const Vec3 x{1, 0, 0}, move = part(6 * i + 6) - part(6 * i), branch = x * p.rest_length + move;
    const Vec3 turn_i = part(6 * i + 3), turn_j = part(6 * i + 9);
    BondForce f;
    if (form == BondForm::incremental) {
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

/// Deflection of the last ball under a unit force across.
double law_deflection(int bonds, BondForm form) {
  const BondParameters p =
      bond_parameters({k_law_radius, 1.0, k_law_modulus, 4.0, 1.0, 1.0, 0.0, 30e200, 30e200, false});
  const Eigen::Index n = 6 * (bonds + 1);
  Eigen::MatrixXd stiffness(n, n);
  const double step = 1e-5;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd u = Eigen::VectorXd::Unit(n, k) * step;
    stiffness.col(k) = (chain_loads(p, -u, form) - chain_loads(p, u, form)) / (2.0 * step);
  }
  const Eigen::VectorXd load = Eigen::VectorXd::Unit(n - 6, n - 11);
  const Eigen::VectorXd u = stiffness.bottomRightCorner(n - 6, n - 6).partialPivLu().solve(load);
  return u[n - 11];
}

}  // namespace

void check_row_statics(Findings& findings) {
  // For r = E = P = 1 and kappa = 4.
  const std::pair<int, double> expected[] = {{1, 5.092958}, {2, 30.557749}, {5, 432.901445}, {10, 3412.281980}};
  for (const auto& [bonds, deflection] : expected) {
    for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
      const char* name = form == BondForm::incremental ? "incremental" : "history-free";
      findings.relative(fmt::format("w E r / P, N = {}, statics of the {} law", bonds, name), "1", deflection,
                        law_deflection(bonds, form), k_tolerance, "separate stiffness matrix, seven digits");
    }
  }
}

}  // namespace dem::verify
