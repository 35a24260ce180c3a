// SPDX-License-Identifier: BSD-3-Clause
// Hertz-Mindlin contact with Coulomb slip and optional dashpots.
//
// Conventions, as everywhere in the engine: the normal n points from body i to body j; forces are those on i (j gets
// the opposite); the overlap is positive in contact; v is the velocity of j relative to i at the contact point.
//
//   F_n = h d^(3/2),   h = (4/3) E* sqrt(R*),   R* = Ri Rj / (Ri + Rj)   (against a plane R* = Ri)   Hertz (1882)
//   k_n = (3/2) h sqrt(d)                 tangent normal stiffness, N/m
//   k_s = 2 (1-nu) / (2-nu) k_n           no-slip shear stiffness, Mindlin (1949)
//   F_s += k_s v_s dt, then cut to friction * F_n                                                       Coulomb
//   dashpots: 2 b_n sqrt(m k_n) v_n and 2 b_s sqrt(m k_s) v_s with the tangent stiffnesses, m = m_i m_j / (m_i + m_j)
//
//   d overlap, m;  E*, nu of the contact from laws/mixing.hpp;  b fraction of critical damping;  limit d = 0: no force.
// Unloading: by rule 0 the shear force is kept when the normal force falls (PFC's default, hz_mode 0; elastic shear
// energy then grows as k_s falls); by rule 1 it is scaled by k_s / k_s,old = sqrt(d / d_old). Source: PFC's Hertz
// model, in the form of Chew et al. (2022).
#pragma once

#include <cmath>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/laws/mixing.hpp"

