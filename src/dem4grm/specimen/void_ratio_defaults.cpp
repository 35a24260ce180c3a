// SPDX-License-Identifier: BSD-3-Clause
// Void ratios that are used when the case does not name any.
#include "dem4grm/specimen/void_ratio_defaults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

struct LaboratoryRange {
  double rubber_content = 0.0, loosest = 0.0, densest = 0.0;
};

constexpr std::array<LaboratoryRange, 5> k_laboratory{
    {{0.0, 0.725, 0.545}, {0.10, 0.778, 0.561}, {0.25, 0.818, 0.577}, {0.40, 0.912, 0.590}, {1.0, 1.272, 0.787}}};
constexpr double k_least_of_spheres = 0.9;
constexpr double k_expected_gravel = 0.534;
constexpr double k_expected_rubber = 0.782;

void check_rubber_content(double rubber_content) {
  if (!(rubber_content >= 0.0 && rubber_content <= 1.0)) {
    throw InputError(fmt::format("rubber content {} is outside 0 to 1 (0 to 100 %)", rubber_content));
  }
}

}  // namespace

double laboratory_void_ratio(double rubber_content, double relative_density) {
  check_rubber_content(rubber_content);
  std::size_t row = 1;
  while (row + 1 < k_laboratory.size() && rubber_content > k_laboratory[row].rubber_content) ++row;
  const LaboratoryRange &low = k_laboratory[row - 1], &high = k_laboratory[row];
  const double share = (rubber_content - low.rubber_content) / (high.rubber_content - low.rubber_content);
  const double loosest = std::lerp(low.loosest, high.loosest, share);
  return loosest - relative_density * (loosest - std::lerp(low.densest, high.densest, share));
}

double generation_void_ratio(const SpecimenSettings& settings) {
  if (settings.generation_void_ratio) return *settings.generation_void_ratio;
  const double density = settings.generation_relative_density;
  const double laboratory = laboratory_void_ratio(settings.rubber_content, density);
  const auto is_sphere = [](const std::string& shape) { return shape == "sphere"; };
  if (!std::all_of(settings.clump_shapes.begin(), settings.clump_shapes.end(), is_sphere)) return laboratory;
  const double lacking = std::max(0.0, k_least_of_spheres - laboratory_void_ratio(0.0, density));
  return laboratory + (1.0 - settings.rubber_content) * lacking;
}

double expected_void_ratio(double rubber_content) {
  check_rubber_content(rubber_content);
  return k_expected_gravel + rubber_content * (k_expected_rubber - k_expected_gravel);
}

}  // namespace dem
