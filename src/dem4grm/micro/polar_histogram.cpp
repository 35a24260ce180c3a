// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/polar_histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr double k_pi = std::numbers::pi;

/// mean, C and S of the header without the damping, unit of the values.
struct Coefficients {
  double mean = 0.0, cosine = 0.0, sine = 0.0;
};

Coefficients by_integrals(std::span<const double> values, const std::vector<double>& c, const std::vector<double>& s) {
  Coefficients out;
  const auto n = static_cast<double>(values.size());
  for (std::size_t b = 0; b < values.size(); ++b) {
    out.mean += values[b];
    out.cosine += values[b] * c[b];
    out.sine += values[b] * s[b];
  }
  return {out.mean / n, 2.0 * out.cosine / n, 2.0 * out.sine / n};
}

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

/// Normal equations of the least squares by Cramer's rule.
Coefficients by_least_squares(std::span<const double> values, std::span<const unsigned char> has_value,
                              const std::vector<double>& c, const std::vector<double>& s) {
  Vec3 one, cosine, sine, right;  // columns of the matrix, and the right side
  for (std::size_t b = 0; b < values.size(); ++b) {
    if (has_value[b] == 0) continue;
    const Vec3 basis{1.0, c[b], s[b]};
    one += basis;
    cosine += basis * c[b];
    sine += basis * s[b];
    right += basis * values[b];
  }
  const double n = one.x, d = determinant(one, cosine, sine);
  // One or two phases leave a determinant of rounding, 1e-16; three next to each other in the finest histogram 1e-12.
  if (!(d > 1e-13 * n * n * n)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  return {determinant(right, cosine, sine) / d, determinant(one, right, sine) / d, determinant(one, cosine, right) / d};
}

}  // namespace

double angle_of(double cosine, double sine, int k) {
  const double period = 2.0 * k_pi / k, angle = std::atan2(sine, cosine) / k;
  return angle < 0.0 ? std::fmod(angle + period, period) : angle;
}

double Harmonic::amplitude() const { return std::hypot(cosine, sine) / damping; }

double PolarHistogram::bin_width() const { return 2.0 * k_pi / bins; }
double PolarHistogram::bin_centre(std::size_t bin) const { return (static_cast<double>(bin) + 0.5) * bin_width(); }

std::vector<Contact> contacts_in_projection(std::span<const Contact> contacts, Projection projection) {
  std::vector<Contact> out(contacts.begin(), contacts.end());
  if (projection == Projection::near_plane) {
    std::erase_if(out, [](const Contact& c) { return !(std::fabs(c.normal.y) < k_near_plane); });
  }
  return out;
}

std::vector<PolarSample> polar_samples(std::span<const Contact> contacts, const MicroOptions& options) {
  std::vector<PolarSample> samples;
  samples.reserve(contacts.size());
  for (const Contact& c : contacts) {
    if (options.projection == Projection::near_plane && !(std::fabs(c.normal.y) < k_near_plane)) continue;
    double x = c.normal.x, z = c.normal.z;
    if (x == 0.0 && z == 0.0) continue;
    // One of n and -n, always the same one: then the exchange of i and j changes no bit.
    const bool is_turned = z < 0.0 || (z == 0.0 && x < 0.0);
    if (is_turned) x = -x, z = -z;
    const double angle = std::atan2(z, x);
    const Vec3 across{-z, 0.0, x};
    const double signed_shear = dot(c.shear_force, across) / std::hypot(x, z);  // of j on i
    samples.push_back({angle < k_pi ? std::fabs(angle) : 0.0, c.normal_force, norm(c.shear_force),
                       is_turned ? signed_shear : 0.0 - signed_shear});
  }
  return samples;
}

std::size_t bin_of(double angle, int bins) {
  const auto bin = static_cast<int>(angle * (bins / (2.0 * k_pi)));
  return static_cast<std::size_t>(std::clamp(bin, 0, bins / 2 - 1));
}

PolarHistogram polar_histogram(std::span<const PolarSample> samples, int bins) {
  PolarHistogram out;
  out.bins = bins;
  out.count = static_cast<double>(samples.size());
  const auto half = static_cast<std::size_t>(bins / 2);
  out.counts.resize(half);
  out.normal_sum.resize(half);
  out.shear_sum.resize(half);
  out.signed_shear_sum.resize(half);
  for (const PolarSample& sample : samples) {
    const std::size_t b = bin_of(sample.angle, bins);
    out.counts[b] += 1.0;
    out.normal_sum[b] += sample.normal_force;
    out.shear_sum[b] += sample.shear_force;
    out.signed_shear_sum[b] += sample.signed_shear;
  }
  return out;
}

Harmonic find_harmonic(std::span<const double> values, std::span<const unsigned char> has_value, int bins, int k) {
  require(values.size() == static_cast<std::size_t>(bins / 2),
          "a histogram has a value for each bin of the half circle");
  const double w = 2.0 * k_pi / bins;
  std::vector<double> c(values.size()), s(values.size());
  for (std::size_t b = 0; b < values.size(); ++b) {
    const double phase = k * (static_cast<double>(b) + 0.5) * w;
    c[b] = std::cos(phase);
    s[b] = std::sin(phase);
  }
  Harmonic out;
  out.empty_bins = static_cast<int>(std::count(has_value.begin(), has_value.end(), 0));
  const Coefficients f = out.empty_bins == 0 ? by_integrals(values, c, s) : by_least_squares(values, has_value, c, s);
  out.mean = f.mean;
  out.cosine = f.cosine;
  out.sine = f.sine;
  out.damping = std::sin(0.5 * k * w) / (0.5 * k * w);
  double square = 0.0, used = 0.0;
  for (std::size_t b = 0; b < values.size(); ++b) {
    if (!has_value.empty() && has_value[b] == 0) continue;
    const double off = values[b] - (f.mean + f.cosine * c[b] + f.sine * s[b]);
    square += off * off;
    used += 1.0;
  }
  out.residual = std::sqrt(square / used);
  return out;
}

HarmonicFit fit_harmonic(std::span<const double> values, std::span<const unsigned char> has_value, int bins, int k) {
  const Harmonic f = find_harmonic(values, has_value, bins, k);
  HarmonicFit out;
  out.mean = f.mean;
  out.empty_bins = f.empty_bins;
  if (f.mean == 0.0) {
    out.amplitude = out.direction = out.residual = std::numeric_limits<double>::quiet_NaN();
    return out;
  }
  out.amplitude = std::hypot(f.cosine, f.sine) / f.mean / f.damping;
  out.direction = angle_of(f.cosine, f.sine, k);
  out.residual = f.residual / f.mean;
  return out;
}

double value_at(const HarmonicFit& fit, int k, double angle) {
  return fit.mean * (1.0 + fit.amplitude * std::cos(k * (angle - fit.direction)));
}

}  // namespace dem
