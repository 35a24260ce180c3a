// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/force_anisotropy.hpp"

#include <algorithm>

namespace dem {
namespace {

std::vector<unsigned char> bins_with_contacts(const PolarHistogram& histogram) {
  std::vector<unsigned char> has_value;
  for (const double n : histogram.counts) has_value.push_back(n > 0.0 ? 1 : 0);
  return has_value;
}

ForceAnisotropy anisotropy_of(const PolarHistogram& histogram, const std::vector<double>& sums, int k) {
  ForceAnisotropy out;
  out.fit = fit_harmonic(bin_means(histogram, sums), bins_with_contacts(histogram), histogram.bins, k);
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

ForceAnisotropy second_shear_harmonic(const PolarHistogram& histogram) {
  return anisotropy_of(histogram, histogram.shear_sum, 2);
}

SignedShearAnisotropy signed_shear_anisotropy(const PolarHistogram& histogram, ForceMean mean) {
  const std::vector<double> signed_shear = bin_means(histogram, histogram.signed_shear_sum);
  const std::vector<unsigned char> has_value = bins_with_contacts(histogram);
  const Harmonic second = find_harmonic(signed_shear, has_value, histogram.bins, 2);
  const Harmonic fourth = find_harmonic(signed_shear, has_value, histogram.bins, 4);
  const ForceAnisotropy normal = normal_force_anisotropy(histogram);
  const double unit = mean == ForceMean::orientations ? normal.mean_over_orientations() : normal.mean_over_contacts;
  // -sin 2(theta - theta_s) = sin 2 theta_s cos 2 theta - cos 2 theta_s sin 2 theta
  return {second.amplitude() / unit, angle_of(-second.sine, second.cosine, 2), fourth.amplitude() / unit,
          second.residual / unit};
}

}  // namespace dem
