// SPDX-License-Identifier: BSD-3-Clause
// How thick the band is in which a specimen shears, from the displacements of its grains.
#pragma once

#include <span>

namespace dem {

/// A grain as the fit sees it.
struct BandSample {
  double height = 0.0;        ///< m, of its centre now
  double displacement = 0.0;  ///< m, along the shear direction since shear began
  int slice = 0;              ///< of the width of the box, [0, k_band_slices)
};

/// Slices of equal width across the shear direction, which are alike but for chance.
inline constexpr int k_band_slices = 8;

/// The step in the displacements over the height. SI units; not a number where there is none to be found.
///   formula:  u(z) = u_below + slip Phi((z - centre) / s),  Phi the normal distribution;  thickness = sqrt(2 pi) s
///   thickness  |slip| over the steepest slope of u: as thick a layer of even shear, between blocks that do not shear, has the
///              same slope there
///   errors     standard errors by the jackknife: the fit without each of the k_band_slices slices in turn,
///              sqrt((K - 1) / K sum (value_k - mean)^2)
/// Source: least squares by Levenberg and Marquardt; jackknife: Quenouille (1956), Tukey (1958).
/// The band is one plane for the whole length of the box here, while in truth it bends and is wider in the middle: the
/// thickness is that of the mean profile.
struct ShearBand {
  double centre = 0.0, centre_error = 0.0;        ///< m, height
  double thickness = 0.0, thickness_error = 0.0;  ///< m
  double slip = 0.0;                ///< m, displacement above minus displacement below; negative in every test
  double displacement_below = 0.0;  ///< m
  double scatter = 0.0;             ///< m, root mean square of grain minus curve
};

/// height: of the specimen now, m; least_slip: m, a step that is smaller is none.
ShearBand fit_shear_band(std::span<const BandSample> grains, double height, double least_slip);

}  // namespace dem
