// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/solid_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem4grm/core/error.hpp"
#include "dem4grm/specimen/solid_columns.hpp"

namespace dem {
namespace {

constexpr double k_cell_edge = 4.0;          // of the mean grain size
constexpr double k_layer = 1.0 / 8;          // of the mean grain size
constexpr int k_most_layers = 20;            // 2.5 mean grain sizes
constexpr double k_near = 0.5, k_far = 1.5;  // of the mean grain size

ColumnAxis axis_of(double from, double to, double mean_size) {
  const int cells = std::max(1, static_cast<int>((to - from) / (k_cell_edge * mean_size) + 1e-6));
  return {from, to, cells, k_column_spacing * mean_size};
}

/// Takes pieces of columns and adds them up in cells, zones and layers.
class Collector {
 public:
  Collector(const Bounds& room, double mean_size)
      : x_(axis_of(room.low.x, room.high.x, mean_size)),
        y_(axis_of(room.low.y, room.high.y, mean_size)),
        low_(room.low.z),
        high_(room.high.z),
        mean_size_(mean_size),
        layer_(k_layer * mean_size) {
    const double height = high_ - low_;
    const int nz = std::max(1, static_cast<int>(height / (k_cell_edge * mean_size) + 1e-6));
    out_.counts = {x_.cells, y_.cells, nz};
    cell_height_ = height / nz;
    const double cell_volume = x_.length / x_.cells * (y_.length / y_.cells) * cell_height_;
    out_.cells.assign(static_cast<std::size_t>(x_.cells * y_.cells * nz), {cell_volume, 0.0, 0.0});
    out_.plate_layers.resize(layers_within(0.5 * height));
    out_.side_layers.resize(layers_within(0.5 * std::min(x_.length, y_.length)));
    measure_room();
  }

  [[nodiscard]] const ColumnAxis& x() const { return x_; }
  [[nodiscard]] const ColumnAxis& y() const { return y_; }

  /// The solid from z = a to z = b of column (i, j); `fill` multiplies its volume.
  void add(int i, int j, double a, double b, double fill, double Cell::*material) {
    a = std::max(a, low_);
    b = std::min(b, high_);
    if (!(b > a)) return;
    const double area = x_.step * y_.step * fill;
    const int nz = out_.counts[2];
    const int first = std::clamp(static_cast<int>((a - low_) / cell_height_), 0, nz - 1);
    const int last = std::clamp(static_cast<int>((b - low_) / cell_height_), 0, nz - 1);
    for (int k = first; k <= last; ++k) {
      const auto cell = static_cast<std::size_t>((k * y_.cells + y_.cell_of(j)) * x_.cells + x_.cell_of(i));
      out_.cells[cell].*material += area * shared(a, b, low_ + k * cell_height_, low_ + (k + 1) * cell_height_);
    }
    add_to_zones(std::min(x_.to_wall(i), y_.to_wall(j)), a, b, area, &SolidZone::solid);
  }

  SolidDistribution take() { return std::move(out_); }

 private:
  [[nodiscard]] std::size_t layers_within(double depth) const {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(depth / layer_ + 1e-6), 0, k_most_layers));
  }

  /// Volumes of zones and layers: what columns full of solid would bring.
  void measure_room() {
    for (int i = 0; i < x_.columns; ++i) {
      for (int j = 0; j < y_.columns; ++j) {
        add_to_zones(std::min(x_.to_wall(i), y_.to_wall(j)), low_, high_, x_.step * y_.step, &SolidZone::volume);
      }
    }
  }

  void add_to_zones(double to_side, double a, double b, double area, double SolidZone::*part) {
    const double near = k_near * mean_size_, far = k_far * mean_size_;
    const double deep = area * shared(a, b, low_ + far, high_ - far);
    if (to_side >= far) {
      out_.inside.*part += deep;
      out_.at_plates.*part += area * (shared(a, b, low_, low_ + near) + shared(a, b, high_ - near, high_));
    } else if (to_side < near) {
      out_.at_sides.*part += deep;
    }
    const auto side_layer = static_cast<std::size_t>(to_side / layer_);
    if (side_layer < out_.side_layers.size()) out_.side_layers[side_layer].*part += area * (b - a);
    add_to_plate_layers(a - low_, b - low_, area, part);
    add_to_plate_layers(high_ - b, high_ - a, area, part);
  }

  /// a, b: distances from one plate.
  void add_to_plate_layers(double a, double b, double area, double SolidZone::*part) {
    const auto n = static_cast<int>(out_.plate_layers.size());
    for (int k = static_cast<int>(a / layer_); k < n && k * layer_ < b; ++k) {
      out_.plate_layers[static_cast<std::size_t>(k)].*part += area * shared(a, b, k * layer_, (k + 1) * layer_);
    }
  }

  ColumnAxis x_, y_;
  double low_, high_, cell_height_ = 0.0, mean_size_, layer_;
  SolidDistribution out_;
};

}  // namespace

SolidDistribution solid_distribution(const Packing& packing, const Bounds& room, double mean_size, double rubber_fill) {
  const Vec3 size = room.high - room.low;
  if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0 && mean_size > 0.0)) {
    throw InputError("the distribution of the solid needs a room and a grain size that are positive");
  }
  Collector collector(room, mean_size);
  add_solid(packing, rubber_fill, collector);
  return collector.take();
}

}  // namespace dem
