// SPDX-License-Identifier: BSD-3-Clause
// What an engineer reads off a shear record.
#pragma once

#include <span>

#include "dem4grm/lab/observer.hpp"

namespace dem {

/// SI units; angles in radians.
struct ShearCurve {
  double peak_stress = 0.0;                   ///< Pa, largest running mean over 0.1 mm
  double displacement_at_peak = 0.0;          ///< m, middle of that window
  bool is_hardening = false;                  ///< the peak lies in the last 1 mm
  double residual_stress = 0.0;               ///< Pa, mean of the last 2 mm
  double secant_stiffness = 0.0;              ///< Pa/m, at the first point that reaches half the peak
  double dilation_angle = 0.0;                ///< of the steepest rise of the plate over 1 mm
  double vertical_displacement_at_end = 0.0;  ///< m
};

/// Rows in order of displacement, at equal intervals. Less than 0.1 mm of record gives zeros.
ShearCurve read_shear_curve(std::span<const ShearRow> rows);

}  // namespace dem
