// SPDX-License-Identifier: BSD-3-Clause
// The straight strength envelope through tests of one mixture under several normal stresses.
//
//     tau = c + sigma tan(phi)
//
// sigma: normal stress, Pa; tau: peak or residual shear stress, Pa; c: cohesion (intercept), Pa; phi: friction angle, rad.
// Ordinary least squares of tau over sigma, n points, with mean sigma m and S = sum (sigma_i - m)^2:
//
//     tan(phi) = sum (sigma_i - m) tau_i / S,   c = mean(tau) - m tan(phi)
//     s^2 = sum (tau_i - c - sigma_i tan(phi))^2 / (n - 2)
//     bounds of tan(phi): +- t s / sqrt(S),   bounds of c: +- t s sqrt(1/n + m^2 / S)
//
// t: quantile of Student's distribution with n - 2 degrees of freedom, so that the bounds hold the true value in 95 of 100
// studies; the bounds of phi are the angles of those of tan(phi). Through the origin (c = 0): tan(phi) = sum sigma_i tau_i /
// sum sigma_i^2, s^2 over n - 1, bounds +- t s / sqrt(sum sigma_i^2). Source: any textbook of regression, as
// N. R. Draper and H. Smith, Applied Regression Analysis: fit of a straight line and its confidence intervals.
#pragma once

#include <optional>
#include <span>

namespace dem {

/// Result of one test, Pa.
struct StrengthPoint {
  double normal_stress = 0.0;
  double shear_stress = 0.0;
};

/// A value and where it lies with 95 % confidence; no bounds without spare points.
struct Estimate {
  double value = 0.0;
  std::optional<double> low, high;
};

struct MohrEnvelope {
  int points = 0;
  int stresses = 0;                              ///< different ones
  std::optional<Estimate> friction_angle;        ///< rad; nothing with one normal stress only
  std::optional<Estimate> cohesion;              ///< Pa
  std::optional<Estimate> angle_through_origin;  ///< rad; nothing without a point
  std::optional<double> residual_deviation;      ///< s, Pa; nothing with two points
  std::optional<double> determination;           ///< R^2; nothing when all shear stresses are equal
};

MohrEnvelope fit_envelope(std::span<const StrengthPoint> points);

/// The t with which a Student variable of so many degrees of freedom lies within +-t in 95 of 100 draws.
double student_quantile_95(int degrees_of_freedom);

}  // namespace dem
