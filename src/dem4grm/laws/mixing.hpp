// SPDX-License-Identifier: BSD-3-Clause
// Contact properties of two unlike materials.
#pragma once

#include "dem4grm/core/lanes.hpp"

namespace dem {

/// Shear modulus G (Pa) and Poisson's ratio nu of one material.
struct Elastic {
  double shear_modulus = 0.0;
  double poisson_ratio = 0.0;
};

/// Properties that a contact inherits from its two sides.
///
/// formula:
///   E* = 1 / [ (1-nu1)/(2 G1) + (1-nu2)/(2 G2) ]           effective modulus, Pa
///   G* = 1 / [ (2-nu1)/G1 + (2-nu2)/G2 ]                   effective shear modulus, Pa
///   nu = (4 G* - E*) / (2 G* - E*),   G = 2 G* (2 - nu)    of the contact
/// Source: Chew et al. (2022) Eq. 2-5; the same as the inheritance of PFC's Hertz model. It reduces to
/// G = 2 G1 G2 / (G1 + G2) and E* = G / (1 - nu); equal materials give back their own values.
struct MixedElastic {
  double effective_modulus = 0.0;  ///< E*, Pa
  double shear_modulus = 0.0;      ///< G, Pa
  double poisson_ratio = 0.0;      ///< nu
};

constexpr MixedElastic mix(const Elastic& a, const Elastic& b) {
  const double e_star =
      1.0 / ((1.0 - a.poisson_ratio) / (2.0 * a.shear_modulus) + (1.0 - b.poisson_ratio) / (2.0 * b.shear_modulus));
  const double g_star = 1.0 / ((2.0 - a.poisson_ratio) / a.shear_modulus + (2.0 - b.poisson_ratio) / b.shear_modulus);
  const double nu = (4.0 * g_star - e_star) / (2.0 * g_star - e_star);
  return {e_star, 2.0 * g_star * (2.0 - nu), nu};
}

/// Friction of a contact: the smaller of the two sides. Source: Chew et al. (2022), as PFC.
constexpr double mix_friction(double a, double b) { return a < b ? a : b; }

}  // namespace dem
