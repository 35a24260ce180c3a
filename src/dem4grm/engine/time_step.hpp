// SPDX-License-Identifier: BSD-3-Clause
// The largest stable time step, from the stiffness of what is there.
//
// The leapfrog scheme with explicit dashpots, v+ = v - dt M^-1 (K x + C v), x+ = x + dt v+, is stable while
//     largest eigenvalue of M^-1 (dt^2 K + 2 dt C)  <  4
// (at the border a mode flips its sign every step: z = -1 in z^2 - (2 - a - b) z + 1 - b = 0 gives a + 2 b = 4 with
// a = dt^2 k/m, b = dt c/m; K and C are symmetric, so the Rayleigh quotient carries this over to all modes).
#pragma once

#include <string>

#include "dem4grm/engine/simulation.hpp"

namespace dem {

struct TimeStepLimit {
  double seconds = 0.0;
  std::string limited_by;
};

/// Stability limit of one loaded rubber grain: 64 bonds with their linear springs and dashpots, the 66 second
/// neighbours pressed together by 0.15 r, and on every exposed side of every surface ball two contacts with a rigid
/// partner pressed in by 0.2 r, contact dashpots as set in the scene. 210 degrees of freedom, rotations included.
TimeStepLimit loaded_grain_limit(const Scene& scene);

/// The usual estimate sqrt(m / k) of the stiffest ball from the diagonal of the same matrices; about half as large.
TimeStepLimit diagonal_grain_limit(const Scene& scene);

/// Bound for the clumps in their present contacts: every contact spring is at most 2 (u_i^2 + u_j^2), so twice the
/// largest eigenvalue of a body's own 6 x 6 stiffness bounds the system; dashpots likewise. Infinite when nothing
/// touches.
TimeStepLimit clump_limit(const Simulation& s);

/// Bound for a clump of the scene with 12 contacts that carry ten times the mean contact force stress * D^2 each.
TimeStepLimit expected_clump_limit(const Simulation& s, double stress);

/// Largest whole number of nanoseconds not above t: no detail of an eigenvalue solver reaches the bits of a run.
double rounded_down_to_nanosecond(double t);

/// Steps between two reviews of the time step: each costs as much as 30 steps without rubber and 130 with it, where the
/// bonds decide the limit and hardly change.
inline constexpr int k_review_interval = 5000, k_review_interval_with_rubber = 20000;

/// The step rises by at most this factor from one look to the next, and a fall below that share means that something
/// goes wrong. Between two looks the limit of a specimen fell by 12 % at most (gravel) and 3 % (mixture); the safety
/// factor of 0.8 leaves 20 %.
inline constexpr double k_largest_rise = 1.05, k_largest_fall = 0.1;

/// The share of the stability limit of the undamped motion that a simulation may use.
///
/// formula:  share = min(safety, 0.88 / sqrt(1 + alpha))
///   alpha  local damping: a body on its way out of balance is pushed by (1 + alpha) times its force, as by a spring that
///          much stiffer, so that the limit is that of the undamped motion over sqrt(1 + alpha)
/// Source: the leapfrog scheme on a linear oscillator, which grows without bound from there on (time_step_test.cpp). 0.88
/// leaves with any damping the room that a safety of 0.8 leaves with the published 0.2, where safety alone counts.
double safe_share(double safety, double local_damping);

/// At every multiple of the interval above, sets the time step to the safe share of the limit of the state as it stands
/// (stiffest_mode.hpp), at most `longest` (s). Leaves it alone when the case asks for the diagonal rule. Throws
/// PhysicsError when the limit is no number or has fallen far below the present step.
void review_time_step(Simulation& s, double longest);

/// Chooses the time step of a simulation that will carry the stress (Pa): the safe share of the smallest limit.
TimeStepLimit choose_time_step(const Simulation& s, double stress);

}  // namespace dem
