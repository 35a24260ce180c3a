// SPDX-License-Identifier: BSD-3-Clause
// Confidence bands of the anisotropies: the contacts are drawn anew from themselves, many times.
#pragma once

#include <cstdint>
#include <span>

#include "dem4grm/micro/options.hpp"
#include "dem4grm/micro/polar_histogram.hpp"

namespace dem {

/// Ends of an interval; not a number when it was not asked for.
struct Band {
  double low = 0.0, high = 0.0;
};

/// 95 % intervals; angles in rad, not folded back: around the value of the sample, so low <= high.
struct AnisotropyBands {
  Band fabric_amplitude, fabric_direction;
  Band normal_amplitude, normal_direction;
  Band shear_amplitude, shear_direction;
  Band signed_shear_amplitude, signed_shear_direction;
};

/// Percentile bootstrap: options.resamples times as many samples as there are are drawn with replacement, from the stream
/// (options.seed, bootstrap, set * k_most_resamples + resample), and the anisotropies found anew. set: a number that keeps
/// sets of contacts apart. Contacts count as independent, which those of one grain are not: the bands are rather narrow.
/// Source: Efron (1979).
AnisotropyBands bootstrap_bands(std::span<const PolarSample> samples, const MicroOptions& options, std::uint64_t set);

}  // namespace dem
