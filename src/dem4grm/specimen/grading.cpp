// SPDX-License-Identifier: BSD-3-Clause
// Reading a grading curve: sizes at a share of mass, shares at a size, and the usual key figures.
#include "dem4grm/specimen/grading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace dem {

std::vector<std::string> grading_problems(const Grading& grading) {
  std::vector<std::string> problems;
  if (grading.size() < 2) {
    problems.push_back(fmt::format("a grading needs at least two rows, this one has {}", grading.size()));
    return problems;
  }
  for (std::size_t row = 0; row < grading.size(); ++row) {
    const GradingPoint& point = grading[row];
    if (!(std::isfinite(point.size) && point.size > 0.0)) {
      problems.push_back(fmt::format("row {}: size {} m is not positive", row + 1, point.size));
    }
    if (!(point.passing >= 0.0 && point.passing <= 1.0)) {
      problems.push_back(fmt::format("row {}: share passing {} is outside 0 to 1", row + 1, point.passing));
    }
    if (row == 0) continue;
    if (point.size <= grading[row - 1].size) {
      problems.push_back(fmt::format("row {}: sizes must rise from row to row", row + 1));
    }
    if (point.passing < grading[row - 1].passing) {
      problems.push_back(fmt::format("row {}: the share passing must not fall from row to row", row + 1));
    }
  }
  if (grading.front().passing > 0.0) problems.emplace_back("the first row must have 0 % passing");
  if (grading.back().passing < 1.0) problems.emplace_back("the last row must have 100 % passing");
  return problems;
}

double size_at_passing(const Grading& grading, double fraction) {
  if (fraction <= 0.0) return smallest_size(grading);
  const auto above = std::lower_bound(grading.begin(), grading.end(), fraction,
                                      [](const GradingPoint& point, double f) { return point.passing < f; });
  if (above == grading.begin()) return grading.front().size;
  if (above == grading.end()) return grading.back().size;
  const GradingPoint &low = *(above - 1), &high = *above;
  return low.size + (high.size - low.size) * ((fraction - low.passing) / (high.passing - low.passing));
}

double passing_at_size(const Grading& grading, double size) {
  const auto above = std::upper_bound(grading.begin(), grading.end(), size,
                                      [](double s, const GradingPoint& point) { return s < point.size; });
  if (above == grading.begin()) return 0.0;
  if (above == grading.end()) return 1.0;
  const GradingPoint &low = *(above - 1), &high = *above;
  return low.passing + (high.passing - low.passing) * ((size - low.size) / (high.size - low.size));
}

double smallest_size(const Grading& grading) {
  // The last of the leading rows that nothing passes.
  std::size_t row = 0;
  while (row + 1 < grading.size() && grading[row + 1].passing <= 0.0) ++row;
  return grading[row].size;
}

double largest_size(const Grading& grading) { return size_at_passing(grading, 1.0); }

double d10(const Grading& grading) { return size_at_passing(grading, 0.10); }
double d50(const Grading& grading) { return size_at_passing(grading, 0.50); }
double d60(const Grading& grading) { return size_at_passing(grading, 0.60); }

double uniformity_coefficient(const Grading& grading) { return d60(grading) / d10(grading); }

double largest_grain(const Grading& grading) {
  for (const GradingPoint& point : grading) {
    if (point.passing >= 1.0) return point.size;
  }
  return grading.empty() ? 0.0 : grading.back().size;
}

double smallest_grain(const Grading& grading) {
  double size = 0.0;
  for (const GradingPoint& point : grading) {
    if (point.passing <= 0.0) size = point.size;
  }
  return size;
}

}  // namespace dem
