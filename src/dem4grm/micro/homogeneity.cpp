// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/homogeneity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/search/candidates.hpp"

namespace dem {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
// Exceeded by 1.1 % = exp(-4.5): chi-squared of 5 degrees above 14.85, of 2 degrees above 9.
constexpr double k_deviator_noise = 1.723;  // sqrt(14.85 / 5)

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return k_unknown;
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, square = 0.0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean) / (n - 1.0);
  return std::sqrt(square);
}

double void_ratio_of(const SolidZone& zone) {
  return zone.volume > 0.0 && zone.solid > 0.0 ? zone.void_ratio() : k_unknown;
}

/// Layers from half a mean grain size on.
double layering_of(std::span<const SolidZone> layers) {
  constexpr std::size_t k_first = 4;  // of layers of an eighth
  SolidZone all;
  for (std::size_t k = k_first; k < layers.size(); ++k) {
    all.volume += layers[k].volume;
    all.solid += layers[k].solid;
  }
  if (!(all.solid > 0.0)) return k_unknown;
  double square = 0.0;
  for (std::size_t k = k_first; k < layers.size(); ++k) {
    if (layers[k].volume == 0.0) continue;
    const double relative = layers[k].solid / layers[k].volume / (all.solid / all.volume) - 1.0;
    square += relative * relative * layers[k].volume / all.volume;
  }
  return std::sqrt(square);
}

void take_cells(const SolidDistribution& solid, Homogeneity& out) {
  std::vector<double> void_ratio, content;
  for (const Cell& cell : solid.cells) {
    const double all = cell.gravel + cell.rubber;
    if (all <= 0.0) continue;
    void_ratio.push_back(cell.volume / all - 1.0);
    content.push_back(cell.rubber / all);
  }
  out.cells = static_cast<int>(solid.cells.size());
  out.void_ratio_scatter = standard_deviation(void_ratio);
  out.rubber_content_scatter = standard_deviation(content);
}

}  // namespace

FabricMeasure measure_fabric(std::span<const Vec3> normals) {
  if (normals.empty()) return {};
  return {static_cast<int>(normals.size()), deviator_size(fabric_tensor(normals)),
          k_deviator_noise / std::sqrt(static_cast<double>(normals.size()))};
}

OverlapMeasure measure_overlaps(const Packing& packing) {
  std::array<std::vector<double>, 3> at;
  for (const Vec3& p : packing.position) {
    at[0].push_back(p.x);
    at[1].push_back(p.y);
    at[2].push_back(p.z);
  }
  OverlapMeasure out;
  for (const PairKey key : find_pairs({at[0], at[1], at[2], packing.radius, packing.body}, 0.0)) {
    const auto i = static_cast<std::size_t>(first_of(key)), j = static_cast<std::size_t>(second_of(key));
    const double a = packing.radius[i], b = packing.radius[j];
    const double distance = norm(packing.position[j] - packing.position[i]);
    out.largest = std::max(out.largest, (a + b - distance) / std::min(a, b));
    if (distance < std::max(a, b)) ++out.caught;
  }
  return out;
}

Homogeneity measure_homogeneity(const Packing& packing, std::span<const Vec3> normals, const Bounds& room,
                                double mean_size, double rubber_fill) {
  const SolidDistribution solid = solid_distribution(packing, room, mean_size, rubber_fill);
  Homogeneity out;
  take_cells(solid, out);
  out.void_ratio_inside = void_ratio_of(solid.inside);
  out.void_ratio_at_plates = void_ratio_of(solid.at_plates);
  out.void_ratio_at_sides = void_ratio_of(solid.at_sides);
  out.layering_at_plates = layering_of(solid.plate_layers);
  out.layering_at_sides = layering_of(solid.side_layers);
  out.fabric = measure_fabric(normals);
  out.overlap = measure_overlaps(packing);
  return out;
}

}  // namespace dem
