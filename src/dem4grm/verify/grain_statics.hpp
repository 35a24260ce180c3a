// SPDX-License-Identifier: BSD-3-Clause
// Linear statics of one rubber grain: its stiffness as the engine has it, as beam theory has it, and between platens.
//
// The engine's matrix comes from the engine alone: move or turn one ball a little, make one step, read the change of
// momentum. The other is assembled here from the elastic energy of 64 short beams; it shares no code with the library
// beyond the list of bonds.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <vector>

#include "dem4grm/laws/rigid_rotation.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

inline constexpr Eigen::Index k_grain_dofs = 6 * k_grain_balls;

inline Eigen::Vector3d eigen_vector(const Vec3& v) { return {v.x, v.y, v.z}; }

/// One grain at the origin, no dashpots, time step 1 ns.
inline Scene lone_grain(double radius = 0.65e-3) {
  Scene s = model_scene();
  s.rubber_ball_radius = radius;
  s.bond.damping_ratio = 0.0;
  s.grains = {{{0, 0, 0}, {}}};
  return s;
}

/// Force (N) and torque (N m) on every ball when the balls are moved (m) and turned (rad) by u. The velocities are
/// those that lead there in one step, which is what the incremental bonds need.
inline Eigen::VectorXd engine_loads(const Scene& scene, const Eigen::VectorXd& u) {
  const double dt = 1e-9;
  Simulation s(scene);
  s.set_time_step(dt);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    const Vec3 move{u[6 * slot], u[6 * slot + 1], u[6 * slot + 2]};
    const Vec3 turn{u[6 * slot + 3], u[6 * slot + 4], u[6 * slot + 5]};
    s.balls.set_position(i, s.balls.position(i) + move);
    s.balls.set_velocity(i, move * (1.0 / dt));
    s.balls.set_spin(i, turn * (1.0 / dt));
    s.balls.set_orientation(i, turned(s.balls.orientation(i), turn, 1.0));
  }
  const Simulation before = s;
  s.step();
  const double m = s.rubber().ball_mass, r = scene.rubber_ball_radius;
  Eigen::VectorXd loads(k_grain_dofs);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(0, slot);
    loads.segment<3>(6 * slot) = eigen_vector(s.balls.velocity(i) - before.balls.velocity(i)) * (m / dt);
    loads.segment<3>(6 * slot + 3) = eigen_vector(s.balls.spin(i) - before.balls.spin(i)) * (0.4 * m * r * r / dt);
  }
  return loads;
}

/// Stiffness of the grain from the engine, by central differences; the linear springs must be off (they only push).
inline Eigen::MatrixXd engine_stiffness(const Scene& scene) {
  Eigen::MatrixXd k(k_grain_dofs, k_grain_dofs);
  for (Eigen::Index c = 0; c < k_grain_dofs; ++c) {
    const double step = 1e-6 * (c % 6 < 3 ? scene.rubber_ball_radius : 1.0);
    const Eigen::VectorXd u = Eigen::VectorXd::Unit(k_grain_dofs, c) * step;
    k.col(c) = (engine_loads(scene, -u) - engine_loads(scene, u)) / (2.0 * step);
  }
  return k;
}

/// Stiffness of a short beam of the bond: axial, shear, bending, twisting, and a spring beside it.
struct BeamStiffness {
  double axial = 0.0, shear = 0.0, bending = 0.0, twisting = 0.0;
};

inline BeamStiffness beam_stiffness(double radius, double modulus, double ratio, double moment_scale = 1.0) {
  const double area = k_pi * radius * radius, second_moment = 0.25 * area * radius * radius, length = 2.0 * radius;
  return {modulus * area / length, modulus / ratio * area / length, moment_scale * modulus * second_moment / length,
          moment_scale * modulus / ratio * 2.0 * second_moment / length};
}

