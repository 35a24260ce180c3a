// SPDX-License-Identifier: BSD-3-Clause
// Numbering points so that neighbours in space are neighbours in memory.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/core/vec3.hpp"

namespace dem {

/// Points in the order in which a Z-shaped curve (Morton 1966) visits their cells: eight consecutive cells are a cube
/// of 2 x 2 x 2. Cells have the size that gives one point each on average. Returns [n] the number of the point that
/// comes first, second, ...; points of one cell keep their order.
std::vector<int> order_along_curve(std::span<const Vec3> points);

/// Sorts items along the curve through their positions. position_of: item -> Vec3. Returns [n] the old place of each.
template <class Item, class Position>
std::vector<int> sort_along_curve(std::vector<Item>& items, const Position& position_of) {
  std::vector<Vec3> points;
  points.reserve(items.size());
  for (const Item& item : items) points.push_back(position_of(item));
  std::vector<int> order = order_along_curve(points);
  const std::vector<Item> old = items;
  for (std::size_t k = 0; k < old.size(); ++k) items[k] = old[static_cast<std::size_t>(order[k])];
  return order;
}

}  // namespace dem
