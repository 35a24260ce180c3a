// SPDX-License-Identifier: BSD-3-Clause
// Small-strain elasticity of the rubber grain, from the stiffness matrix that the engine has.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/verify/driven_grain.hpp"
#include "dem4grm/verify/grain_checks.hpp"
#include "dem4grm/verify/grain_statics.hpp"

namespace dem::verify {

namespace {

constexpr double k_radius = 0.65e-3, k_modulus = 20e6;

Scene elastic_grain(const BondSettings& bond) {
  Scene scene = lone_grain(k_radius);
  scene.bond = bond;
  scene.bond.damping_ratio = 0.0;
  scene.bond.linear_spring = false;
  return scene;
}

BondSettings bond_of(double kappa, double moment_scale, double radius_multiplier = 1.0) {
  BondSettings b;
  b.stiffness_ratio = kappa;
  b.moment_scale = moment_scale;
  b.radius_multiplier = radius_multiplier;
  return b;
}

/// Energy of the grain when its ball centres follow a homogeneous strain and no ball turns, over the volume of its
/// eight cells, J/m3.
double energy_density(const Eigen::MatrixXd& stiffness, const Eigen::Matrix3d& strain) {
  const double a = k_grain_lattice * k_radius;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(k_grain_dofs);
  for (int slot = 0; slot < k_grain_balls; ++slot) u.segment<3>(6 * slot) = strain * eigen_vector(grain_site(slot)) * a;
  return 0.5 * u.dot(stiffness * u) / (8.0 * a * a * a);
}

/// The cubic moduli C11, C12, C44 from three energies, Pa.
struct CubicModuli {
  double c11, c12, c44;
  explicit CubicModuli(const Eigen::MatrixXd& stiffness) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
    const Eigen::Matrix3d along = x * x.transpose(), shear = 0.5 * (x * y.transpose() + y * x.transpose());
    c11 = 2.0 * energy_density(stiffness, along);
    c12 = energy_density(stiffness, Eigen::Matrix3d(along + y * y.transpose())) - c11;
    c44 = 2.0 * energy_density(stiffness, shear);
  }
};

/// The two largest differences of a kind of block, over its largest entry.
double block_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, int row, int column) {
  double largest = 0.0, worst = 0.0;
  for (int i = 0; i < k_grain_balls; ++i) {
    for (int j = 0; j < k_grain_balls; ++j) {
      const auto p = a.block<3, 3>(6 * i + row, 6 * j + column), q = b.block<3, 3>(6 * i + row, 6 * j + column);
      worst = std::max(worst, (p - q).cwiseAbs().maxCoeff());
      largest = std::max(largest, q.cwiseAbs().maxCoeff());
    }
  }
  return worst / largest;
}

/// With the linear springs, which only push: solve, mark the shortened bonds, solve again until the set stands still.
PlatenTest squeeze_with_springs(double kappa, bool& settles) {
  std::array<bool, k_grain_bonds> squeezed{};
  PlatenTest t;
  for (int round = 0; round < 30; ++round) {
    t = squeeze(beam_grain_stiffness(k_radius, beam_stiffness(k_radius, k_modulus, kappa), squeezed), k_radius);
    std::array<bool, k_grain_bonds> next{};
    for (std::size_t b = 0; b < k_grain_bonds; ++b) {
      const SlotPair pair = k_bonds_of_grain[b];
      const Eigen::Vector3d n = eigen_vector(grain_site(pair.j) - grain_site(pair.i)).normalized();
      next[b] = n.dot(t.motion.segment<3>(6 * pair.j) - t.motion.segment<3>(6 * pair.i)) < 0.0;
    }
    settles = next == squeezed;
    if (settles) return t;
    squeezed = next;
  }
  return t;
}

