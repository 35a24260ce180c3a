// SPDX-License-Identifier: BSD-3-Clause
// Mass properties of unions of spheres by two other ways than the code of the clumps: slices along a common axis in
// closed form, and random points.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/grains/clump_template.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

/// Volume L^3, place of the centroid on the axis L, moments about the centroid L^5.
struct RevolvedBody {
  double volume = 0.0, centroid = 0.0, axial = 0.0, transverse = 0.0;
};

/// Integrals over t = x - c of the squared profile p = R^2 - t^2 of a sphere at c: of p, p t, p t^2 and p^2.
inline std::array<double, 4> profile_integrals(double radius, double t) {
  const double r2 = radius * radius, t2 = t * t, t3 = t2 * t, t5 = t3 * t2;
  return {r2 * t - t3 / 3, r2 * t2 / 2 - t2 * t2 / 4, r2 * t3 / 3 - t5 / 5, r2 * r2 * t - 2 * r2 * t3 / 3 + t5 / 5};
}

/// Union of spheres in a row on one axis, each overlapping the next and none reaching past it: they part at the planes
/// of their common circles. Discs of radius^2 p: volume pi p, axial moment pi p^2 / 2, transverse pi p^2 / 4 + pi p
/// x^2. centres ascending and radii in L.
inline RevolvedBody spheres_in_a_row(std::span<const double> centres, std::span<const double> radii) {
  const std::size_t n = centres.size();
  double volume = 0.0, first = 0.0, axial = 0.0, transverse = 0.0, from = centres[0] - radii[0];
  for (std::size_t i = 0; i < n; ++i) {
    double to = centres[i] + radii[i];
    if (i + 1 < n) {
      const double d = centres[i + 1] - centres[i];
      to = centres[i] + (d * d + radii[i] * radii[i] - radii[i + 1] * radii[i + 1]) / (2 * d);
    }
    const auto high = profile_integrals(radii[i], to - centres[i]),
               low = profile_integrals(radii[i], from - centres[i]);
    const double p0 = high[0] - low[0], p1 = high[1] - low[1], p2 = high[2] - low[2], c = centres[i];
    volume += k_pi * p0;
    first += k_pi * (p1 + c * p0);
    axial += k_pi / 2 * (high[3] - low[3]);
    transverse += k_pi / 4 * (high[3] - low[3]) + k_pi * (p2 + 2 * c * p1 + c * c * p0);
    from = to;
  }
  return {volume, first / volume, axial, transverse - first * first / volume};
}

/// Mean of independent samples and its standard error; the unit is that of the samples.
struct Estimate {
  double mean = 0.0, error = 0.0;
};

inline Estimate estimate(std::span<const double> samples) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0.0, squares = 0.0;
  for (const double v : samples) sum += v;
  for (const double v : samples) squares += (v - sum / n) * (v - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1)))};
}

/// Integrals over a union by random points, one in each cell of a cube: volume; first moments; second moments xx, yy,
/// zz, xy, xz, yz.
using UnionSums = std::array<double, 10>;

inline bool is_inside(std::span<const Pebble> pebbles, const Vec3& p) {
  for (const Pebble& pebble : pebbles) {
    const Vec3 d = p - pebble.position;
    if (dot(d, d) <= pebble.radius * pebble.radius) return true;
  }
  return false;
}

/// `half`: half the side of the cube about the origin that holds the union, L; n cells along a side.
inline UnionSums sample_union(std::span<const Pebble> pebbles, double half, int n, RandomSequence random) {
  UnionSums sums{};
  const double cell = 2 * half / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const Vec3 p{(i + random.uniform()) * cell - half, (j + random.uniform()) * cell - half,
                     (k + random.uniform()) * cell - half};
        if (!is_inside(pebbles, p)) continue;
        const UnionSums terms{1, p.x, p.y, p.z, p.x * p.x, p.y * p.y, p.z * p.z, p.x * p.y, p.x * p.z, p.y * p.z};
        for (std::size_t t = 0; t < terms.size(); ++t) sums[t] += terms[t];
      }
    }
  }
  for (double& s : sums) s *= cell * cell * cell;
  return sums;
}

/// Smallest square opening of pebbles by brute force: all orientations of a fine scan, the best ones followed down.
double scanned_opening(std::span<const Pebble> pebbles);

}  // namespace dem::verify
