// SPDX-License-Identifier: BSD-3-Clause
// Fabric: in which directions the contacts stand.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/micro/polar_histogram.hpp"
#include "dem4grm/micro/tensor.hpp"

namespace dem {

/// E(theta) of a histogram on the half circle, 1/rad; the integral over the full circle is 1.
///   formula:  E_b = N_b / (2 N w),  N_b contacts in the bin, N in all, w the width of a bin
std::vector<double> orientation_density(const PolarHistogram& histogram);

/// E(theta) = (1/2pi) {1 + a cos 2(theta - theta_a)}: amplitude a, direction theta_a, mean 1/2pi.
///   formula:  a cos 2 theta_a = (1/pi) int 2 pi E cos 2 theta dtheta,  the same with sin   (fit_harmonic with k = 2)
/// Source: Rothenburg & Bathurst (1989). Not a number without contacts.
HarmonicFit fabric_anisotropy(const PolarHistogram& histogram);

/// Largest a that noise alone explains: |a| of N isotropic contacts exceeds it with probability exp(-8) = 3e-4.
///   formula:  4 sqrt(2/N).  Both parts of a have the standard deviation sqrt(2/N), so P(a > x) = exp(-N x^2 / 4).
double isotropy_bound(double contacts);
/// Standard error of theta_a, rad: sqrt(2/N) / (2 a).
double direction_error(double contacts, double amplitude);

/// formula:  <n_i n_j>, trace 1; zero without contacts. Source: Satake (1982).
Tensor3 fabric_tensor(std::span<const Contact> contacts);
/// The same from unit normals.
Tensor3 fabric_tensor(std::span<const Vec3> normals);
/// Of the contacts whose flag is the wanted one. flags: one for each contact.
Tensor3 fabric_tensor(std::span<const Contact> contacts, std::span<const unsigned char> flags, bool wanted);

/// Amplitude and direction in the shear plane that a density of second order with this tensor gives after projection.
///   formula:  a = 5 sqrt(((f_xx - f_zz)/2)^2 + f_xz^2),  P(n) = (1/4pi)(1 + a_ij n_i n_j),  a_ij = (15/2)(f_ij - d_ij/3)
struct ProjectedFabric {
  double amplitude = 0.0;
  double direction = 0.0;  ///< rad, [0, pi)
};
ProjectedFabric projected_fabric(const Tensor3& fabric);

}  // namespace dem
