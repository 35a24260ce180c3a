// SPDX-License-Identifier: BSD-3-Clause
// Which preparation friction gives a relative density: the next trial from the void ratios found so far.
//
//   D_r = (e_max - e) / (e_max - e_min)                                             (ASTM D4254, dimensionless)
//
// e_min and e_max are the void ratios under the same stress with the smallest and the largest friction; in between, e
// rises with the friction. D_r is nearly a straight line over x = m / (m + bend), m = mu - smallest mu, which bends the
// curve's long tail back. The first trial guesses the bend from e_max - e_min; from then on it is that of the curve
// through e_min, e_max and the trial nearest to the target. Specimens whose frictions differ by a hair scatter (a few
// per cent of D_r with 500 grains); so every trial keeps a little distance from the earlier ones, outside of what they
// enclose if need be. What counts is the density that a specimen has, not the friction that ought to give it: the guess
// decides how soon a specimen is found, never which is taken.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace dem {

/// A specimen that was compressed with one friction between its grains.
struct Branch {
  double friction = 0.0;
  double stress = 0.0;  ///< Pa, under which the void ratio was read
  double void_ratio = 0.0;
  std::int64_t steps = 0;  ///< time steps from the fill to there
};

struct DensityTarget {
  double relative_density = 0.5;  ///< fraction, above 0 and below 1
  double tolerance = 0.02;        ///< of the relative density, absolute
  double smallest_friction = 0.0, largest_friction = 2.0;
};

/// D_r of a void ratio, fraction; not limited to 0...1.
double relative_density(double e_min, double e_max, double e);

/// Friction of the next branch: the smallest, the largest, then trials. None when the last of `done` meets the target.
/// done: in the order in which this function asked for them. Throws PhysicsError when e_max is not above e_min, or when
/// no friction meets the target in k_most_trials.
std::optional<double> next_friction(std::span<const Branch> done, const DensityTarget& target);

inline constexpr std::size_t k_most_trials = 12;

}  // namespace dem
