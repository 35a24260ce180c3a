// SPDX-License-Identifier: BSD-3-Clause
// An oblique impact worked out beside the engine: one contact in one plane, as scalars, by a scheme of its own.
//
// It shares no code with the engine. Stiffnesses come from Young's moduli and the contact radius (Johnson 1985,
// Contact Mechanics), not from the mixing rule: k_n = 2 E* a, k_s = 8 G* a, F_n = (4/3) E* a d, a = sqrt(R* d).
#pragma once

namespace dem::verify {

/// One body of the impact; a plane has radius 0.
struct PlanarBody {
  double young = 0.0, poisson = 0.0;  ///< Pa, 1
  double radius = 0.0, mass = 0.0;    ///< m, kg
};

struct PlanarImpact {
  PlanarBody a, b;
  double friction = 0.0;
  double normal_damping = 0.0, shear_damping = 0.0;  ///< fractions of critical
  bool no_tension = false;                           ///< the dashpot never pulls
  bool no_dashpot_in_slip = false;                   ///< no shear dashpot while slipping
  bool rescales = false;                             ///< shear force falls with the stiffness
  double closing = 0.0, sliding = 0.0;               ///< m/s, relative velocity of the centres before
  double spin_a = 0.0, spin_b = 0.0;                 ///< rad/s before; positive spin moves the contact point against
                                                     ///< `sliding`
};

struct PlanarOutcome {
  double parting = 0.0, sliding = 0.0;  ///< m/s
  double spin_a = 0.0, spin_b = 0.0;    ///< rad/s
};

/// Uses about `steps` steps of the half-step scheme (positions whole, velocities half) over the contact.
PlanarOutcome work_out(const PlanarImpact& impact, double expected_duration, int steps = 100000);

}  // namespace dem::verify
