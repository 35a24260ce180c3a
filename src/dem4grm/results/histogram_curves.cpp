// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/histogram_curves.hpp"

#include <cmath>
#include <limits>

#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/force_anisotropy.hpp"

namespace dem {
namespace {

/// Value of the curve that the second harmonic gives, N.
double signed_shear_at(double mean_normal_force, const SignedShearAnisotropy& fit, double angle) {
  return -mean_normal_force * fit.amplitude * std::sin(2.0 * (angle - fit.direction));
}

}  // namespace

HistogramCurves histogram_curves(const PolarHistogram& h) {
  const std::vector<double> density = orientation_density(h);
  const std::vector<double> normal = bin_means(h, h.normal_sum), shear = bin_means(h, h.shear_sum);
  const std::vector<double> signed_shear = bin_means(h, h.signed_shear_sum);
  const HarmonicFit fabric_fit = fabric_anisotropy(h), normal_fit = normal_force_anisotropy(h).fit,
                    shear_fit = shear_force_anisotropy(h).fit;
  const SignedShearAnisotropy signed_fit = signed_shear_anisotropy(h, ForceMean::orientations);
  const std::size_t half = h.counts.size();
  HistogramCurves out;
  for (std::size_t k = 0; k < 2 * half; ++k) {
    const std::size_t b = k % half;  // n and -n
    const double angle = h.bin_centre(k);
    const auto force = [&](double value) {
      return h.counts[b] > 0.0 ? value : std::numeric_limits<double>::quiet_NaN();
    };
    out.angle_deg.push_back((static_cast<double>(k) + 0.5) * 360.0 / h.bins);
    out.contacts.push_back(h.counts[b]);
    out.density.push_back(density[b]);
    out.density_fit.push_back(value_at(fabric_fit, 2, angle));
    out.normal_force.push_back(force(normal[b]));
    out.normal_force_fit.push_back(value_at(normal_fit, 2, angle));
    out.shear_force.push_back(force(shear[b]));
    out.shear_force_fit.push_back(value_at(shear_fit, 4, angle));
    out.signed_shear.push_back(force(signed_shear[b]));
    out.signed_shear_fit.push_back(signed_shear_at(normal_fit.mean, signed_fit, angle));
  }
  return out;
}

}  // namespace dem
