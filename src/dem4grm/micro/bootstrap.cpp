// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/bootstrap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/force_anisotropy.hpp"

namespace dem {
namespace {

constexpr std::size_t k_values = 8;
constexpr double k_outside = 0.025;  // on either side of the band

/// Amplitude and direction of fabric, normal, shear and signed shear force.
using Anisotropies = std::array<double, k_values>;
/// Period of each of them; 0: no angle.
constexpr Anisotropies k_period{0.0, std::numbers::pi,       0.0, std::numbers::pi,
                                0.0, 0.5 * std::numbers::pi, 0.0, std::numbers::pi};

Anisotropies anisotropies_of(const PolarHistogram& histogram, ForceMean mean) {
  const HarmonicFit fabric = fabric_anisotropy(histogram);
  const ForceAnisotropy normal = normal_force_anisotropy(histogram), shear = shear_force_anisotropy(histogram);
  const SignedShearAnisotropy signed_shear = signed_shear_anisotropy(histogram, mean);
  return {fabric.amplitude,      fabric.direction,    normal.amplitude(mean), normal.fit.direction,
          shear.amplitude(mean), shear.fit.direction, signed_shear.amplitude, signed_shear.direction};
}

/// As many samples as there are, drawn with replacement.
PolarHistogram draw(std::span<const PolarSample> samples, std::span<const std::size_t> bins, int n_bins,
                    RandomSequence& random) {
  PolarHistogram out = polar_histogram({}, n_bins);
  const auto n = static_cast<double>(samples.size());
  out.count = n;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const auto drawn = static_cast<std::size_t>(random.uniform() * n);
    out.counts[bins[drawn]] += 1.0;
    out.normal_sum[bins[drawn]] += samples[drawn].normal_force;
    out.shear_sum[bins[drawn]] += samples[drawn].shear_force;
    out.signed_shear_sum[bins[drawn]] += samples[drawn].signed_shear;
  }
  return out;
}

/// The angle nearest to `to` among those a whole number of periods away.
double unfolded(double angle, double to, double period) {
  return period > 0.0 ? angle - period * std::nearbyint((angle - to) / period) : angle;
}

Band band_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {nan, nan};
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return {values[static_cast<std::size_t>(std::floor(k_outside * last))],
          values[static_cast<std::size_t>(std::ceil((1.0 - k_outside) * last))]};
}

}  // namespace

AnisotropyBands bootstrap_bands(std::span<const PolarSample> samples, const MicroOptions& options, std::uint64_t set) {
  std::vector<std::size_t> bins;
  bins.reserve(samples.size());
  for (const PolarSample& sample : samples) bins.push_back(bin_of(sample.angle, options.bins));
  const Anisotropies found = anisotropies_of(polar_histogram(samples, options.bins), options.force_mean);
  std::array<std::vector<double>, k_values> drawn;
  for (int k = 0; k < options.resamples && !samples.empty(); ++k) {
    RandomSequence random(options.seed, RandomStream::bootstrap,
                          set * k_most_resamples + static_cast<std::uint64_t>(k));
    const Anisotropies one = anisotropies_of(draw(samples, bins, options.bins, random), options.force_mean);
    for (std::size_t v = 0; v < k_values; ++v) drawn[v].push_back(unfolded(one[v], found[v], k_period[v]));
  }
  std::array<Band, k_values> bands;
  for (std::size_t v = 0; v < k_values; ++v) bands[v] = band_of(std::move(drawn[v]));
  return {bands[0], bands[1], bands[2], bands[3], bands[4], bands[5], bands[6], bands[7]};
}

}  // namespace dem
