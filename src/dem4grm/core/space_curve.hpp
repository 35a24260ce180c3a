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

}  // namespace dem
