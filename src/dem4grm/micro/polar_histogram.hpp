// SPDX-License-Identifier: BSD-3-Clause
// Contacts sorted by their direction in the shear plane, and the one harmonic that is read off such a histogram.
//
// theta = atan2(n_z, n_x) from the shear direction x, 90 degrees is vertical. A contact points both ways (n and -n), so
// the second half of the circle repeats the first and only [0, pi) is kept: bin b is [b w, (b+1) w), w = 2 pi / bins.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/options.hpp"

namespace dem {

/// One contact as the shear plane sees it.
struct PolarSample {
  double angle = 0.0;         ///< rad, [0, pi)
  double normal_force = 0.0;  ///< N
  double shear_force = 0.0;   ///< N, magnitude of the whole vector
  double signed_shear = 0.0;  ///< N, tangential force within the plane, of i on j, along (-sin angle, cos angle)
};

/// The contacts that an analysis of the plane looks at: all, or those with |n_y| < k_near_plane.
std::vector<Contact> contacts_in_projection(std::span<const Contact> contacts, Projection projection);

/// Samples of contacts_in_projection, in their order. A normal along y has no direction in the plane and is left out.
std::vector<PolarSample> polar_samples(std::span<const Contact> contacts, const MicroOptions& options);

/// Numbers and sums of forces of the samples in each bin.
struct PolarHistogram {
  int bins = 0;                                                 ///< of the full circle
  double count = 0.0;                                           ///< of all samples
  std::vector<double> counts;                                   ///< [bins / 2]
  std::vector<double> normal_sum, shear_sum, signed_shear_sum;  ///< [bins / 2] N

  [[nodiscard]] double bin_width() const;                  ///< rad
  [[nodiscard]] double bin_centre(std::size_t bin) const;  ///< rad
};
PolarHistogram polar_histogram(std::span<const PolarSample> samples, int bins);

/// Where a sample goes.
std::size_t bin_of(double angle, int bins);

/// f(theta) = mean + cosine cos k theta + sine sin k theta, unit of the values.
struct Harmonic {
  double mean = 0.0, cosine = 0.0, sine = 0.0;  ///< as bins of that width show them
  double damping = 1.0;                         ///< d below
  double residual = 0.0;                        ///< root mean square of (bin - curve)
  int empty_bins = 0;                           ///< of the half circle

  /// Of the function itself, not of its means over bins.
  [[nodiscard]] double amplitude() const;
};
/// The coefficients of fit_harmonic without its reference to the mean, for values whose mean may vanish.
Harmonic find_harmonic(std::span<const double> values, std::span<const unsigned char> has_value, int bins, int k);

/// f(theta) = mean {1 + amplitude cos k(theta - direction)}.
struct HarmonicFit {
  double mean = 0.0;       ///< over the orientations, unit of the values
  double amplitude = 0.0;  ///< relative to the mean, >= 0
  double direction = 0.0;  ///< rad, [0, 2 pi / k)
  double residual = 0.0;   ///< root mean square of (bin - fit) over the mean
  int empty_bins = 0;      ///< of the half circle
};

/// The k-th harmonic (2 or 4) of values on the half circle.
///   formula:  mean = (1/2pi) int f,  C = (1/pi) int f cos k theta,  S = (1/pi) int f sin k theta   (trapezium rule)
///             amplitude = sqrt(C^2 + S^2) / mean / d,  direction = atan2(S, C) / k
///             d = sin(k w / 2) / (k w / 2): what averaging over a bin of width w leaves of the harmonic
/// Source: Rothenburg & Bathurst (1989); the article's appendix gives the same integrals.
/// Bins without a value leave a gap: then the three coefficients are a least-squares fit to the others, which is the same
/// when there is no gap. Not a number when fewer than three bins of different phase have values or the mean is 0.
/// values [bins / 2]; has_value [bins / 2], empty when all have.
HarmonicFit fit_harmonic(std::span<const double> values, std::span<const unsigned char> has_value, int bins, int k);

/// Where cosine cos k theta + sine sin k theta is largest, rad in [0, 2 pi / k).
double angle_of(double cosine, double sine, int k);

/// Value of the fit at an angle.
double value_at(const HarmonicFit& fit, int k, double angle);

}  // namespace dem
