// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/time_step.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/stiffest_mode.hpp"
#include "dem4grm/laws/mixing.hpp"

namespace dem {

namespace {

constexpr double k_second_neighbour_overlap = 0.15;  // of the ball radius
constexpr double k_outer_overlap = 0.2;              // of the ball radius
constexpr int k_outer_contacts = 2;                  // per exposed side of a surface ball
constexpr int k_dofs = 6 * k_grain_balls;

using Matrix = Eigen::MatrixXd;

/// Mass-scaled stiffness and damping of one grain: unknowns u sqrt(m) and theta sqrt(I).
struct GrainMatrices {
  Matrix stiffness = Matrix::Zero(k_dofs, k_dofs);
  Matrix damping = Matrix::Zero(k_dofs, k_dofs);
};

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Stiffness of one joint: normal, shear, bending, twisting.
struct Joint {
  double normal = 0.0, shear = 0.0, bending = 0.0, twisting = 0.0;
};

/// Adds weight * B^T D B, B the relative motions of balls i and j (j < 0: a rigid partner) at lever l along n.
void add_joint(Matrix& k, int i, int j, const Eigen::Vector3d& n, double lever, const Joint& joint, double mass,
               double inertia) {
  const double su = 1.0 / std::sqrt(mass), st = 1.0 / std::sqrt(inertia);
  Eigen::Matrix<double, 6, 12> b = Eigen::Matrix<double, 6, 12>::Zero();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  // Relative displacement at the contact point, u_j - u_i - l (theta_i + theta_j) x n, and relative rotation.
  b.block<3, 3>(0, 0) = -identity * su;
  b.block<3, 3>(0, 3) = lever * cross_matrix(n) * st;
  b.block<3, 3>(3, 3) = -identity * st;
  if (j >= 0) {
    b.block<3, 3>(0, 6) = identity * su;
    b.block<3, 3>(0, 9) = lever * cross_matrix(n) * st;
    b.block<3, 3>(3, 9) = identity * st;
  }
  const Eigen::Matrix3d along = n * n.transpose(), across = identity - along;
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.block<3, 3>(0, 0) = joint.normal * along + joint.shear * across;
  d.block<3, 3>(3, 3) = joint.twisting * along + joint.bending * across;
  const Eigen::Matrix<double, 12, 12> local = b.transpose() * d * b;
  k.block<6, 6>(6 * i, 6 * i) += local.block<6, 6>(0, 0);
  if (j < 0) return;
  k.block<6, 6>(6 * i, 6 * j) += local.block<6, 6>(0, 6);
  k.block<6, 6>(6 * j, 6 * i) += local.block<6, 6>(6, 0);
  k.block<6, 6>(6 * j, 6 * j) += local.block<6, 6>(6, 6);
}

Joint hertz_joint(const HertzParameters& p, double overlap) {
  const double k = 1.5 * p.hertz * std::sqrt(overlap);
  return {k, k * p.shear_ratio, 0.0, 0.0};
}

/// Dashpots of a contact of those stiffnesses, N s/m (laws/hertz_mindlin.hpp).
Joint hertz_dashpots(const ContactSettings& c, const Joint& stiffness, double reduced_mass) {
  return {2.0 * c.normal_damping_ratio * std::sqrt(reduced_mass * stiffness.normal),
          2.0 * c.shear_damping_ratio * std::sqrt(reduced_mass * stiffness.shear), 0.0, 0.0};
}

GrainMatrices loaded_grain(const Scene& scene) {
  const double r = scene.rubber_ball_radius;
  const double mass = 4.0 / 3.0 * std::numbers::pi * r * r * r * scene.rubber.density, inertia = 0.4 * mass * r * r;
  const BondSettings& settings = scene.bond;
  const BondParameters bond =
      bond_parameters({r, mass, settings.modulus, settings.stiffness_ratio, settings.radius_multiplier,
                       settings.moment_scale, settings.damping_ratio, settings.tensile_strength,
                       settings.shear_strength, settings.linear_spring, settings.spring_friction});
  const Elastic rubber{scene.rubber.shear_modulus, scene.rubber.poisson_ratio};
  const MixedElastic own = mix(rubber, rubber);
  const MixedElastic outer = mix(rubber, {scene.walls.shear_modulus, scene.walls.poisson_ratio});
  const HertzParameters inner_contact{hertz_coefficient(own, r, r), mindlin_ratio(own), 0, 0, 0};
  const HertzParameters outer_contact{hertz_coefficient(outer, r, 0.0), mindlin_ratio(outer), 0, 0, 0};

  GrainMatrices g;
  const auto direction = [](const SlotPair& p) -> Eigen::Vector3d {
    return (eigen(grain_site(p.j)) - eigen(grain_site(p.i))).normalized();
  };
  const Joint inside = hertz_joint(inner_contact, k_second_neighbour_overlap * r);
  const Joint inside_dashpots = hertz_dashpots(scene.contact, inside, 0.5 * mass);
  for (const SlotPair& p : k_bonds_of_grain) {
    const Eigen::Vector3d n = direction(p);
    add_joint(g.stiffness, p.i, p.j, n, r,
              {bond.normal_stiffness + bond.linear_stiffness, bond.shear_stiffness, bond.bending_stiffness,
               bond.twisting_stiffness},
              mass, inertia);
    add_joint(g.damping, p.i, p.j, n, r, {bond.dashpot, 0, 0, 0}, mass, inertia);
    if (settings.spring_friction > 0.0) {
      add_joint(g.stiffness, p.i, p.j, n, r, {0, bond.linear_shear_stiffness, 0, 0}, mass, inertia);
    }
    if (settings.hertz_contact) {
      add_joint(g.stiffness, p.i, p.j, n, r, inside, mass, inertia);
      add_joint(g.damping, p.i, p.j, n, r, inside_dashpots, mass, inertia);
    }
  }
  for (const SlotPair& p : k_second_neighbours_of_grain) {
    add_joint(g.stiffness, p.i, p.j, direction(p), r, inside, mass, inertia);
    add_joint(g.damping, p.i, p.j, direction(p), r, inside_dashpots, mass, inertia);
  }
  const Joint side = hertz_joint(outer_contact, k_outer_overlap * r);
  const Joint side_dashpots = hertz_dashpots(scene.contact, side, mass);
  for (int slot = 0; slot < k_grain_corners; ++slot) {
    const Eigen::Vector3d site = eigen(grain_site(slot));
    for (int axis = 0; axis < 3; ++axis) {
      if (site[axis] == 0.0) continue;
      const Eigen::Vector3d n = Eigen::Vector3d::Unit(axis) * site[axis];
      for (int k = 0; k < k_outer_contacts; ++k) {
        add_joint(g.stiffness, slot, -1, n, r, side, mass, inertia);
        add_joint(g.damping, slot, -1, n, r, side_dashpots, mass, inertia);
      }
    }
  }
  return g;
}

double largest_eigenvalue(const Matrix& m) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(m, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// Largest dt with an eigenvalue of dt^2 K + 2 dt C below 4, both mass-scaled; infinite without stiffness.
double stable_step(const Matrix& stiffness, const Matrix& damping) {
  double low = 0.0, high = 2.0 / std::sqrt(largest_eigenvalue(stiffness));
  if (!(high < std::numeric_limits<double>::infinity()) || damping.isZero(0.0)) return high;
  // The border grows steadily with dt; thirty halvings leave far less than a nanosecond.
  for (int i = 0; i < 30 && high - low > 1e-11; ++i) {
    const double middle = 0.5 * (low + high);
    (largest_eigenvalue(middle * middle * stiffness + 2.0 * middle * damping) < 4.0 ? low : high) = middle;
  }
  return low;
}

/// The same for one degree of freedom.
double stable_step(double stiffness, double damping) {
  return 4.0 / (damping + std::sqrt(damping * damping + 4.0 * stiffness));
}

/// Stiffness and damping of one clump in its contacts about its centroid, scaled with mass and smallest inertia.
struct ClumpMatrices {
  Matrix stiffness = Matrix::Zero(6, 6), damping = Matrix::Zero(6, 6);
};

ClumpMatrices clump_matrices(const Simulation& s, std::size_t c) {
  ClumpMatrices out;
  const bool dashpots = !s.contacts.normal_dashpot.empty();
  const Clump& body = s.clumps.clumps[c];
  const double least = std::min({body.inertia.x, body.inertia.y, body.inertia.z});
  const std::size_t owner = static_cast<std::size_t>(s.balls.n_blocks) + c;
  for (int q = s.references.start[owner]; q < s.references.start[owner + 1]; ++q) {
    const auto row = static_cast<std::size_t>(s.references.row[static_cast<std::size_t>(q)]);
    if (!(s.contacts.state[row].overlap > 0.0)) continue;
    const int place = s.references.place[static_cast<std::size_t>(q)];
    const bool second = (place & ContactReferences::k_second) != 0;
    const int i = place & ~ContactReferences::k_second;
    const double overlap = s.contacts.state[row].overlap;
    const Joint joint = hertz_joint({s.contacts.hertz[row], s.contacts.shear_ratio[row], 0, 0, 0}, overlap);
    const Eigen::Vector3d n = eigen(s.contacts.state[row].normal * (second ? -1.0 : 1.0));
    const Eigen::Vector3d arm =
        eigen(s.balls.position(i) - body.position) + n * (second ? s.contacts.lever_j(row) : s.contacts.lever_i(row));
    Eigen::Matrix<double, 3, 6> b;
    b.leftCols<3>() = Eigen::Matrix3d::Identity() / std::sqrt(body.mass);
    b.rightCols<3>() = -cross_matrix(arm) / std::sqrt(least);
    const Eigen::Matrix3d along = n * n.transpose();
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - along;
    out.stiffness += b.transpose() * (joint.normal * along + joint.shear * across) * b;
    if (!dashpots) continue;
    const double fourth_root = std::sqrt(std::sqrt(overlap));
    out.damping += b.transpose() * (s.contacts.normal_dashpot[row] * along + s.contacts.shear_dashpot[row] * across) *
                   (fourth_root * b);
  }
  return out;
}

}  // namespace

TimeStepLimit loaded_grain_limit(const Scene& scene) {
  const GrainMatrices g = loaded_grain(scene);
  return {stable_step(g.stiffness, g.damping), "loaded rubber grain"};
}

TimeStepLimit diagonal_grain_limit(const Scene& scene) {
  const GrainMatrices g = loaded_grain(scene);
  return {1.0 / std::sqrt(g.stiffness.diagonal().maxCoeff()), "rubber ball, diagonal estimate"};
}

TimeStepLimit clump_limit(const Simulation& s) {
  double shortest = std::numeric_limits<double>::infinity();
  if (s.references.start.empty()) return {shortest, "no contacts"};
  for (std::size_t c = 0; c < s.clumps.clumps.size(); ++c) {
    const ClumpMatrices m = clump_matrices(s, c);
    // The trace bounds the largest eigenvalue, so most clumps need no more.
    if (stable_step(2.0 * m.stiffness.trace(), 2.0 * m.damping.trace()) >= shortest) continue;
    shortest = std::min(shortest, stable_step(2.0 * m.stiffness, 2.0 * m.damping));
  }
  return {shortest, std::isinf(shortest) ? "no contacts" : "stiffest clump in its contacts"};
}

TimeStepLimit expected_clump_limit(const Simulation& s, double stress) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Clump& body : s.clumps.clumps) {
    const MaterialSettings& m = body.material == k_rubber ? s.scene.rubber : s.scene.gravel;
    const Elastic elastic{m.shear_modulus, m.poisson_ratio};
    const MixedElastic mixed = mix(elastic, elastic);
    double radius = 0.0;
    for (int p = body.first_pebble; p < body.first_pebble + body.n_pebbles; ++p) {
      radius = std::max(radius, s.balls.pebble_radius(p));
    }
    const double force = 10.0 * stress * body.size * body.size;
    const double h = hertz_coefficient(mixed, radius, radius);
    const double k = 1.5 * std::cbrt(h * h * force);
    // Twelve contacts spread evenly: a third of each normal stiffness and two thirds of each shear stiffness per axis.
    const Joint spring{k, k * mindlin_ratio(mixed), 0.0, 0.0};
    const Joint dashpot = hertz_dashpots(s.scene.contact, spring, 0.5 * body.mass);
    const double stiffness = 12.0 * (spring.normal + 2.0 * spring.shear) / 3.0;
    const double damping = 12.0 * (dashpot.normal + 2.0 * dashpot.shear) / 3.0;
    shortest = std::min(shortest, stable_step(2.0 * stiffness / body.mass, 2.0 * damping / body.mass));
  }
  return {shortest, "expected contacts of the smallest clump"};
}

