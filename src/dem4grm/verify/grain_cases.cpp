// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/grain_checks.hpp"

namespace dem {

namespace {

constexpr const char* k_free = R"(A tilted grain of 35 balls gets random velocities and spins; no damping, no linear
springs, nothing that touches it. Linear and angular momentum must stay: with speeds of 0.5 m/s, strains to 5 %, over 5000
steps. At 1 mm/s, strains to 1e-4, the total energy over 0.5 ms must stay too, and its departure must fall with the
square of the time step. Strain energy belongs to full steps; kinetic energy is the mean of the half steps around. Both
forms of the bond.)";

constexpr const char* k_stiffness = R"(The stiffness matrix of the grain (210 unknowns: three displacements and three
turns of 35 balls) as the engine has it: one ball is moved or turned a little, one step is made, the change of all
velocities and spins gives the loads. It is held, block by block, against the Hessian of the elastic energy of 64 short
beams, each with the six strains in its own axes: stretch, two slides, twist, two bends. kappa = 3, s = 0.7.)";

constexpr const char* k_lattice = R"(The same matrix under homogeneous strains with all turns zero. Every cell then
stores what a cell of the infinite body-centred lattice does, whose sites cannot turn for reasons of symmetry; with
a = 4r / sqrt 3 (m), k_n and k_s (N/m) sums over the eight bonds of a cell give

    C11 = (2/3a)(k_n + 2 k_s)    C12 = (2/3a)(k_n - k_s)    C44 = (2/3a)(k_n + k_s/2)    (Pa)

and Poisson's ratio along a cube axis, C12 / (C11 + C12) = (kappa - 1) / (2 kappa + 1): 1/3 at kappa = 4.)";

constexpr const char* k_platens = R"(Linear statics of one grain between two rigid platens with the engine's stiffness
matrix. The nine top and the nine bottom balls are moved towards each other; on smooth platens they slide and turn
freely, on stuck ones they turn but do not slide. K (N/m) is platen force over approach, Poisson's ratio that of the eight cell centres.
It depends on kappa and on the moment scale s; K on E, kappa, s and the radius multiplier lambda.

The linear springs only push, so with them the statics is solved for the set of bonds that are shortened; the engine is
put into that solution and must carry the same load and leave all free balls in balance.)";

constexpr const char* k_compression = R"(`dem4grm run` of one grain between plates, r = 0.627 mm, E = 20 MPa, kappa = 4,
G = 12 MPa, linear springs: load and Poisson's ratio of the inner cube up to 40 % of the height. Near 12 % the second neighbours
meet and the grain becomes three times as stiff. The reference is a separate explicit program for one grain (scalar,
incremental bonds, its own contact search and time step of 1.5 us), and for r = 0.63 mm without linear springs a
second one with local damping of 0.7. Friction at the plates 0.27 (the rubber's) and 0; the rubber's
Poisson's ratio, which enters the Hertz contacts only, 0.5 and 0.3.)";

constexpr const char* k_contacts =
    R"(Two balls of one grain pressed together by 20 um, r = 0.63 mm, the others moved away
and without bonds: second neighbours (a corner and the next), and a pair whose bond is broken. One is led around the other
at constant overlap. Normal force, shear force k_s x path, the same torque on both, F_s (r - d/2), and stored energy
2/5 F_n d + F_s^2 / (2 k_s) are held against Hertz and Mindlin, the shear force and the work lost after a longer path
against Coulomb's law with 0.27. Apart and together again, the shear force starts from nothing. The dashpot of such
contacts, 2 b sqrt(m/2 k_n) v, takes force times path.)";

constexpr const char* k_scaling =
    R"(In quasi-statics the only stresses are E and G and the only length is r, so that the
load is E r^2 f(approach / r; G/E, ...). Twice the radius: four times the load at the same strain; and half of that again
with all moduli halved.)";

}  // namespace

void add_grain_cases(std::vector<VerificationCase>& cases) {
  cases.push_back({"grain-free", "A vibrating rubber grain keeps momentum and energy", k_free, Extent::quick,
                   verify::check_free_grain});
  cases.push_back({"grain-stiffness", "Stiffness matrix of the rubber grain", k_stiffness, Extent::quick,
                   verify::check_grain_stiffness});
  cases.push_back({"grain-lattice", "Elastic moduli of the infinite lattice", k_lattice, Extent::quick,
                   verify::check_grain_lattice});
  cases.push_back({"grain-platens", "Rubber grain between platens at small strain", k_platens, Extent::quick,
                   verify::check_grain_platens});
  cases.push_back({"grain-inner-contacts", "Contacts inside a rubber grain", k_contacts, Extent::quick,
                   verify::check_grain_contacts});
  cases.push_back({"grain-compression", "Rubber grain between plates at large strain", k_compression, Extent::quick,
                   verify::check_grain_compression});
  cases.push_back(
      {"grain-scaling", "Scaling law of the grain compression", k_scaling, Extent::quick, verify::check_grain_scaling});
}

}  // namespace dem