/// Sum over the bonds of the Hessian of 1/2 sum k e^2, with e the six strains of a beam in its own axes. Bonds marked
/// in `squeezed` have a second axial spring of the same size.
inline Eigen::MatrixXd beam_grain_stiffness(double radius, const BeamStiffness& beam,
                                            const std::array<bool, k_grain_bonds>& squeezed = {}) {
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(k_grain_dofs, k_grain_dofs);
  for (std::size_t b = 0; b < k_grain_bonds; ++b) {
    const SlotPair pair = k_bonds_of_grain[b];
    const Eigen::Vector3d n = eigen_vector(grain_site(pair.j) - grain_site(pair.i)).normalized();
    const Eigen::Vector3d t = n.unitOrthogonal(), s = n.cross(t);
    Eigen::Matrix<double, 6, Eigen::Dynamic> e = Eigen::MatrixXd::Zero(6, k_grain_dofs);
    const Eigen::Index i = 6 * pair.i, j = 6 * pair.j;
    const auto stretch_along = [&](int row, const Eigen::Vector3d& axis) {
      e.block<1, 3>(row, i) = -axis.transpose();
      e.block<1, 3>(row, j) = axis.transpose();
      // The beam's middle moves with ball i by theta x (r n), with ball j by theta x (-r n).
      e.block<1, 3>(row, i + 3) = -radius * n.cross(axis).transpose();
      e.block<1, 3>(row, j + 3) = -radius * n.cross(axis).transpose();
    };
    const auto turn_about = [&](int row, const Eigen::Vector3d& axis) {
      e.block<1, 3>(row, i + 3) = -axis.transpose();
      e.block<1, 3>(row, j + 3) = axis.transpose();
    };
    stretch_along(0, n);
    stretch_along(1, t);
    stretch_along(2, s);
    turn_about(3, n);
    turn_about(4, t);
    turn_about(5, s);
    Eigen::Matrix<double, 6, 1> k;
    k << beam.axial * (squeezed[b] ? 2.0 : 1.0), beam.shear, beam.shear, beam.twisting, beam.bending, beam.bending;
    total += e.transpose() * k.asDiagonal() * e;
  }
  return total;
}

struct PlatenTest {
  double stiffness = 0.0;      ///< N/m, platen force over approach
  double poisson_ratio = 0.0;  ///< of the 8 cell centres
  Eigen::VectorXd motion;      ///< of all balls for an approach of 2 (m, rad)
};

enum class Platens {
  smooth,  ///< balls slide and turn freely
  stuck,   ///< balls do not slide, but turn freely
};

/// Squeezes the grain between two rigid platens: the 9 top balls move by -1 in z, the 9 bottom balls by +1.
inline PlatenTest squeeze(const Eigen::MatrixXd& stiffness, double radius, Platens platens = Platens::smooth) {
  std::vector<Eigen::Index> free_dofs;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(k_grain_dofs);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const double z = grain_site(slot).z;
    const bool held = z == 1.0 || z == -1.0;
    if (held) u[6 * slot + 2] = -z;
    for (int c = 0; c < 6; ++c) {
      if (!(held && (c == 2 || (platens == Platens::stuck && c < 2)))) free_dofs.push_back(6 * slot + c);
    }
  }
  // Unknowns in equal units, else the rank that the solver sees depends on the metre; three rigid motions remain free.
  const auto unit = [&](Eigen::Index dof) { return dof % 6 < 3 ? 1.0 : 1.0 / radius; };
  const auto n = static_cast<Eigen::Index>(free_dofs.size());
  Eigen::MatrixXd k(n, n);
  Eigen::VectorXd load(n);
  const Eigen::VectorXd from_platens = -(stiffness * u);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Index row = free_dofs[static_cast<std::size_t>(a)];
    load[a] = from_platens[row] * unit(row);
    for (Eigen::Index b = 0; b < n; ++b) {
      const Eigen::Index column = free_dofs[static_cast<std::size_t>(b)];
      k(a, b) = stiffness(row, column) * unit(row) * unit(column);
    }
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-7);
  solver.compute(k);
  const Eigen::VectorXd x = solver.solve(load);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Index dof = free_dofs[static_cast<std::size_t>(a)];
    u[dof] = x[a] * unit(dof);
  }
  PlatenTest out;
  const Eigen::VectorXd reaction = stiffness * u;
  double lateral = 0.0, axial = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const Vec3 site = grain_site(slot);
    if (site.z == 1.0) out.stiffness -= 0.5 * reaction[6 * slot + 2];
    if (slot < k_grain_corners) continue;
    lateral += u[6 * slot] * site.x + u[6 * slot + 1] * site.y;
    axial += u[6 * slot + 2] * site.z;
  }
  out.poisson_ratio = -0.5 * lateral / axial;
  out.motion = u;
  return out;
}

}  // namespace dem::verify
