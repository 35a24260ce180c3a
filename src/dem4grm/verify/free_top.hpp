// SPDX-License-Identifier: BSD-3-Clause
// The force-free rotation of a rigid body in closed form, after Euler and Jacobi.
#pragma once

#include <array>
#include <cmath>

#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/core/vec3.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

/// Jacobi's elliptic functions of the argument u and the modulus k.
struct JacobiFunctions {
  double sn = 0.0, cn = 1.0, dn = 1.0;
};

/// Descending Landen transformation by arithmetic-geometric means: Abramowitz & Stegun, 16.4.
inline JacobiFunctions jacobi_functions(double u, double k) {
  constexpr int n = 8;  // the means agree to all digits after six for moduli up to 0.999
  std::array<double, n + 1> a{}, c{};
  a[0] = 1.0;
  double b = std::sqrt(1.0 - k * k);
  c[0] = k;
  double power = 1.0;
  for (std::size_t i = 0; i < n; ++i) {
    a[i + 1] = 0.5 * (a[i] + b);
    c[i + 1] = 0.5 * (a[i] - b);
    b = std::sqrt(a[i] * b);
    power *= 2.0;
  }
  double phi = power * a[n] * u;
  for (std::size_t i = n; i > 0; --i) phi = 0.5 * (phi + std::asin(c[i] / a[i] * std::sin(phi)));
  const double sn = std::sin(phi), cn = std::cos(phi);
  return {sn, cn, std::sqrt(1.0 - k * k * sn * sn)};
}

/// A body with principal moments x < y < z that starts with no spin about its middle axis and turns around its third
/// axis: L^2 > 2 T I_y, so that the spin about the middle axis swings.
struct AsymmetricTop {
  Vec3 inertia;           ///< kg m2
  double w1 = 0, w3 = 0;  ///< rad/s at the start, body axes
  double modulus = 0.0;   ///< k of the elliptic functions
  double rate = 0.0;      ///< 1/s, argument over time
  double amplitude2 = 0;  ///< rad/s, of the spin about the middle axis
  /// Period of the spin about the first and the middle axis, s.
  [[nodiscard]] double period() const { return 4.0 * std::comp_ellint_1(modulus) / rate; }
  /// Spin in body axes at a time, rad/s.
  [[nodiscard]] Vec3 spin(double time) const {
    const JacobiFunctions f = jacobi_functions(rate * time, modulus);
    return {w1 * f.cn, amplitude2 * f.sn, w3 * f.dn};
  }
};

/// Landau & Lifshitz, Mechanics, 37, equations 37.8 to 37.12.
inline AsymmetricTop asymmetric_top(const Vec3& inertia, double w1, double w3) {
  const double twice_energy = inertia.x * w1 * w1 + inertia.z * w3 * w3;
  const double momentum2 = inertia.x * inertia.x * w1 * w1 + inertia.z * inertia.z * w3 * w3;
  const double above = twice_energy * inertia.z - momentum2, below = momentum2 - twice_energy * inertia.x;
  AsymmetricTop top{inertia, w1, w3};
  top.modulus = std::sqrt((inertia.y - inertia.x) * above / ((inertia.z - inertia.y) * below));
  top.rate = std::sqrt((inertia.z - inertia.y) * below / (inertia.x * inertia.y * inertia.z));
  top.amplitude2 = std::sqrt(above / (inertia.y * (inertia.z - inertia.y)));
  return top;
}

/// A clump that is a lone pebble by shape but has the given principal moments (kg m2), turning with the spin (rad/s,
/// space axes, which are those of the body at the start).
inline Simulation free_body(const Vec3& inertia, const Vec3& spin, double dt) {
  Scene scene = model_scene();
  add_sphere(scene, {0, 0, 0}, 2e-3);
  Simulation s(scene);
  s.clumps.clumps[0].inertia = inertia;
  set_motion(s, 0, {}, spin);
  s.set_time_step(dt);
  return s;
}

/// Spin in body axes at the full step, rad/s: from the angular momentum and the orientation.
inline Vec3 body_spin(const Clump& c) {
  const Vec3 l = to_body(frame_of(c.orientation), c.angular_momentum);
  return {l.x / c.inertia.x, l.y / c.inertia.y, l.z / c.inertia.z};
}

}  // namespace dem::verify
