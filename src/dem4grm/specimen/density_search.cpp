// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/density_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr double k_bend = 0.1;              // friction at which about half of the way is done
constexpr double k_trials_per_unit = 1e4;   // trials are round numbers, which can be typed into a case
constexpr double k_spacing = 0.005;         // of trials over their friction, and at least
constexpr double k_least_spacing = 0.0003;  // this: enough for another specimen

double bent(double friction) { return friction / (friction + k_bend); }
double unbent(double x) { return k_bend * x / (1.0 - x); }
double rounded(double friction) { return std::floor(friction * k_trials_per_unit + 0.5) / k_trials_per_unit; }

/// A specimen on the bent axis and how much too dense it is.
struct Point {
  double x = 0.0, miss = 0.0;
};

std::vector<Point> points_of(std::span<const Branch> done, double target) {
  std::vector<Point> points;
  for (const Branch& b : done) {
    points.push_back(
        {bent(b.friction), relative_density(done[0].void_ratio, done[1].void_ratio, b.void_ratio) - target});
  }
  return points;
}

/// Where the curve ought to cross zero: between the loosest specimen that is too dense and the densest that is too loose,
/// never in the outer quarters. Scatter may have put them the wrong way round; then half-way.
double crossing(std::span<const Point> points) {
  Point low = points[0], high = points[1];
  for (const Point& p : points) {
    if (p.miss > 0.0 && p.x > low.x) low = p;
    if (p.miss <= 0.0 && p.x < high.x) high = p;
  }
  const double share = low.x < high.x ? low.miss / (low.miss - high.miss) : 0.5;
  return low.x + (high.x - low.x) * std::clamp(share, 0.25, 0.75);
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
  if (done.size() - 2 < k_most_trials) next = free_friction(done, unbent(crossing(points)));
  if (!next) {
    throw PhysicsError(fmt::format(
        "no preparation friction gave a relative density of {} within {}; raise specimen.relative_density_tolerance "
        "(with --store these specimens are not made again), or choose another seed or a larger specimen. Tried:{}",
        target.relative_density, target.tolerance, trials_text(done)));
  }
  return next;
}

}  // namespace dem
