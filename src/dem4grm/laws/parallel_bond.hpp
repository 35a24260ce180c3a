// SPDX-License-Identifier: BSD-3-Clause
// Linear parallel bond between two equal balls: a disc of elastic cement that carries force and moment.
//
// Conventions: n from i to j, L their distance, forces and moments on i (j gets minus both); tension makes F_n
// positive.
//
//   A = pi R^2, I = pi R^4 / 4, J = 2 I,   R = radius_multiplier * r            bond disc
//   k_n = E A / (2r),  k_s = k_n / kappa,  k_b = s E I / (2r),  k_t = s E J / (2r kappa)
//   F = F_n n + F_s,   T_i = (L/2) n x F + M,   T_j = (L/2) n x F - M
//   F_n = k_n (L - L0) + k_l min(L - L0, 0) + 2 b sqrt((m/2) k_l) v_n
//   k_l = pi r^2 E / (2r)  linear group beside the bond: a spring that only pushes, without friction
//
//   r ball radius, m; E bond modulus, Pa; kappa normal-to-shear ratio; s moment scale; b fraction of critical damping;
//   m ball mass, kg; v_n separation speed, m/s; L0 rest length, m.
// Source: Potyondy & Cundall (2004); PFC's linear parallel bond with stiffness from "deformability".
//
// Two forms of shear force and moment:
//  * history-free: F_s = k_s L [n - (t_i + t_j)/2] perpendicular to n, with t the bond's first direction carried by
//    each ball; M = k_b theta + (k_t - k_b) n (theta.n), theta = 2 vec(q_j q_i*) the turn of j against i. Exactly
//    objective, returns on every closed path; valid for relative turns below pi; cannot break.
//  * incremental: F_s += k_s v_s dt and M += k_b, k_t times the relative spin dt, both carried with the bond by exact
//    rotations. Can break: sigma = F_n/A + |M_b| R/I against the tensile strength, tau = |F_s|/A + |M_t| R/J against
//    shear.
// At small strain both are the same law; docs/decisions/0004-rubber-grain.md has what was measured.
#pragma once

#include <cmath>
#include <numbers>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/laws/hertz_mindlin.hpp"

