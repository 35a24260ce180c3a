// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/shear_band.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace dem {
namespace {

constexpr double k_no_band = std::numeric_limits<double>::quiet_NaN();
constexpr int k_most_rounds = 200;
constexpr double k_thinnest = 1e-3;      // of the height: thinner than any grain
constexpr double k_thickest = 2.0;       // of the height: a straight line
constexpr double k_good_enough = 1e-10;  // relative change of the sum of squares
constexpr std::size_t k_least_grains = 12;

/// u_below, slip, centre, s.
using Curve = Eigen::Vector4d;

double bell(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }
double distribution(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

double value_at(const Curve& c, double z) { return c[0] + c[1] * distribution((z - c[2]) / c[3]); }

double square_sum(std::span<const BandSample> grains, const Curve& c) {
  double sum = 0.0;
  for (const BandSample& g : grains) {
    const double off = g.displacement - value_at(c, g.height);
    sum += off * off;
  }
  return sum;
}

/// Means of the lowest and the highest fifth, the middle, a band of a tenth.
Curve first_guess(std::span<const BandSample> grains, double height) {
  double below = 0.0, above = 0.0, n_below = 0.0, n_above = 0.0;
  for (const BandSample& g : grains) {
    if (g.height < 0.2 * height) below += g.displacement, n_below += 1.0;
    if (g.height > 0.8 * height) above += g.displacement, n_above += 1.0;
  }
  below /= std::max(1.0, n_below);
  above /= std::max(1.0, n_above);
  return {below, above - below, 0.5 * height, 0.1 * height};
}

struct Equations {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Curve right = Curve::Zero();
};

Equations normal_equations(std::span<const BandSample> grains, const Curve& c) {
  Equations out;
  for (const BandSample& g : grains) {
    const double x = (g.height - c[2]) / c[3], slope = c[1] * bell(x) / c[3];
    const Curve change{1.0, distribution(x), -slope, -slope * x};
    out.matrix += change * change.transpose();
    out.right += change * (g.displacement - value_at(c, g.height));
  }
  return out;
}

Curve within_bounds(Curve c, double height) {
  c[2] = std::clamp(c[2], 0.0, height);
  c[3] = std::clamp(c[3], k_thinnest * height, k_thickest * height);
  return c;
}

/// Levenberg and Marquardt from a first guess.
Curve fit(std::span<const BandSample> grains, double height, Curve c) {
  double sum = square_sum(grains, c), damping = 1e-3;
  for (int round = 0; round < k_most_rounds; ++round) {
    const Equations e = normal_equations(grains, c);
    Eigen::Matrix4d damped = e.matrix;
    damped.diagonal() *= 1.0 + damping;
    const Curve next = within_bounds(c + damped.ldlt().solve(e.right), height);
    const double next_sum = square_sum(grains, next);
    if (!(next_sum < sum)) {
      if (damping > 1e12) break;
      damping *= 10.0;
      continue;
    }
    const bool is_done = sum - next_sum < k_good_enough * sum;
    c = next;
    sum = next_sum;
    damping = std::max(1e-12, 0.1 * damping);
    if (is_done) break;
  }
  return c;
}

double thickness_of(const Curve& c) { return std::sqrt(2.0 * std::numbers::pi) * c[3]; }

/// Standard error of a value from those without one slice each.
double jackknife(const std::array<double, k_band_slices>& without) {
  double mean = 0.0, square = 0.0;
  for (const double v : without) mean += v / k_band_slices;
  for (const double v : without) square += (v - mean) * (v - mean);
  return std::sqrt(square * (k_band_slices - 1.0) / k_band_slices);
}

}  // namespace

ShearBand fit_shear_band(std::span<const BandSample> grains, double height, double least_slip) {
  const ShearBand none{k_no_band, k_no_band, k_no_band, k_no_band, k_no_band, k_no_band, k_no_band};
  if (grains.size() < k_least_grains) return none;
  const Curve guess = first_guess(grains, height);
  if (!(std::fabs(guess[1]) >= least_slip)) return none;
  const Curve c = fit(grains, height, guess);
  ShearBand out;
  out.centre = c[2];
  out.thickness = thickness_of(c);
  out.slip = c[1];
  out.displacement_below = c[0];
  out.scatter = std::sqrt(square_sum(grains, c) / static_cast<double>(grains.size()));
  std::array<double, k_band_slices> centre{}, thickness{};
  for (int slice = 0; slice < k_band_slices; ++slice) {
    std::vector<BandSample> others;
    std::copy_if(grains.begin(), grains.end(), std::back_inserter(others),
                 [&](const BandSample& g) { return g.slice != slice; });
    const Curve without = fit(others, height, c);
    centre[static_cast<std::size_t>(slice)] = without[2];
    thickness[static_cast<std::size_t>(slice)] = thickness_of(without);
  }
  out.centre_error = jackknife(centre);
  out.thickness_error = jackknife(thickness);
  return out;
}

}  // namespace dem
