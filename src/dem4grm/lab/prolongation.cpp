// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/prolongation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/lab/direct_shear.hpp"

namespace dem {
namespace {

bool is_beginning_of(const std::vector<double>& some, const std::vector<double>& all) {
  constexpr double k_same = 1e-12;  // m
  return some.size() <= all.size() && std::equal(some.begin(), some.end(), all.begin(),
                                                 [](double a, double b) { return std::fabs(a - b) < k_same; });
}

}  // namespace

std::string prolongation_problem(const DirectShearCase& shorter, const DirectShearCase& longer) {
  const double end = shorter.shear.displacement;
  const std::string at = format_quantity(end, Dimension::length);
  if (longer.shear.displacement <= end) {
    return fmt::format("shear.displacement = {} is not beyond the {} that it has reached",
                       format_quantity(longer.shear.displacement, Dimension::length), at);
  }
  const double rows = end / shorter.recording.interval;
  const char* broken = nullptr;
  if (std::fabs(rows - std::nearbyint(rows)) > 1e-6) {
    broken = "recording.interval";
  } else if (!is_beginning_of(state_displacements(shorter), state_displacements(longer))) {
    broken = "recording.frame_interval";
  } else if (!is_beginning_of(micro_displacements(shorter), micro_displacements(longer))) {
    broken = "recording.micro_interval";
  }
  if (broken == nullptr) return {};
  return fmt::format("it ended at {}, which is no multiple of {}, so its record would not be that of one longer test",
                     at, broken);
}

}  // namespace dem
