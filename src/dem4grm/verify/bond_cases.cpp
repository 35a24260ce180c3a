// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/bond_checks.hpp"

namespace dem {

namespace {

constexpr const char* k_cantilever =
    R"(A straight row of N + 1 balls of radius r (m), joined by N bonds, length L = 2 r N
(m). The first ball is held, the last one loaded until everything is at rest. The row is cut out of the diagonal of one
rubber grain (corner, centre, middle, centre, corner): all other bonds are broken and the other balls moved away, so that
the engine itself moves it, with incremental bonds, N up to 4. The history-free form cannot break; there the one bond of a
vertex ball is loaded while the rest of the grain is held (N = 1). Longer rows, N = 5 and 10, are statics assembled from
the two law functions that the engine calls.

With A = pi (lambda r)^2 (m2), I = s A (lambda r)^2 / 4 (m4), J = 2 I, P (N) the force across, T and M (N m) torque and
moment at the tip:

    deflection    w = P L^3 / (3 E I) (1 - 1 / (4 N^2)) + kappa P L / (E A)      turn   P L^2 / (2 E I)
    stretch       u = P L / (E A)        under a push, the linear springs beside   u = P L / (E A + E pi r^2)
    twist         kappa T L / (E J)
    moment        turn M L / (E I), deflection M L^2 / (2 E I)

For many balls these are the formulas of Euler and Bernoulli with Timoshenko's shear. The modulus E moves all of them, the ratio kappa deflection and twist, the radius multiplier lambda all (area and fourth
power), the moment scale s deflection, turn and twist.)";

constexpr const char* k_energy = R"(The ball at the vertex of a grain is moved and turned by hand against its one
neighbour, by 1e-4 of r or 1e-4 rad: stretched, shortened, slid, bent, twisted, without mixing one with another. The
engine's strain energy and the work of the forces that it puts on the ball are each held against 1/2 k e^2, with
k_n = E A / 2r, k_s = k_n / kappa (N/m), k_b = s E I / 2r, k_t = s E J / (2r kappa) (N m/rad), and beside them E pi r^2 / 2r when the
bond is shortened and has its linear spring. Published values, and E = 35 MPa, kappa = 2.5, lambda = 0.8, s = 0.6.)";

constexpr const char* k_strength =
    R"(The same vertex ball, incremental form, strained further and further until the bond
breaks, in steps of 1/4000. A disc of radius R = lambda r has the stresses

    sigma = E u / 2r + s E R phi / 2r          tau = E v / (2r kappa) + s E R psi / (2r kappa)

under stretch u, bend phi, slide v and twist psi; sigma_t = 60 kPa, tau_c = 25 kPa. A shortened bond must be bent further
(the linear spring beside it does not count). In the step in which it breaks, the pair must already be a contact with the
forces of Hertz and Mindlin, h = 5.679437e5 N/m^1.5; pulled apart it must carry nothing.)";

constexpr const char* k_dashpot = R"(A bonded pair is set swinging along its axis: two free balls in the incremental
form, or one vertex ball against a grain that is held in the history-free form. Its dashpot is
c = 2 b sqrt(m/2 k_l) (N s/m) with k_l = E pi r / 2 whether or not the linear spring is on. Each half swing between two passages through the
rest length is a damped oscillator of the stiffness k of that half, k_n or k_n + k_l, and of the moving mass M, m/2 or m:

    duration = pi / (omega sqrt(1 - z^2)),   speed kept = exp(-pi z / sqrt(1 - z^2)),   omega^2 = k / M,   z = c / (2 sqrt(M k))

b = 0, 0.25 and 0.5; lambda = 0.8; linear spring on and off. A slide meets no dashpot.)";

constexpr const char* k_turned = R"(A whole grain, every ball displaced by up to 0.05 r and turned by up to 0.1 rad, is
turned rigidly by 2 pi in 360 steps about three axes. Forces and torques on all 35 balls, as one step of the engine gives
them, must turn with it, in both forms; so there is no drift to state for the incremental form either: the Cayley turns
of its history are those of the balls. Force and moment of the whole grain must vanish.)";

constexpr const char* k_closed_path = R"(The vertex ball, bent by 0.2 rad, is led around so that the axis of its bond
runs once around a cone of half angle alpha, without turning itself. The state returns; the history-free form must return
to the same moment. The incremental form carries its moment with the axis, and parallel transport turns it by the solid
angle of the cone, 2 pi (1 - cos alpha). That is what this form is, no error of the time step; it is the reason why
history-free is the default.)";

}  // namespace

void add_bond_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"bond-cantilever", "Rows of bonded balls as beams", k_cantilever, Extent::quick, verify::check_cantilever});
  cases.push_back(
      {"bond-energy", "Energy of a bond is the work put in", k_energy, Extent::quick, verify::check_bond_energy});
  cases.push_back({"bond-strength", "Bonds break at their strength and become contacts", k_strength, Extent::quick,
                   verify::check_bond_strength});
  cases.push_back({"bond-dashpot", "Decay of an oscillation of bonded balls", k_dashpot, Extent::quick,
                   verify::check_bond_dashpot});
  cases.push_back({"bond-turned", "A strained grain that turns keeps its forces", k_turned, Extent::quick,
                   verify::check_bond_turned});
  cases.push_back({"bond-closed-path", "Bond moment after a closed path", k_closed_path, Extent::quick,
                   verify::check_bond_closed_path});
}

}  // namespace dem
