// SPDX-License-Identifier: BSD-3-Clause
// Void ratios that are used when the case does not name any.
#include "dem4grm/specimen/void_ratio_defaults.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

struct LaboratoryPoint {
  double rubber_content = 0.0, void_ratio = 0.0;
};

constexpr std::array<LaboratoryPoint, 5> k_laboratory{
    {{0.0, 0.63}, {0.10, 0.65}, {0.25, 0.70}, {0.40, 0.74}, {1.0, 1.01}}};
constexpr double k_expected_gravel = 0.534;
constexpr double k_expected_rubber = 0.782;

void check_rubber_content(double rubber_content) {
  if (!(rubber_content >= 0.0 && rubber_content <= 1.0)) {
    throw InputError(fmt::format("rubber content {} is outside 0 to 1 (0 to 100 %)", rubber_content));
  }
}

}  // namespace

double laboratory_void_ratio(double rubber_content) {
  check_rubber_content(rubber_content);
  std::size_t row = 1;
  while (row + 1 < k_laboratory.size() && rubber_content > k_laboratory[row].rubber_content) ++row;
  const LaboratoryPoint &low = k_laboratory[row - 1], &high = k_laboratory[row];
  const double share = (rubber_content - low.rubber_content) / (high.rubber_content - low.rubber_content);
  return low.void_ratio + share * (high.void_ratio - low.void_ratio);
}

double expected_void_ratio(double rubber_content) {
  check_rubber_content(rubber_content);
  return k_expected_gravel + rubber_content * (k_expected_rubber - k_expected_gravel);
}

}  // namespace dem
