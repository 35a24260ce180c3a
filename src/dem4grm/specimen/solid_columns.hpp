// SPDX-License-Identifier: BSD-3-Clause
// The solid of a packing in vertical columns: the method of solid_distribution.hpp, which says how exact it is, for whoever
// adds the pieces up.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "dem4grm/specimen/packing.hpp"
#include "dem4grm/specimen/solid_distribution.hpp"

namespace dem {

inline constexpr double k_column_spacing = 1.0 / 16;  ///< of the mean grain size

/// Columns along one horizontal axis; every cell has the same number of them.
struct ColumnAxis {
  double low = 0.0, length = 0.0, step = 0.0;  ///< m
  int cells = 1, columns = 1;

  /// Columns at most `spacing` apart.
  ColumnAxis(double from, double to, int n_cells, double spacing) : low(from), length(to - from), cells(n_cells) {
    columns = cells * static_cast<int>(std::ceil(length / cells / spacing));
    step = length / columns;
  }
  [[nodiscard]] double middle(int column) const { return low + (column + 0.5) * step; }
  [[nodiscard]] int cell_of(int column) const { return column / (columns / cells); }
  /// Distance of a column to the nearer end.
  [[nodiscard]] double to_wall(int column) const { return (std::min(column, columns - 1 - column) + 0.5) * step; }
  /// First column whose middle is not below the value, inside [0, columns].
  [[nodiscard]] int first_from(double value) const {
    const double k = std::ceil((value - low) / step - 0.5);
    return static_cast<int>(std::clamp(k, 0.0, static_cast<double>(columns)));
  }
};

/// Length of what two intervals share.
inline double shared(double a, double b, double low, double high) {
  return std::max(0.0, std::min(b, high) - std::max(a, low));
}

/// Takes the solid of grains as pieces of columns: x() and y() are its axes, add(i, j, a, b, fill, material) the solid from
/// z = a to z = b of column (i, j), whose volume `fill` multiplies.
template <class Collector>
class ColumnFiller {
 public:
  explicit ColumnFiller(Collector& to) : to_(to) {}

  /// One clump: in every column the union of the intervals of its pebbles.
  void add_clump(std::span<const Pebble> pebbles) {
    const Patch patch = patch_under(pebbles);
    for (int i = patch.x_first; i < patch.x_last; ++i) {
      for (int j = patch.y_first; j < patch.y_last; ++j) {
        intervals_.clear();
        for (const Pebble& pebble : pebbles) {
          const double half = half_chord(i, j, pebble);
          if (half > 0.0) intervals_.emplace_back(pebble.position.z - half, pebble.position.z + half);
        }
        if (!intervals_.empty()) add_union(i, j);
      }
    }
  }

  void add_rubber_ball(const Pebble& ball, double rubber_fill) {
    const Patch patch = patch_under({&ball, 1});
    for (int i = patch.x_first; i < patch.x_last; ++i) {
      for (int j = patch.y_first; j < patch.y_last; ++j) {
        const double half = half_chord(i, j, ball);
        if (half > 0.0) to_.add(i, j, ball.position.z - half, ball.position.z + half, rubber_fill, &Cell::rubber);
      }
    }
  }

 private:
  /// Columns [first, last) along both axes under the balls.
  struct Patch {
    int x_first, x_last, y_first, y_last;
  };

  Patch patch_under(std::span<const Pebble> balls) const {
    Vec3 low = balls.front().position, high = low;
    for (const Pebble& ball : balls) {
      low = {std::min(low.x, ball.position.x - ball.radius), std::min(low.y, ball.position.y - ball.radius), 0.0};
      high = {std::max(high.x, ball.position.x + ball.radius), std::max(high.y, ball.position.y + ball.radius), 0.0};
    }
    return {to_.x().first_from(low.x), to_.x().first_from(high.x), to_.y().first_from(low.y),
            to_.y().first_from(high.y)};
  }

  /// Half of the chord of a sphere in the column (i, j); 0 when the column misses it.
  double half_chord(int i, int j, const Pebble& ball) const {
    const double dx = to_.x().middle(i) - ball.position.x, dy = to_.y().middle(j) - ball.position.y;
    const double square = ball.radius * ball.radius - dx * dx - dy * dy;
    return square > 0.0 ? std::sqrt(square) : 0.0;
  }

  void add_union(int i, int j) {
    std::sort(intervals_.begin(), intervals_.end());
    Interval open = intervals_.front();
    for (const Interval& next : intervals_) {
      if (next.first > open.second) {
        to_.add(i, j, open.first, open.second, 1.0, &Cell::gravel);
        open = next;
      }
      open.second = std::max(open.second, next.second);
    }
    to_.add(i, j, open.first, open.second, 1.0, &Cell::gravel);
  }

  using Interval = std::pair<double, double>;
  Collector& to_;
  std::vector<Interval> intervals_;
};

/// All grains of a packing; rubber_fill: solid volume of a rubber grain over the volume of its balls.
template <class Collector>
void add_solid(const Packing& packing, double rubber_fill, Collector& to) {
  ColumnFiller<Collector> filler(to);
  for (int k = 0; k < packing.n_rubber_balls(); ++k) {
    const auto ball = static_cast<std::size_t>(k);
    filler.add_rubber_ball({packing.position[ball], packing.radius[ball]}, rubber_fill);
  }
  for_each_clump(packing, [&](std::span<const Pebble> pebbles) { filler.add_clump(pebbles); });
}

}  // namespace dem
