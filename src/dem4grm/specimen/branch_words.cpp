// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/branch_words.hpp"

#include <fmt/format.h>

namespace dem {

std::vector<double> rest_stresses(const SpecimenOrder& order, double ratio) {
  std::vector<double> path;
  for (const double stress : order.specimen.load_steps) {
    if (stress < order.normal_stress) path.push_back(ratio * stress);
  }
  path.push_back(ratio * order.normal_stress);
  return path;
}

std::string branch_state_name(double friction, const std::vector<double>& path, std::size_t station) {
  // All digits: states of two values must never share a name.
  std::string name = fmt::format("friction-{}-stress", friction);
  for (std::size_t k = 0; k <= station; ++k) name += fmt::format("-{}", path[k]);
  return name + "-Pa";
}

std::string branch_label(std::size_t number, double friction) {
  const std::string which = number == 0 ? "e_min" : number == 1 ? "e_max" : fmt::format("trial {}", number - 1);
  return fmt::format("{} (friction {:g})", which, friction);
}

std::string branch_note(const SpecimenReport& report, bool is_fetched) {
  const Branch& b = report.branches.back();
  const std::size_t n = report.branches.size();
  std::string text =
      fmt::format("friction {:.4f} gives void ratio {:.4f} at {:.1f} kPa", b.friction, b.void_ratio, b.stress * 1e-3);
  if (n <= 2) text += n == 1 ? " (e_min)" : " (e_max)";
  if (n > 2) text += fmt::format(", relative density {:.3f}", *report.relative_density_reached());
  return text + (is_fetched ? ", kept from before" : fmt::format(", {} steps", b.steps));
}

}  // namespace dem
