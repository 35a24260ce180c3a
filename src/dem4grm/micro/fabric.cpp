// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/fabric.hpp"

#include <cmath>
#include <limits>

namespace dem {

std::vector<double> orientation_density(const PolarHistogram& histogram) {
  std::vector<double> density;
  density.reserve(histogram.counts.size());
  const double scale = 1.0 / (2.0 * histogram.count * histogram.bin_width());
  for (const double n : histogram.counts) density.push_back(n > 0.0 ? n * scale : 0.0);
  return density;
}

HarmonicFit fabric_anisotropy(const PolarHistogram& histogram) {
  return fit_harmonic(orientation_density(histogram), {}, histogram.bins, 2);
}

double isotropy_bound(double contacts) {
  return contacts > 0.0 ? 4.0 * std::sqrt(2.0 / contacts) : std::numeric_limits<double>::quiet_NaN();
}

double direction_error(double contacts, double amplitude) { return std::sqrt(2.0 / contacts) / (2.0 * amplitude); }

Tensor3 fabric_tensor(std::span<const Vec3> normals) {
  Tensor3 sum;
  for (const Vec3& n : normals) sum += outer(n, n);
  return normals.empty() ? sum : sum * (1.0 / static_cast<double>(normals.size()));
}

Tensor3 fabric_tensor(std::span<const Contact> contacts) { return fabric_tensor(normals_of(contacts)); }

Tensor3 fabric_tensor(std::span<const Contact> contacts, std::span<const unsigned char> flags, bool wanted) {
  Tensor3 sum;
  double n = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if ((flags[c] != 0) != wanted) continue;
    sum += outer(contacts[c].normal, contacts[c].normal);
    n += 1.0;
  }
  return n > 0.0 ? sum * (1.0 / n) : sum;
}

ProjectedFabric projected_fabric(const Tensor3& fabric) {
  return {5.0 * std::hypot(0.5 * (fabric.xx() - fabric.zz()), 0.5 * (fabric.xz() + fabric.zx())),
          major_axis_in_shear_plane(fabric)};
}

}  // namespace dem
