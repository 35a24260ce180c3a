// SPDX-License-Identifier: BSD-3-Clause
// How the mean normal and tangential forces of the contacts depend on direction.
#pragma once

#include <vector>

#include "dem4grm/micro/polar_histogram.hpp"

namespace dem {

/// One force against direction.
struct ForceAnisotropy {
  HarmonicFit fit;                  ///< mean and amplitude by orientations, N
  double mean_over_contacts = 0.0;  ///< N
  [[nodiscard]] double mean_over_orientations() const { return fit.mean; }
  /// a_n or a_t with the chosen mean as f_0.
  [[nodiscard]] double amplitude(ForceMean mean) const {
    return mean == ForceMean::orientations ? fit.amplitude : fit.amplitude * fit.mean / mean_over_contacts;
  }
};

/// f_n(theta) = f_n0 {1 + a_n cos 2(theta - theta_n)}.
///   formula:  f_n(theta_b) = mean normal force of the contacts of bin b,  fit_harmonic with k = 2
///   f_n0      mean of the bins (Rothenburg & Bathurst) or of the contacts; the two differ by the factor
///             1 + (a a_n / 2) cos 2(theta_a - theta_n)
/// Source: Rothenburg & Bathurst (1989).
ForceAnisotropy normal_force_anisotropy(const PolarHistogram& histogram);

/// f_t(theta) = f_t0 {1 + a_t cos 4(theta - theta_t)}, of the magnitudes |f_t|; theta_t in [0, pi/2).
/// Friction that follows the shear stress alone, |f_t| ~ |sin 2(theta - theta_0)| = 2/pi - (4/3pi) cos 4(theta - theta_0)
/// - ..., gives a_t = 2/3 and theta_t = theta_0 + 45 degrees; forces of any direction beside it lower a_t.
/// Source: Chew et al. (2022).
ForceAnisotropy shear_force_anisotropy(const PolarHistogram& histogram);

/// The second harmonic of |f_t| beside the fourth: f_t(theta) = f_t0 {1 + a_t2 cos 2(theta - theta_t2)}. Tangential forces
/// follow the normal forces that limit them, so it exists wherever a_n does.
ForceAnisotropy second_shear_harmonic(const PolarHistogram& histogram);

/// The tangential force with its sign: what a contact adds to the stress by it.
struct SignedShearAnisotropy {
  double amplitude = 0.0;  ///< a_s, relative to f_n0
  double direction = 0.0;  ///< theta_s, rad in [0, pi)
  double fourth = 0.0;     ///< amplitude of the fourth harmonic of the signed force over f_n0
  double residual = 0.0;   ///< root mean square of bin minus the curve of the second harmonic, over f_n0
};

/// f_s(theta) = -f_n0 a_s sin 2(theta - theta_s), f_s(theta_b) the mean over bin b of the tangential force of i on j within
/// the shear plane, positive towards growing theta; f_n0 the mean normal force over the same choice (orientations or contacts).
///   theta_s  the major axis of the stress to which these forces belong
/// In two dimensions sin(phi) = (a + a_n + a_s) / 2 where the three axes agree.
/// Source: Rothenburg & Bathurst (1989).
SignedShearAnisotropy signed_shear_anisotropy(const PolarHistogram& histogram, ForceMean mean);

/// Mean forces of the bins, N; 0 for a bin without contacts.
std::vector<double> bin_means(const PolarHistogram& histogram, const std::vector<double>& sums);

}  // namespace dem