namespace dem {

/// Constants of one bond; SI units.
struct BondParameters {
  double rest_length = 0.0;             ///< m
  double normal_stiffness = 0.0;        ///< k_n, N/m
  double shear_stiffness = 0.0;         ///< k_s, N/m
  double bending_stiffness = 0.0;       ///< k_b, N m/rad
  double twisting_stiffness = 0.0;      ///< k_t, N m/rad
  double linear_stiffness = 0.0;        ///< k_l, N/m; 0 when the linear spring is off
  double linear_shear_stiffness = 0.0;  ///< k_l / kappa, N/m; acts only when spring_friction > 0
  double spring_friction = 0.0;         ///< Coulomb coefficient of the linear spring
  double dashpot = 0.0;                 ///< N s/m
  double area = 0.0;                    ///< A, m2
  double bond_radius = 0.0;             ///< R, m
  double tensile_strength = 0.0;        ///< Pa
  double shear_strength = 0.0;          ///< Pa
};

/// Inputs of bond_parameters in the words of the case file.
struct BondDescription {
  double ball_radius = 0.0;  ///< m
  double ball_mass = 0.0;    ///< kg
  double modulus = 0.0;      ///< Pa
  double stiffness_ratio = 1.0;
  double radius_multiplier = 1.0;
  double moment_scale = 1.0;
  double damping_ratio = 0.0;
  double tensile_strength = 0.0;
  double shear_strength = 0.0;
  bool linear_spring = true;
  double spring_friction = 0.0;
};

inline BondParameters bond_parameters(const BondDescription& b) {
  BondParameters p;
  p.rest_length = 2.0 * b.ball_radius;
  p.bond_radius = b.radius_multiplier * b.ball_radius;
  p.area = std::numbers::pi * p.bond_radius * p.bond_radius;
  const double second_moment = 0.25 * p.area * p.bond_radius * p.bond_radius;
  const double per_length = b.modulus / p.rest_length;
  p.normal_stiffness = per_length * p.area;
  p.shear_stiffness = p.normal_stiffness / b.stiffness_ratio;
  p.bending_stiffness = b.moment_scale * per_length * second_moment;
  p.twisting_stiffness = b.moment_scale * per_length / b.stiffness_ratio * 2.0 * second_moment;
  const double linear_group = per_length * std::numbers::pi * b.ball_radius * b.ball_radius;
  p.linear_stiffness = b.linear_spring ? linear_group : 0.0;
  p.linear_shear_stiffness = p.linear_stiffness / b.stiffness_ratio;
  p.spring_friction = b.spring_friction;
  p.dashpot = 2.0 * b.damping_ratio * std::sqrt(0.5 * b.ball_mass * linear_group);
  p.tensile_strength = b.tensile_strength;
  p.shear_strength = b.shear_strength;
  return p;
}

/// Forces of one bond on ball i and its loss.
struct BondForce {
  Vec3 force;                  ///< F, N
  Vec3 couple;                 ///< (L/2) n x F, N m: adds to the torque of both balls
  Vec3 moment;                 ///< M, N m: plus on i, minus on j
  double dashpot_power = 0.0;  ///< W, taken out by the dashpot
};

/// F_n of the header, N, tension positive.
DEM_INLINE double bond_normal_force(const BondParameters& p, double length, double separation_speed) {
  const double stretch = length - p.rest_length;
  const double squeezed = stretch < 0.0 ? stretch : 0.0;
  return p.normal_stiffness * stretch + p.linear_stiffness * squeezed + p.dashpot * separation_speed;
}

/// Shear force of the linear spring, N, on ball i, and what it lost in this step, J.
struct SpringShear {
  Vec3 shear;
  double slip_work = 0.0;
};

/// formula:  F_s += (k_l/kappa) v_s dt, then cut to friction * k_l d;   d = 2r - L the overlap, no force when apart
/// An option beside the bond (spring_friction > 0); with friction 0 the spring only pushes. Source: linear group of PFC.
DEM_INLINE SpringShear linear_spring_shear(const BondParameters& p, const HertzMotion& m, double dt) {
  const Vec3 tried = m.carried_shear + m.shear_velocity * (p.linear_shear_stiffness * dt);
  const double limit = p.spring_friction * p.linear_stiffness * m.overlap;
  const double size = std::sqrt(dot(tried, tried));
  if (size <= limit) return {tried, 0.0};
  SpringShear out;
  out.shear = tried * (limit / size);
  const Vec3 slip = m.shear_velocity * dt - (out.shear - m.carried_shear) * (1.0 / p.linear_shear_stiffness);
  const double work = 0.5 * dot(out.shear + m.carried_shear, slip);
  out.slip_work = work > 0.0 ? work : 0.0;
  return out;
}

/// History-free form.
///   branch            x_j - x_i, m;   relative_velocity  v_j - v_i, m/s
///   direction_sum     t_i + t_j, the bond's first direction carried by ball i plus the same for ball j
///   qi, qj            orientations
DEM_INLINE BondForce history_free_bond(const BondParameters& p, const Vec3& branch, const Vec3& relative_velocity,
                                       const Vec3& direction_sum, const Quaternion& qi, const Quaternion& qj) {
  const double length = std::sqrt(dot(branch, branch));
  const double inverse = 1.0 / length;
  const Vec3 n = branch * inverse;
  const double speed = dot(relative_velocity, n);
  const double f_n = bond_normal_force(p, length, speed);
  const double shear = -0.5 * p.shear_stiffness * length;
  const Vec3 f_s = (direction_sum - n * dot(direction_sum, n)) * shear;
  // vec(q_j q_i*), twice: the small rotation vector of j against i.
  const Vec3 turn{2.0 * (qi.w * qj.x - qj.w * qi.x - (qj.y * qi.z - qj.z * qi.y)),
                  2.0 * (qi.w * qj.y - qj.w * qi.y - (qj.z * qi.x - qj.x * qi.z)),
                  2.0 * (qi.w * qj.z - qj.w * qi.z - (qj.x * qi.y - qj.y * qi.x))};
  BondForce out;
  out.force = n * f_n + f_s;
  out.couple = cross(n, f_s) * (0.5 * length);
  out.moment = turn * p.bending_stiffness + n * (dot(turn, n) * (p.twisting_stiffness - p.bending_stiffness));
  out.dashpot_power = p.dashpot * speed * speed;
  return out;
}

/// What the incremental form remembers: shear force and moment on i, in space axes.
struct BondHistory {
  Vec3 shear;   ///< N
  Vec3 moment;  ///< N m
};

/// Motion of the two balls as the incremental form sees it, all in space axes.
struct BondMotion {
  Vec3 branch;             ///< x_j - x_i at the end of the step, m
  Vec3 relative_velocity;  ///< v_j - v_i at mid-step, m/s
  Vec3 spin_i, spin_j;     ///< rad/s at mid-step
};

/// Incremental form, one step: updates the history and sets is_broken when a strength is passed.
DEM_INLINE BondForce incremental_bond(const BondParameters& p, const BondMotion& m, double dt, BondHistory& h,
                                      bool& is_broken) {
  const double length = std::sqrt(dot(m.branch, m.branch));
  const Vec3 n = m.branch * (1.0 / length);
  const Vec3 old_branch = m.branch - m.relative_velocity * dt;
  const double old_length = std::sqrt(dot(old_branch, old_branch));
  const Vec3 old_n = old_branch * (1.0 / old_length);
  const Vec3 middle = m.branch - m.relative_velocity * (0.5 * dt);
  const Vec3 spin_sum = m.spin_i + m.spin_j;
  const double t = 0.25 * dt * dot(spin_sum, n);

  const double twist_before = dot(h.moment, old_n);
  const Vec3 bend_before = h.moment - old_n * twist_before;
  Vec3 shear = turned_about_normal(carried_with_normal(h.shear, old_branch, old_length, n), n, t);
  Vec3 bend = turned_about_normal(carried_with_normal(bend_before, old_branch, old_length, n), n, t);

  const Vec3 slide = m.relative_velocity - cross(spin_sum, middle) * 0.5;
  const Vec3 spin_difference = m.spin_j - m.spin_i;
  const double twist_rate = dot(spin_difference, n);
  shear += perpendicular(slide, n) * (p.shear_stiffness * dt);
  shear = perpendicular(shear, n);
  bend += (spin_difference - n * twist_rate) * (p.bending_stiffness * dt);
  bend = perpendicular(bend, n);
  const double twist = twist_before + twist_rate * (p.twisting_stiffness * dt);
  h.shear = shear;
  h.moment = bend + n * twist;

  const double speed = dot(m.relative_velocity, n);
  const double f_n = bond_normal_force(p, length, speed);
  const double tension = p.normal_stiffness * (length - p.rest_length);
  const double inverse_area = 1.0 / p.area;
  // R/I = 4/(A R) and R/J = 2/(A R) for a disc.
  const double sigma = (tension + 4.0 * std::sqrt(dot(bend, bend)) / p.bond_radius) * inverse_area;
  const double tau = (std::sqrt(dot(shear, shear)) + 2.0 * std::fabs(twist) / p.bond_radius) * inverse_area;
  is_broken = sigma > p.tensile_strength || tau > p.shear_strength;

  BondForce out;
  out.force = n * f_n + shear;
  out.couple = cross(n, shear) * (0.5 * length);
  out.moment = h.moment;
  out.dashpot_power = p.dashpot * speed * speed;
  return out;
}

/// Elastic energy of a bond from its forces, J; the dashpot stores none.
DEM_INLINE double bond_energy(const BondParameters& p, double length, const Vec3& shear, const Vec3& moment,
                              const Vec3& n) {
  const double stretch = length - p.rest_length;
  const double squeezed = stretch < 0.0 ? stretch : 0.0;
  const double twist = dot(moment, n);
  const Vec3 bend = moment - n * twist;
  double energy = 0.5 * p.normal_stiffness * stretch * stretch + 0.5 * p.linear_stiffness * squeezed * squeezed +
                  0.5 * dot(shear, shear) / p.shear_stiffness;
  if (p.twisting_stiffness > 0.0) energy += 0.5 * twist * twist / p.twisting_stiffness;
  if (p.bending_stiffness > 0.0) energy += 0.5 * dot(bend, bend) / p.bending_stiffness;
  return energy;
}

}  // namespace dem
