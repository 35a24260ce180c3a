// SPDX-License-Identifier: BSD-3-Clause
// Inertial number of a sheared specimen: how far its shear is from quasi-static.
#pragma once

#include <cmath>

namespace dem {

/// formula:  I = gamma D sqrt(rho / sigma_n)
///   I        inertial number, dimensionless: time in which the normal stress moves a grain by its size, over the time in
///            which shear does
///   gamma    shear rate, 1/s: velocity of the halves against each other over the height of the specimen before shear
///   D        mean grain size, weighted by solid volume, m
///   rho      density of the solids, weighted by solid volume, kg/m3
///   sigma_n  normal stress, Pa
/// Source: Chew et al. (2022), who keep it below 1e-4. All arguments are above 0. The height is part of the definition: with
/// a shear band of five grains in its place the same test would have two to three times the number.
inline double inertial_number(double shear_rate, double mean_size, double density, double normal_stress) {
  return shear_rate * mean_size * std::sqrt(density / normal_stress);
}

/// The same solved for the shear rate, 1/s:  gamma = I / (D sqrt(rho / sigma_n)).
inline double shear_rate_of(double inertial_number, double mean_size, double density, double normal_stress) {
  return inertial_number / (mean_size * std::sqrt(density / normal_stress));
}

/// Below it a test counts as quasi-static beyond doubt (the published limit), above the other as too fast.
inline constexpr double k_quasi_static = 1e-4;
inline constexpr double k_too_fast = 1e-3;

}  // namespace dem
