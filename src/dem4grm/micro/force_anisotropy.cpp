// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/force_anisotropy.hpp"

#include <algorithm>

namespace dem {
namespace {

ForceAnisotropy anisotropy_of(const PolarHistogram& histogram, const std::vector<double>& sums, int k) {
  std::vector<unsigned char> has_value;
  for (const double n : histogram.counts) has_value.push_back(n > 0.0 ? 1 : 0);
  ForceAnisotropy out;
  out.fit = fit_harmonic(bin_means(histogram, sums), has_value, histogram.bins, k);
  double sum = 0.0;
  for (const double s : sums) sum += s;
  out.mean_over_contacts = sum / histogram.count;
  return out;
}

}  // namespace

std::vector<double> bin_means(const PolarHistogram& histogram, const std::vector<double>& sums) {
  std::vector<double> means(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b) {
    if (histogram.counts[b] > 0.0) means[b] = sums[b] / histogram.counts[b];
  }
  return means;
}

ForceAnisotropy normal_force_anisotropy(const PolarHistogram& histogram) {
  return anisotropy_of(histogram, histogram.normal_sum, 2);
}

ForceAnisotropy shear_force_anisotropy(const PolarHistogram& histogram) {
  return anisotropy_of(histogram, histogram.shear_sum, 4);
}

}  // namespace dem
