// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/planar_impact.hpp"

#include <algorithm>
#include <cmath>

namespace dem::verify {

namespace {

/// E*, G*, R*, reduced mass of the two bodies.
struct Together {
  double modulus = 0.0, shear_modulus = 0.0, radius = 0.0, mass = 0.0;
};

Together join(const PlanarBody& a, const PlanarBody& b) {
  const auto bending = [](const PlanarBody& x) { return (1.0 - x.poisson * x.poisson) / x.young; };
  const auto shearing = [](const PlanarBody& x) { return 2.0 * (1.0 + x.poisson) * (2.0 - x.poisson) / x.young; };
  if (b.radius == 0.0) return {1.0 / bending(a), 1.0 / shearing(a), a.radius, a.mass};
  return {1.0 / (bending(a) + bending(b)), 1.0 / (shearing(a) + shearing(b)),
          a.radius * b.radius / (a.radius + b.radius), a.mass * b.mass / (a.mass + b.mass)};
}

double turning_inertia(const PlanarBody& x) { return 0.4 * x.mass * x.radius * x.radius; }

}  // namespace

PlanarOutcome work_out(const PlanarImpact& p, double expected_duration, int steps) {
  const Together t = join(p.a, p.b);
  const double h = expected_duration / steps;
  PlanarOutcome now{-p.closing, p.sliding, p.spin_a, p.spin_b};
  double overlap = 0.0, spring = 0.0, old_stiffness = 0.0;
  for (int k = 0; k < 10 * steps; ++k) {
    overlap -= now.parting * h;
    if (overlap <= 0.0) break;
    const double patch = std::sqrt(t.radius * overlap);
    const double k_n = 2.0 * t.modulus * patch, k_s = 8.0 * t.shear_modulus * patch;
    const double elastic = 4.0 / 3.0 * t.modulus * patch * overlap;
    const double lever_a = p.a.radius - 0.5 * overlap, lever_b = p.b.radius > 0.0 ? p.b.radius - 0.5 * overlap : 0.0;
    const double slide = now.sliding - lever_a * now.spin_a - lever_b * now.spin_b;
    if (p.rescales && k_s < old_stiffness) spring *= k_s / old_stiffness;
    old_stiffness = k_s;
    spring += k_s * slide * h;
    const double limit = p.friction * elastic;
    const bool slips = std::fabs(spring) > limit;
    spring = std::clamp(spring, -limit, limit);
    double shear = spring;
    if (!(slips && p.no_dashpot_in_slip)) shear += 2.0 * p.shear_damping * std::sqrt(t.mass * k_s) * slide;
    double normal = elastic - 2.0 * p.normal_damping * std::sqrt(t.mass * k_n) * now.parting;
    if (p.no_tension) normal = std::max(0.0, normal);
    now.parting += normal / t.mass * h;
    now.sliding -= shear / t.mass * h;
    now.spin_a += shear * lever_a / turning_inertia(p.a) * h;
    if (p.b.radius > 0.0) now.spin_b += shear * lever_b / turning_inertia(p.b) * h;
  }
  return now;
}

}  // namespace dem::verify
