// SPDX-License-Identifier: BSD-3-Clause
// A polar histogram over the full circle with the curves that are fitted to it, as plain columns for plots.
#pragma once

#include <vector>

#include "dem4grm/micro/polar_histogram.hpp"

namespace dem {

/// One row for each bin of the full circle; not a number where there is no contact, or no fit.
struct HistogramCurves {
  std::vector<double> angle_deg;                       ///< middle of the bin, from the shear direction; 90 is up
  std::vector<double> contacts;                        ///< in the bin and its opposite
  std::vector<double> density, density_fit;            ///< contacts per radian over all contacts
  std::vector<double> normal_force, normal_force_fit;  ///< N, mean over the bin
  std::vector<double> shear_force, shear_force_fit;    ///< N, of the magnitudes of the tangential forces
  std::vector<double> signed_shear, signed_shear_fit;  ///< N, tangential force with its sign in the shear plane
};
HistogramCurves histogram_curves(const PolarHistogram& histogram);

}  // namespace dem
