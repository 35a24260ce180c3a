// SPDX-License-Identifier: BSD-3-Clause
// The stability limit of the whole assembly as it stands: its stiffest mode, found by the Lanczos method.
//
// Every bond, closed second-neighbour pair, ball contact and wall contact is a joint between two bodies with tangent
// stiffnesses K and dashpots C. With masses and moments of inertia scaled out, the leapfrog scheme is stable while
// (time_step.hpp)
//     lambda(dt) = largest eigenvalue of A(dt) = M^-1/2 (dt^2 K + 2 dt C) M^-1/2  <  4.
// A is never formed: k_lanczos_steps products with it from a random start give the largest eigenvalue of a tridiagonal
// matrix, which comes up to lambda from below.
#pragma once

#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Products with the matrix; with these the largest eigenvalue is met from below within one per cent.
inline constexpr int k_lanczos_steps = 30;

/// lambda(dt) of the present contacts, dimensionless; 0 when nothing is joined. The contacts are those of the last
/// evaluation. The same bits for every number of threads and every pack width.
double stiffest_mode(const Simulation& s, double dt, int lanczos_steps = k_lanczos_steps);

/// The largest stable time step, s, from lambda at a time step near it; infinite when nothing is joined, no number when
/// the state is none.
///
/// formula:  dt sqrt(4 / lambda) when that is longer than dt, else dt 4 / lambda.
/// lambda grows with dt at least in proportion (dashpots alone) and at most with its square (springs alone), so of the
/// two the formula takes the one that errs to the short side.
double stable_time_step(const Simulation& s, double dt);

}  // namespace dem
