// SPDX-License-Identifier: BSD-3-Clause
// What is measured on a finished specimen and cannot be measured any more once it is sheared.
#pragma once

#include "dem4grm/micro/homogeneity.hpp"
#include "dem4grm/walls/box_settings.hpp"

namespace dem {

/// Coefficients of earth pressure at rest.
/// formula:  K0_x = (|F_x| of both walls -x + |F_x| of both walls +x) / (2 b h) / sigma_z,   K0_y likewise with l for b
///   F        force of the grains on the lower and the upper wall of a side together, N
///   l, b, h  length and width of the box, height of the specimen between the plates, m
///   sigma_z  mean of the normal stresses on both plates, force over l b, Pa
/// Source: definition (Jaky 1944). Not a number without a load on the plates.
struct LateralStress {
  double k0_x = 0.0;  ///< along the shear direction
  double k0_y = 0.0;  ///< across it
};
LateralStress measure_lateral_stress(const Simulation& s, const BoxSettings& box);

struct BeforeShear {
  Homogeneity homogeneity;
  LateralStress lateral;
};

}  // namespace dem