double rounded_down_to_nanosecond(double t) { return std::floor(t * 1e9) * 1e-9; }

double safe_share(double safety, double local_damping) {
  constexpr double k_room = 0.88;
  return std::min(safety, k_room / std::sqrt(1.0 + local_damping));
}

namespace {

double safe_share(const Simulation& s) {
  return dem::safe_share(s.scene.integration.time_step_safety, s.scene.integration.local_damping);
}

}  // namespace

TimeStepLimit choose_time_step(const Simulation& s, double stress) {
  TimeStepLimit limit = expected_clump_limit(s, stress);
  if (s.balls.n_grains > 0) {
    const bool diagonal = s.scene.integration.time_step_rule == TimeStepRule::diagonal;
    const TimeStepLimit grain = diagonal ? diagonal_grain_limit(s.scene) : loaded_grain_limit(s.scene);
    if (grain.seconds < limit.seconds) limit = grain;
  }
  const TimeStepLimit present = clump_limit(s);
  if (present.seconds < limit.seconds) limit = present;
  return {rounded_down_to_nanosecond(safe_share(s) * limit.seconds), limit.limited_by};
}

void review_time_step(Simulation& s, double longest) {
  const int interval = s.balls.n_grains > 0 ? k_review_interval_with_rubber : k_review_interval;
  const IntegrationSettings& settings = s.scene.integration;
  if (s.steps % interval != 0 || settings.time_step_rule == TimeStepRule::diagonal) return;
  const double share = safe_share(s), stable = stable_time_step(s, s.dt / share);
  const double next = rounded_down_to_nanosecond(std::min(share * stable, k_largest_rise * s.dt));
  if (!(next >= k_largest_fall * s.dt)) {
    throw PhysicsError(fmt::format(
        "the stiffest contacts allow a time step of {:.3g} s after {:.3g} s at the last look: they are pressed "
        "together "
        "far beyond what the stress explains (step {}). Try a smaller integration.time_step_safety or a slower motion",
        share * stable, s.dt, s.steps));
  }
  s.change_time_step(std::min(next, longest));
}

}  // namespace dem
