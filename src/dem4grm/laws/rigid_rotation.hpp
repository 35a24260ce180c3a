// SPDX-License-Identifier: BSD-3-Clause
// Rotation of balls and rigid bodies over one time step, with + - * / and sqrt only.
#pragma once

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/quaternion.hpp"

namespace dem {

/// (1, w dt/2) q: the turned orientation before it is brought back to length one.
DEM_INLINE Quaternion stretched_turn(const Quaternion& q, const Vec3& spin, double dt) {
  const double h = 0.5 * dt;
  const double x = spin.x * h, y = spin.y * h, z = spin.z * h;
  return {q.w - (x * q.x + y * q.y + z * q.z), q.x + x * q.w + (y * q.z - z * q.y), q.y + y * q.w + (z * q.x - x * q.z),
          q.z + z * q.w + (x * q.y - y * q.x)};
}

/// Orientation after a step of constant spin.
///
/// formula:  q' = (1, w dt/2) q / |(1, w dt/2)|      (Cayley map: turns by the angle 2 atan(|w| dt / 2) about w)
///   w   spin in space axes at mid-step, rad/s;   dt   time step, s
/// The contact and bond laws use the same map for the spins, so a pair that turns rigidly sees no relative motion at
/// all.
DEM_INLINE Quaternion turned(const Quaternion& q, const Vec3& spin, double dt) {
  const Quaternion p = stretched_turn(q, spin, dt);
  const double inverse = 1.0 / std::sqrt(p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.w * inverse, p.x * inverse, p.y * inverse, p.z * inverse};
}

/// The same map for a step that turns by little, as every ball of a rubber grain does: 1/sqrt(1 + e) by its series.
/// With |w| dt below 0.06 (20,000 rad/s at 3 microseconds) the first term left out, 63/256 e^5, is below 3e-16.
DEM_INLINE Quaternion turned_a_little(const Quaternion& q, const Vec3& spin, double dt) {
  const Quaternion p = stretched_turn(q, spin, dt);
  const double e = p.w * p.w + p.x * p.x + p.y * p.y + p.z * p.z - 1.0;
  const double inverse = 1.0 + e * (-0.5 + e * (0.375 + e * (-0.3125 + e * 0.2734375)));
  return {p.w * inverse, p.x * inverse, p.y * inverse, p.z * inverse};
}

/// Result of a step of free rotation of a rigid body.
struct FreeRotation {
  Quaternion orientation;  ///< at the end of the step
  Vec3 spin;               ///< in space axes at mid-step, rad/s
};

namespace detail {
/// Turns a body about its own axis (0, 1 or 2) for the time h; the body-frame angular momentum turns the other way.
template <int axis>
DEM_INLINE void turn_about_axis(Quaternion& q, Vec3& body_momentum, double inverse_inertia, double h) {
  double& along = axis == 0 ? body_momentum.x : axis == 1 ? body_momentum.y : body_momentum.z;
  double& first = axis == 0 ? body_momentum.y : axis == 1 ? body_momentum.z : body_momentum.x;
  double& second = axis == 0 ? body_momentum.z : axis == 1 ? body_momentum.x : body_momentum.y;
  const double t = 0.5 * h * along * inverse_inertia;  // tangent of half the angle
  const double scale = 1.0 / (1.0 + t * t);
  const double cosine = (1.0 - t * t) * scale, sine = 2.0 * t * scale;
  const double a = first * cosine + second * sine;
  second = second * cosine - first * sine;
  first = a;
  const Quaternion turn{1.0, axis == 0 ? t : 0.0, axis == 1 ? t : 0.0, axis == 2 ? t : 0.0};
  q = q * turn;
}
}  // namespace detail

/// One step of the free rotation of a rigid body whose angular momentum in space is constant over the step.
///
/// Symmetric splitting of the kinetic energy L1^2/2I1 + L2^2/2I2 + L3^2/2I3 into rotations about the three body axes
/// (half, half, half | half, half, half), after Dullweber, Leimkuhler & McLachlan (1997); each rotation by the Cayley
/// map. Angular momentum is kept exactly, the kinetic energy stays bounded, the error falls with dt squared.
///   orientation       body to space, at the start of the step
///   momentum          angular momentum in space axes, kg m2/s, at mid-step
///   inverse_inertia   1 / principal moments, 1/(kg m2)
DEM_INLINE FreeRotation rotate_freely(const Quaternion& orientation, const Vec3& momentum, const Vec3& inverse_inertia,
                                      double dt) {
  Quaternion q = orientation;
  Vec3 body = to_body(frame_of(q), momentum);
  const double h = 0.5 * dt;
  detail::turn_about_axis<0>(q, body, inverse_inertia.x, h);
  detail::turn_about_axis<1>(q, body, inverse_inertia.y, h);
  detail::turn_about_axis<2>(q, body, inverse_inertia.z, h);
  const Vec3 body_spin{body.x * inverse_inertia.x, body.y * inverse_inertia.y, body.z * inverse_inertia.z};
  const Vec3 spin = rotate(normalized(q), body_spin);
  detail::turn_about_axis<2>(q, body, inverse_inertia.z, h);
  detail::turn_about_axis<1>(q, body, inverse_inertia.y, h);
  detail::turn_about_axis<0>(q, body, inverse_inertia.x, h);
  // Number by number: g++ 12 does not vectorise a loop in which a whole struct is copied.
  return {normalized(q), {spin.x, spin.y, spin.z}};
}

}  // namespace dem
