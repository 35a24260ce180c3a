// SPDX-License-Identifier: BSD-3-Clause
// Stress of a specimen from its contacts, from its boundary, and from fabric and force anisotropy.
#pragma once

#include <span>

#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/tensor.hpp"

namespace dem {

/// Stress from contact forces and branches, Pa, compression positive.
///   formula:  sigma_ij = (1/V) sum f_i l_j,  f the force of the first on the second, l from the centre of the first body
///             to that of the second; at a wall to the contact point. All contacts of all bodies, walls too.
/// Source: Love (1927), Weber (1966).
Tensor3 contact_stress(const ContactNetwork& network);

/// The same from what the walls bear, Pa.
///   formula:  sigma_ij = (1/V) sum f_i x_j,  f the force on the wall, x the contact point
/// In equilibrium it equals contact_stress to rounding (divergence theorem for points); in motion the two differ by
/// (1/V) sum over the bodies of net force times position.
Tensor3 boundary_stress(const ContactNetwork& network);

/// Force of the bodies on the top plate along z over the area, Pa, compression positive.
double plate_stress(const ContactNetwork& network);

/// Largest difference of the xx, yy, zz, xz and zx components of two stresses, Pa.
double largest_difference(const Tensor3& a, const Tensor3& b);

/// Tensors of anisotropy in space, deviators of second order, dimensionless.
///   P(n)   = (1/4pi)(1 + a^c_ij n_i n_j)                          contacts
///   f_n(n) = f_0 (1 + a^n_ij n_i n_j)                             normal force
///   f_t(n) = f_0 [a^t_ij n_j - (a^t_kl n_k n_l) n_i]              tangential force on the second body
///   formula:  a^c = (15/2) dev <n n>,  a^n = (15/2) dev chi^n / f_0,  a^t = 5 chi^t / f_0,  f_0 = tr chi^n
///             chi^n_ij = (1/N) sum f_n n_i n_j / (1 + a^c n n),  chi^t_ij = (1/N) sum f_t,i n_j / (1 + a^c n n)
/// Source: Chantawarangkul (1993), Guo & Zhao (2013). Not a number when the density of second order is not positive at
/// some contact.
struct AnisotropyTensors {
  Tensor3 contacts, normal, shear;
};
AnisotropyTensors anisotropy_tensors(std::span<const Contact> contacts);

/// The stress ratio q/p that these anisotropies carry, q = sqrt(3/2 s : s), p the mean stress.
///   formula:  s / p = (2/5)(a^c + a^n + (3/2) a^t)
/// First order in the anisotropies, branches of one mean length along the normals: the Rothenburg-Bathurst relation in
/// space. It leaves out products of anisotropies, long branches under large forces, and the contacts with walls.
/// Source: Rothenburg & Bathurst (1989) in the plane; Ouadfel & Rothenburg (2001), Guo & Zhao (2013) in space.
double stress_ratio_of(const AnisotropyTensors& a);

/// q/p of a stress.
double stress_ratio_of(const Tensor3& stress);

}  // namespace dem
