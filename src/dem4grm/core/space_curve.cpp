// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/core/space_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace dem {
namespace {

constexpr double k_cells_per_axis = 2097151.0;  // 21 bits

/// The lowest 21 bits of v with two empty bits between each.
std::uint64_t spread_bits(std::uint64_t v) {
  v = (v | v << 32U) & 0x001f00000000ffffULL;
  v = (v | v << 16U) & 0x001f0000ff0000ffULL;
  v = (v | v << 8U) & 0x100f00f00f00f00fULL;
  v = (v | v << 4U) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2U) & 0x1249249249249249ULL;
}

}  // namespace

std::vector<int> order_along_curve(std::span<const Vec3> points) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  if (points.size() < 2) return order;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 span = high - low;
  const double widest = std::max({span.x, span.y, span.z});
  if (!(widest > 0.0)) return order;
  // A flat or thin cloud still gets cells of finite size.
  const double least = 1e-3 * widest;
  const double volume = std::max(span.x, least) * std::max(span.y, least) * std::max(span.z, least);
  const double cell = std::max(std::cbrt(volume / static_cast<double>(points.size())), widest / k_cells_per_axis);
  std::vector<std::uint64_t> key(points.size());
  const auto along = [&](double v, double from) { return spread_bits(static_cast<std::uint64_t>((v - from) / cell)); };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3& p = points[k];
    key[k] = along(p.x, low.x) | along(p.y, low.y) << 1U | along(p.z, low.z) << 2U;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return key[static_cast<std::size_t>(a)] < key[static_cast<std::size_t>(b)]; });
  return order;
}

}  // namespace dem
