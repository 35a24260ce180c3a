// SPDX-License-Identifier: BSD-3-Clause
// Settings of the materials, of the bonds inside a rubber grain and of unbonded contacts, in SI units.
#pragma once

#include <cstdint>

namespace dem {

/// Elastic and frictional properties of one material. Published values: spec of the model, table of parameters.
struct MaterialSettings {
  double density = 0.0;        ///< kg/m3; of the solid for gravel, of the balls for rubber; unused for walls
  double friction = 0.0;       ///< friction coefficient, dimensionless
  double shear_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.0;  ///< dimensionless
};

/// Which formulation carries the bond forces (docs/theory/parallel-bond.md).
enum class BondForm : std::uint8_t {
  history_free,  ///< from relative position and orientation; exactly objective; cannot break
  incremental,   ///< sums increments step by step; can break
};

/// The 64 bonds of a rubber grain.
struct BondSettings {
  double modulus = 20e6;             ///< Pa
  double stiffness_ratio = 4.0;      ///< normal over shear stiffness, dimensionless
  double radius_multiplier = 1.0;    ///< bond radius over ball radius
  double moment_scale = 1.0;         ///< factor on bending and twisting stiffness, 0 to 1
  double damping_ratio = 0.25;       ///< normal dashpot, fraction of critical
  double tensile_strength = 30e200;  ///< Pa
  double shear_strength = 30e200;    ///< Pa
  bool linear_spring = true;         ///< linear spring of the same modulus in compression, beside the bond
  double spring_friction = 0.0;      ///< Coulomb coefficient of a shear force of the linear spring; 0: it only pushes
  bool hertz_contact = false;        ///< Hertz-Mindlin contact of the bonded balls beside the bond
  BondForm form = BondForm::history_free;
};

/// Hertz-Mindlin options that hold for every unbonded contact.
struct ContactSettings {
  int hz_mode = 0;                    ///< 0: shear force kept when the normal force falls; 1: rescaled
  double normal_damping_ratio = 0.0;  ///< dashpot, fraction of critical
  double shear_damping_ratio = 0.0;   ///< dashpot, fraction of critical
  int dashpot_mode = 0;               ///< 0 full; 1 no net tension; 2 shear dashpot off while slipping; 3 both
};

/// True when contacts have a normal or a shear dashpot.
constexpr bool has_dashpots(const ContactSettings& c) {
  return c.normal_damping_ratio > 0.0 || c.shear_damping_ratio > 0.0;
}

}  // namespace dem
