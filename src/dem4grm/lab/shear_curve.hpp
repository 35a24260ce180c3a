// SPDX-License-Identifier: BSD-3-Clause
// What an engineer reads off a shear record.
#pragma once

#include <limits>
#include <span>

#include "dem4grm/lab/observer.hpp"

namespace dem {

/// Displacement over which shear stress and rise of the plate are read together, m.
inline constexpr double k_dilatancy_window = 0.5e-3;

/// Over all these rows.
Dilatancy dilatancy_of(std::span<const ShearRow> rows);
/// Over the last k_dilatancy_window of these rows, or as much of it as there is.
Dilatancy last_dilatancy(std::span<const ShearRow> rows);

/// What a record is too short for.
inline constexpr double k_not_measured = std::numeric_limits<double>::quiet_NaN();

/// The dilatancy of one window of the record.
struct Stage {
  double displacement = k_not_measured;  ///< m, middle of the window
  Dilatancy dilatancy{k_not_measured, k_not_measured, k_not_measured};
};

/// What a laboratory reports beside a strength: means over the window that the strength is a mean of.
struct ShearPoint {
  double displacement = k_not_measured;           ///< m, of the halves against each other
  double vertical_displacement = k_not_measured;  ///< m, rise of the plate since shear began
  double normal_stress = k_not_measured;          ///< Pa, over the nominal area
};

/// SI units; angles in radians; not a number where the record is shorter than a window.
struct ShearCurve {
  double peak_stress = k_not_measured;           ///< Pa, largest running mean over 0.1 mm
  double displacement_at_peak = k_not_measured;  ///< m, middle of that window
  bool is_hardening = false;                     ///< the peak lies in the last 1 mm
  double residual_stress = k_not_measured;       ///< Pa, mean of the last 2 mm
  double secant_stiffness = k_not_measured;      ///< Pa/m, at the first point that reaches half the peak
  double dilation_angle = k_not_measured;        ///< of the steepest rise of the plate over 1 mm
  double vertical_displacement_at_end = 0.0;     ///< m
  double contraction = 0.0;                  ///< m, deepest place of the plate below its start; 0 when it never sinks
  double displacement_at_contraction = 0.0;  ///< m, there
  Stage at_peak;                             ///< window around displacement_at_peak
  Stage fastest_dilation;                    ///< window of the largest rate
  Stage residual;                            ///< the last 2 mm
  ShearPoint peak_point;                     ///< of peak_stress
  ShearPoint residual_point;                 ///< of residual_stress
};

/// Rows in order of displacement, at equal intervals, the first averaged from the displacement `start` (m) on. A record of less
/// than 0.1 mm has no curve, one that does not begin with the start of shear no secant stiffness.
ShearCurve read_shear_curve(std::span<const ShearRow> rows, double start = 0.0);

}  // namespace dem