/// Puts the engine's grain into that solution: the platens must carry its load and all other balls be at rest.
void check_springs(Findings& findings, double kappa, double poisson_ratio) {
  bool settles = false;
  const PlatenTest t = squeeze_with_springs(kappa, settles);
  const std::string setting = fmt::format("kappa = {}, linear springs", kappa);
  findings.absolute("Poisson's ratio of the statics, " + setting, "1", poisson_ratio, settles ? t.poisson_ratio : -1.0,
                    6e-4, "two separate calculations, three digits");
  Scene scene = lone_grain(k_radius);
  scene.bond.stiffness_ratio = kappa;
  const double approach = 1e-6 * k_radius;
  const Eigen::VectorXd loads = engine_loads(scene, t.motion * (0.5 * approach));
  double top = 0.0, worst = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const double z = grain_site(slot).z;
    const bool is_held = std::fabs(z) == 1.0;
    if (z == 1.0) top += loads[6 * slot + 2];
    for (int c = 0; c < 6; ++c) {
      if (!(is_held && c == 2)) worst = std::max(worst, std::abs(loads[6 * slot + c]) / (c < 3 ? 1.0 : k_radius));
    }
  }
  findings.relative("engine's platen load in that solution, " + setting, "N", t.stiffness * approach, top, 1e-4,
                    "statics of beams");
  findings.at_most("engine's largest load on a free ball over the platen load, " + setting, "1", 1e-4, worst / top,
                   "statics of beams");
}

struct PlatenRow {
  double kappa, scale, lambda;
  Platens platens;
  double stiffness, poisson_ratio;  ///< K / (E r), 0 when not tabulated
};

}  // namespace

void check_grain_stiffness(Findings& findings) {
  for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
    BondSettings bond = bond_of(3.0, 0.7);
    bond.form = form;
    const Eigen::MatrixXd engine = engine_stiffness(elastic_grain(bond));
    const Eigen::MatrixXd beams = beam_grain_stiffness(k_radius, beam_stiffness(k_radius, k_modulus, 3.0, 0.7));
    const char* name = form == BondForm::incremental ? "incremental" : "history-free";
    const std::tuple<int, int, const char*> blocks[] = {{0, 0, "force by displacement"},
                                                        {0, 3, "force by turn"},
                                                        {3, 0, "torque by displacement"},
                                                        {3, 3, "torque by turn"}};
    for (const auto& [row, column, what] : blocks) {
      findings.at_most(fmt::format("largest difference, {}, {}", what, name), "1", 1e-5,
                       block_difference(engine, beams, row, column), "Hessian of the energy of 64 beams");
    }
    const double skew = (engine - engine.transpose()).cwiseAbs().maxCoeff() / engine.cwiseAbs().maxCoeff();
    findings.at_most(fmt::format("asymmetry of the matrix, {}", name), "1", 1e-6, skew, "elastic bonds");
  }
}

void check_grain_lattice(Findings& findings) {
  for (const double kappa : {1.0, 2.0, 4.0, 8.0}) {
    const CubicModuli c(engine_stiffness(elastic_grain(bond_of(kappa, 1.0))));
    const double a = k_grain_lattice * k_radius, kn = k_pi * k_radius * k_modulus / 2.0, ks = kn / kappa;
    const std::string at = fmt::format(", kappa = {}", kappa);
    const char* source = "sum over the bonds of the infinite lattice";
    findings.relative("C11" + at, "Pa", 2.0 / (3.0 * a) * (kn + 2.0 * ks), c.c11, 1e-6, source);
    if (kappa == 1.0) {
      findings.absolute("C12" + at, "Pa", 0.0, c.c12, 1e-6 * c.c11, source);
    } else {
      findings.relative("C12" + at, "Pa", 2.0 / (3.0 * a) * (kn - ks), c.c12, 1e-6, source);
    }
    findings.relative("C44" + at, "Pa", 2.0 / (3.0 * a) * (kn + 0.5 * ks), c.c44, 1e-6, source);
    const double poisson_ratio = c.c12 / (c.c11 + c.c12);
    findings.absolute("Poisson's ratio along a cube axis" + at, "1", (kappa - 1.0) / (2.0 * kappa + 1.0), poisson_ratio,
                      1e-6, "(kappa - 1) / (2 kappa + 1)");
  }
}

