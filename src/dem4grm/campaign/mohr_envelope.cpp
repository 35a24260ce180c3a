// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/mohr_envelope.hpp"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <set>

namespace dem {
namespace {

/// `half`: half of the width of the interval; nothing where it is not known.
Estimate with_bounds(double value, std::optional<double> half) {
  if (!half) return {value, std::nullopt, std::nullopt};
  return {value, value - *half, value + *half};
}

Estimate angle_of(const Estimate& slope) {
  Estimate angle{std::atan(slope.value), std::nullopt, std::nullopt};
  if (slope.low) angle.low = std::atan(*slope.low);
  if (slope.high) angle.high = std::atan(*slope.high);
  return angle;
}

Estimate fit_through_origin(std::span<const StrengthPoint> points) {
  double square = 0.0, product = 0.0, residual = 0.0;
  for (const StrengthPoint& p : points) {
    square += p.normal_stress * p.normal_stress;
    product += p.normal_stress * p.shear_stress;
  }
  const double slope = product / square;
  for (const StrengthPoint& p : points) residual += std::pow(p.shear_stress - slope * p.normal_stress, 2);
  const int spare = static_cast<int>(points.size()) - 1;
  std::optional<double> half;
  if (spare > 0) half = student_quantile_95(spare) * std::sqrt(residual / spare / square);
  return angle_of(with_bounds(slope, half));
}

}  // namespace

double student_quantile_95(int degrees_of_freedom) {
  return boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975);
}

MohrEnvelope fit_envelope(std::span<const StrengthPoint> points) {
  MohrEnvelope out;
  out.points = static_cast<int>(points.size());
  std::set<double> stresses;
  double mean_sigma = 0.0, mean_tau = 0.0;
  for (const StrengthPoint& p : points) {
    stresses.insert(p.normal_stress);
    mean_sigma += p.normal_stress / out.points;
    mean_tau += p.shear_stress / out.points;
  }
  out.stresses = static_cast<int>(stresses.size());
  if (out.points == 0 || *stresses.rbegin() <= 0.0) return out;
  out.angle_through_origin = fit_through_origin(points);
  if (out.stresses < 2) return out;

  double square = 0.0, product = 0.0, all = 0.0, residual = 0.0;
  for (const StrengthPoint& p : points) {
    const double sigma = p.normal_stress - mean_sigma, tau = p.shear_stress - mean_tau;
    square += sigma * sigma;
    product += sigma * tau;
    all += tau * tau;
  }
  const double slope = product / square, intercept = mean_tau - slope * mean_sigma;
  for (const StrengthPoint& p : points) residual += std::pow(p.shear_stress - intercept - slope * p.normal_stress, 2);
  std::optional<double> half_slope, half_intercept;
  if (out.points > 2) {
    out.residual_deviation = std::sqrt(residual / (out.points - 2));
    const double t = student_quantile_95(out.points - 2);
    half_slope = t * *out.residual_deviation / std::sqrt(square);
    half_intercept = t * *out.residual_deviation * std::sqrt(1.0 / out.points + mean_sigma * mean_sigma / square);
  }
  out.friction_angle = angle_of(with_bounds(slope, half_slope));
  out.cohesion = with_bounds(intercept, half_intercept);
  if (all > 0.0) out.determination = 1.0 - residual / all;
  return out;
}

}  // namespace dem