namespace dem {

/// h of the header, N/m^1.5. radius_j = 0 stands for a plane.
inline double hertz_coefficient(const MixedElastic& contact, double radius_i, double radius_j) {
  const double effective_radius = radius_j > 0.0 ? radius_i * radius_j / (radius_i + radius_j) : radius_i;
  return 4.0 / 3.0 * contact.effective_modulus * std::sqrt(effective_radius);
}

/// k_s / k_n of the header, dimensionless.
constexpr double mindlin_ratio(const MixedElastic& contact) {
  return 2.0 * (1.0 - contact.poisson_ratio) / (2.0 - contact.poisson_ratio);
}

/// Dashpot coefficient divided by the fourth root of the overlap: 2 b sqrt(m k / sqrt(d)), N s/m^1.25.
/// stiffness_coefficient is k / sqrt(d): (3/2) h for the normal and that times mindlin_ratio for the shear dashpot.
inline double dashpot_coefficient(double damping_ratio, double reduced_mass, double stiffness_coefficient) {
  return 2.0 * damping_ratio * std::sqrt(reduced_mass * stiffness_coefficient);
}

/// Carries a vector f that is perpendicular to the old branch to the new contact plane by the smallest rotation.
///
/// formula:  f' = f - (f.n) (s + |s| n) / (|s| + s.n)      with s the old branch vector and n the new unit normal.
/// It is an exact rotation, so a pair that turns rigidly keeps its shear force to rounding.
/// The caller gives the reciprocal of the denominator.
DEM_INLINE Vec3 carried_with_normal(const Vec3& f, const Vec3& old_branch, double old_length, const Vec3& n,
                                    double reciprocal) {
  return f - (old_branch + n * old_length) * (dot(f, n) * reciprocal);
}
DEM_INLINE Vec3 carried_with_normal(const Vec3& f, const Vec3& old_branch, double old_length, const Vec3& n) {
  return carried_with_normal(f, old_branch, old_length, n, 1.0 / (old_length + dot(old_branch, n)));
}

/// Turns f, which is perpendicular to n, about n by the angle 2 atan(t); t is half the spin about n times the time
/// step.
///
/// formula:  f' = [ f (1 - t^2) + 2 t n x f ] / (1 + t^2);  the caller gives the reciprocal of the denominator.
DEM_INLINE Vec3 turned_about_normal(const Vec3& f, const Vec3& n, double t, double reciprocal) {
  return (f * (1.0 - t * t) + cross(n, f) * (2.0 * t)) * reciprocal;
}
DEM_INLINE Vec3 turned_about_normal(const Vec3& f, const Vec3& n, double t) {
  return turned_about_normal(f, n, t, 1.0 / (1.0 + t * t));
}

/// Both, with one division for the two: 1/a = b/(ab), 1/b = a/(ab).
DEM_INLINE Vec3 carried_and_turned(const Vec3& f, const Vec3& old_branch, double old_length, const Vec3& n, double t) {
  const double a = old_length + dot(old_branch, n), b = 1.0 + t * t, reciprocal = 1.0 / (a * b);
  const Vec3 carried = carried_with_normal(f, old_branch, old_length, n, b * reciprocal);
  return turned_about_normal(carried, n, t, a * reciprocal);
}

/// What a contact is made of; constant while its two bodies keep their materials and sizes.
struct HertzParameters {
  double hertz = 0.0;           ///< h, N/m^1.5
  double shear_ratio = 0.0;     ///< k_s / k_n
  double friction = 0.0;        ///< Coulomb coefficient
  double normal_dashpot = 0.0;  ///< dashpot_coefficient, N s/m^1.25
  double shear_dashpot = 0.0;
};

/// The shear history brought to the new contact plane, with the motion of this step.
struct HertzMotion {
  double overlap = 0.0;       ///< m; 0 when apart, and then every force and the history come out as 0
  double old_overlap = 0.0;   ///< m, one step ago; used by unloading rule 1
  double normal_speed = 0.0;  ///< m/s, positive when separating
  Vec3 shear_velocity;        ///< m/s, of j relative to i
  Vec3 carried_shear;         ///< N, shear force on i of the last step, in the new plane
};

/// Forces of one contact on body i, and what it dissipated in this step.
struct HertzForce {
  double normal = 0.0;        ///< N, elastic normal force, >= 0
  double normal_total = 0.0;  ///< N, with the dashpot; the force on i is - normal_total * n + shear_total
  Vec3 shear;                 ///< N, history for the next step
  Vec3 shear_total;           ///< N, with the dashpot
  double slip_work = 0.0;     ///< J
  double dashpot_work = 0.0;  ///< J
};

/// Which optional parts of the law are compiled into a loop.
struct HertzOptions {
  bool rescale_on_unloading = false;  ///< unloading rule 1
  bool dashpots = false;
  bool no_tension = false;          ///< dashpot never pulls
  bool no_dashpot_in_slip = false;  ///< shear dashpot off while slipping
};

/// Added to a denominator that may be zero; changes no bit of any other.
inline constexpr double k_tiny = 1e-300;

/// One step of the law; `options` is a compile-time choice so that loops pay only for what they use.
template <HertzOptions options>
DEM_INLINE HertzForce hertz_mindlin(const HertzParameters& p, const HertzMotion& m, double dt) {
  const double root = std::sqrt(m.overlap);
  const double k_n = 1.5 * p.hertz * root;
  const double k_s = k_n * p.shear_ratio;
  const double normal = p.hertz * m.overlap * root;

  Vec3 old = m.carried_shear;
  if constexpr (options.rescale_on_unloading) {
    const double quotient = m.overlap / m.old_overlap;
    old = old * std::sqrt(m.overlap < m.old_overlap ? quotient : 1.0);
  }
  const Vec3 tried = old + m.shear_velocity * (k_s * dt);
  const double limit = p.friction * normal;
  const double size2 = dot(tried, tried);
  const bool slips = size2 > limit * limit;
  // Everything is computed for every lane and then selected: a branch would keep the loop from being vectorised.
  const double size = std::sqrt(size2 + k_tiny);
  const double reciprocal = 1.0 / (size * k_s + k_tiny);  // one division for 1/size and 1/k_s
  const double reduction = limit * (k_s * reciprocal);
  const Vec3 shear = tried * (slips ? reduction : 1.0);
  // Slip work: mean shear force times the part of the motion that the spring did not take up, (tried - kept) / k_s.
  const double slip_work = 0.5 * dot(shear + old, tried) * ((1.0 - reduction) * (size * reciprocal));
  const double positive = slip_work > 0.0 ? slip_work : 0.0;
  const double counted = slips ? positive : 0.0;
  const double slip = m.overlap > 0.0 ? counted : 0.0;

  double total = normal, dashpot_work = 0.0;
  Vec3 shear_total = shear;
  if constexpr (options.dashpots) {
    const double quarter = std::sqrt(root);
    const double normal_dashpot = p.normal_dashpot * quarter * m.normal_speed;
    total = normal - normal_dashpot;
    if constexpr (options.no_tension) total = total < 0.0 ? 0.0 : total;
    double shear_dashpot = p.shear_dashpot * quarter;
    if constexpr (options.no_dashpot_in_slip) shear_dashpot = slips ? 0.0 : shear_dashpot;
    shear_total = shear + m.shear_velocity * shear_dashpot;
    dashpot_work = ((normal - total) * m.normal_speed + shear_dashpot * dot(m.shear_velocity, m.shear_velocity)) * dt;
  }
  return {normal, total, shear, shear_total, slip, dashpot_work};
}

/// Two balls as the law sees them, SI units, space axes. Positions at the end of the step, velocities at mid-step.
struct HertzPair {
  Vec3 branch;                            ///< x_j - x_i, m
  Vec3 relative_velocity;                 ///< v_j - v_i of the centres, m/s
  Vec3 spin_i, spin_j;                    ///< rad/s
  double radius_i = 0.0, radius_j = 0.0;  ///< m
  Vec3 shear;                             ///< shear force on i of the last step, N
};

/// Where the pair was one step ago.
struct HertzBefore {
  Vec3 direction;        ///< from i to j, of any length
  double length = 0.0;   ///< of the direction
  double overlap = 0.0;  ///< m; not positive when apart
};

/// formula:  old branch = b - v dt exactly, so nothing but the shear force needs to be remembered.
DEM_INLINE HertzBefore one_step_ago(const HertzPair& p, double dt) {
  const Vec3 old_branch = p.branch - p.relative_velocity * dt;
  const double length = std::sqrt(dot(old_branch, old_branch) + k_tiny);
  return {old_branch, length, p.radius_i + p.radius_j - length};
}

/// Geometry of the contact of two balls and what moved since the last step.
struct HertzGeometry {
  HertzMotion motion;
  Vec3 normal;                          ///< from i to j
  double lever_i = 0.0, lever_j = 0.0;  ///< m, from the centres to the contact point, the middle of the overlap
};

/// formula:  n = b/|b|,  d = R_i + R_j - |b|,  l_i = R_i - d/2,
///           v_s = [ v - (l_i w_i + l_j w_j)/|b| x (b - v dt/2) ] perpendicular to n
/// The spins act on the mid-step branch: with the Cayley map of rigid_rotation.hpp a pair that turns rigidly then has
/// v_s = 0 to rounding. A caller that remembers the normal of the last step gives it as `before`; a pair that carries no
/// shear force may give zeros.
DEM_INLINE HertzGeometry hertz_geometry(const HertzPair& p, const HertzBefore& before, double dt) {
  // Apart, the overlap is 0 and the law gives 0 for force, history and work by itself: no branch, no mask.
  const double length = std::sqrt(dot(p.branch, p.branch) + k_tiny);
  const double inverse = 1.0 / length;
  const Vec3 n = p.branch * inverse;
  const double overlap = p.radius_i + p.radius_j - length;
  const Vec3 middle = p.branch - p.relative_velocity * (0.5 * dt);

  HertzGeometry g;
  g.normal = n;
  g.motion.overlap = overlap > 0.0 ? overlap : 0.0;
  g.motion.old_overlap = before.overlap;
  g.motion.normal_speed = dot(p.relative_velocity, n);
  g.lever_i = p.radius_i - 0.5 * g.motion.overlap;
  g.lever_j = p.radius_j - 0.5 * g.motion.overlap;
  const Vec3 rolling = cross(p.spin_i * (g.lever_i * inverse) + p.spin_j * (g.lever_j * inverse), middle);
  g.motion.shear_velocity = perpendicular(p.relative_velocity - rolling, n);
  const double half_twist = 0.25 * dt * dot(p.spin_i + p.spin_j, n);
  g.motion.carried_shear =
      perpendicular(carried_and_turned(p.shear, before.direction, before.length, n, half_twist), n);
  return g;
}
DEM_INLINE HertzGeometry hertz_geometry(const HertzPair& p, double dt) {
  return hertz_geometry(p, one_step_ago(p, dt), dt);
}

/// Elastic energy of a contact, J: (2/5) h d^(5/2) + F_s^2 / (2 k_s).
DEM_INLINE double hertz_mindlin_energy(const HertzParameters& p, double overlap, const Vec3& shear) {
  if (overlap <= 0.0) return 0.0;
  const double root = std::sqrt(overlap);
  const double k_s = 1.5 * p.hertz * root * p.shear_ratio;
  return 0.4 * p.hertz * overlap * overlap * root + (k_s > 0.0 ? 0.5 * dot(shear, shear) / k_s : 0.0);
}

}  // namespace dem