void check_grain_platens(Findings& findings) {
  constexpr Platens smooth = Platens::smooth, stuck = Platens::stuck;
  const PlatenRow rows[] = {
      {4, 1, 1, smooth, 1.737, 0.371}, {4, 1, 0.5, smooth, 0.343, 0.412}, {4, 0, 1, smooth, 0.8494, 0.500},
      {4, 1, 1, stuck, 2.589, 0.101},  {4, 1, 0.5, stuck, 0.617, 0.083},  {4, 0, 1, stuck, 2.289, 0.057},
      {1, 1, 1, smooth, 0, 0.000},     {2, 1, 1, smooth, 0, 0.229},       {3, 1, 1, smooth, 0, 0.322},
      {5, 1, 1, smooth, 0, 0.400},     {8, 1, 1, smooth, 0, 0.441},       {1000, 1, 1, smooth, 0, 0.499},
      {2, 0, 1, smooth, 0, 0.327},     {3, 0, 1, smooth, 0, 0.445},       {3.5, 0, 1, smooth, 0, 0.477},
      {5, 0, 1, smooth, 0, 0.529},     {8, 0, 1, smooth, 0, 0.559},       {4, 0.05, 1, smooth, 0, 0.466},
      {4, 0.1, 1, smooth, 0, 0.445},   {4, 0.25, 1, smooth, 0, 0.412},    {4, 0.5, 1, smooth, 0, 0.389},
  };
  Picture p{"grain-poisson-ratio", "Poisson's ratio of the inner cube, smooth platens", "kappa", "Poisson's ratio", {}};
  p.series = {{"engine, bonds with moments", false, {}, {}},
              {"earlier calculation, with moments", true, {}, {}},
              {"engine, no moments", false, {}, {}},
              {"earlier calculation, no moments", true, {}, {}}};
  std::vector<std::array<double, 4>> drawn;
  for (const PlatenRow& row : rows) {
    const PlatenTest t =
        squeeze(engine_stiffness(elastic_grain(bond_of(row.kappa, row.scale, row.lambda))), k_radius, row.platens);
    const std::string at = fmt::format("kappa = {}, s = {}, lambda = {}, {} platens", row.kappa, row.scale, row.lambda,
                                       row.platens == smooth ? "smooth" : "stuck");
    const char* source = "two separate calculations, three digits";
    if (row.stiffness > 0.0) {
      findings.absolute("K / (E r), " + at, "1", row.stiffness, t.stiffness / (k_modulus * k_radius), 6e-4, source);
    }
    findings.absolute("Poisson's ratio, " + at, "1", row.poisson_ratio, t.poisson_ratio, 6e-4, source);
    if (row.platens == smooth && row.lambda == 1.0 && row.kappa < 100.0 && (row.scale == 0.0 || row.scale == 1.0)) {
      drawn.push_back({row.scale, row.kappa, t.poisson_ratio, row.poisson_ratio});
    }
  }
  std::sort(drawn.begin(), drawn.end());
  for (const auto& [scale, kappa, found, expected] : drawn) {
    const std::size_t first = scale > 0.0 ? 0 : 2;
    p.series[first].x.push_back(kappa);
    p.series[first].y.push_back(found);
    p.series[first + 1].x.push_back(kappa);
    p.series[first + 1].y.push_back(expected);
  }
  findings.picture(p);
  const std::pair<double, double> springs[] = {{1, 0.240}, {2, 0.387}, {3, 0.435}, {4, 0.456}, {5, 0.467}, {8, 0.481}};
  for (const auto& [kappa, poisson_ratio] : springs) check_springs(findings, kappa, poisson_ratio);
}

}  // namespace dem::verify
