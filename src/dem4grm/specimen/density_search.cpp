// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/density_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

// First guess: friction that does half of the way from e_min to e_max, from how far apart these are. Through the
// specimens of docs/results/calibration-void-ratio.md, within a factor of 1.3 (gravel and rubber, both sizes of box).
constexpr double k_half_way_scale = 0.68, k_half_way_power = 1.3;
constexpr double k_trials_per_unit = 1e4;   // trials are round numbers, which can be typed into a case
constexpr double k_spacing = 0.005;         // of trials over their friction, and at least
constexpr double k_least_spacing = 0.0003;  // this: enough for another specimen
constexpr double k_edge = 0.05;             // share of a bracket that no estimate enters

double rounded(double friction) { return std::floor(friction * k_trials_per_unit + 0.5) / k_trials_per_unit; }

/// A specimen and how much too dense it is.
struct Point {
  double friction = 0.0, miss = 0.0;
};

/// The axis x = m / (m + bend) with m the friction beyond the smallest, on which D_r is taken for a straight line. An
/// infinite bend leaves the friction as it is.
struct BentAxis {
  double smallest = 0.0, bend = 0.0;
  [[nodiscard]] double at(double friction) const {
    const double m = friction - smallest;
    return std::isinf(bend) ? m : m / (m + bend);
  }
  [[nodiscard]] double friction(double x) const { return smallest + (std::isinf(bend) ? x : bend * x / (1.0 - x)); }
};

/// The bend of the axis on which the way from e_min to e_max is straight and this friction has done a share of it.
/// Infinite when the friction has done no more than its part of the whole range.
double bend_through(double friction, double share, double range) {
  return share * range > friction ? friction * range * (1.0 - share) / (share * range - friction)
                                  : std::numeric_limits<double>::infinity();
}

std::vector<Point> points_of(std::span<const Branch> done, double target) {
  std::vector<Point> points;
  for (const Branch& b : done) {
    points.push_back({b.friction, relative_density(done[0].void_ratio, done[1].void_ratio, b.void_ratio) - target});
  }
  return points;
}

/// The axis that goes through both ends and the trial nearest to the target; through the first guess without a trial.
BentAxis axis_of(std::span<const Branch> done, std::span<const Point> points, double target) {
  const double smallest = done[0].friction, range = done[1].friction - smallest;
  const auto nearest = std::min_element(points.begin() + 2, points.end(), [](const Point& a, const Point& b) {
    return std::fabs(a.miss) < std::fabs(b.miss);
  });
  if (nearest == points.end()) {
    const double half_way = k_half_way_scale * std::pow(done[1].void_ratio - done[0].void_ratio, k_half_way_power);
    return {smallest, bend_through(std::min(half_way, 0.25 * range), 0.5, range)};
  }
  const double share = std::clamp(1.0 - (nearest->miss + target), k_edge, 1.0 - k_edge);
  return {smallest, bend_through(nearest->friction - smallest, share, range)};
}

/// Where the curve ought to cross zero: between the loosest specimen that is too dense and the densest that is too loose.
/// Scatter may have put them the wrong way round; then half-way.
double crossing(std::span<const Point> points, const BentAxis& axis) {
  Point low = points[0], high = points[1];
  for (const Point& p : points) {
    if (p.miss > 0.0 && p.friction > low.friction) low = p;
    if (p.miss <= 0.0 && p.friction < high.friction) high = p;
  }
  const double share = low.friction < high.friction ? low.miss / (low.miss - high.miss) : 0.5;
  const double x_low = axis.at(low.friction), x_high = axis.at(high.friction);
  return axis.friction(x_low + (x_high - x_low) * std::clamp(share, k_edge, 1.0 - k_edge));
}

/// The nearest friction that keeps its distance from all that were tried; below and above in turn. None when the range
/// is full.
std::optional<double> free_friction(std::span<const Branch> done, double friction) {
  const double spacing = std::max(k_least_spacing, k_spacing * friction);
  const double least = done[0].friction, most = done[1].friction;
  for (int k = 0; k * spacing < most - least; ++k) {
    for (const double side : {-1.0, 1.0}) {
      const double place = rounded(friction + side * k * spacing);
      const bool is_free = std::all_of(done.begin(), done.end(), [&](const Branch& b) {
        return std::fabs(b.friction - place) >= spacing * (1.0 - 1e-9);
      });
      if (is_free && place > least && place < most) return place;
    }
  }
  return std::nullopt;
}

std::string trials_text(std::span<const Branch> done) {
  std::string text;
  for (const Branch& b : done) {
    text += fmt::format("\n  friction {:.4f}: void ratio {:.4f}, relative density {:.3f}", b.friction, b.void_ratio,
                        relative_density(done[0].void_ratio, done[1].void_ratio, b.void_ratio));
  }
  return text;
}

}  // namespace

double relative_density(double e_min, double e_max, double e) { return (e_max - e) / (e_max - e_min); }

std::optional<double> next_friction(std::span<const Branch> done, const DensityTarget& target) {
  if (done.empty()) return target.smallest_friction;
  if (done.size() == 1) return target.largest_friction;
  const double e_min = done[0].void_ratio, e_max = done[1].void_ratio;
  if (!(e_max > e_min)) {
    throw PhysicsError(fmt::format(
        "friction does not make the specimen looser: void ratio {:.4f} with friction {}, {:.4f} with {}; generate it "
        "at a larger generation_void_ratio",
        e_min, done[0].friction, e_max, done[1].friction));
  }
  const std::vector<Point> points = points_of(done, target.relative_density);
  if (done.size() > 2 && std::fabs(points.back().miss) <= target.tolerance) return std::nullopt;
  std::optional<double> next;
  if (done.size() - 2 < k_most_trials)
    next = free_friction(done, crossing(points, axis_of(done, points, target.relative_density)));
  if (!next) {
    throw PhysicsError(fmt::format(
        "no preparation friction gave a relative density of {} within {}; raise specimen.relative_density_tolerance "
        "(with --store these specimens are not made again), or choose another seed or a larger specimen. Tried:{}",
        target.relative_density, target.tolerance, trials_text(done)));
  }
  return next;
}

}  // namespace dem
