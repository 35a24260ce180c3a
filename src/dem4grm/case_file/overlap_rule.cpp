// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/overlap_rule.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace dem {
namespace {

// Gravel with 1.3 came to rest with a largest overlap of 1.05 of the radius, with 2.1 the watchdog stopped it at 1.27.
constexpr double k_largest = 1.5;
constexpr double k_usual = 0.15;  // rubber under 100 kPa has 0.07

}  // namespace

double foreseen_overlap(double normal_stress, double shear_modulus, double poisson_ratio) {
  const double effective = shear_modulus / (1.0 - poisson_ratio);
  return std::pow(3.0 * std::numbers::sqrt2 * normal_stress / effective, 2.0 / 3.0);
}

void check_overlap(const DirectShearCase& test, Rules& rules) {
  const auto check = [&](const std::string& section, const MaterialSettings& material, bool is_present) {
    const std::string modulus = section + ".shear_modulus", ratio = section + ".poisson_ratio";
    if (!is_present || !rules.given.are_good({modulus, ratio, "shear.normal_stress", "specimen.rubber_content"}))
      return;
    const double overlap = foreseen_overlap(test.shear.normal_stress, material.shear_modulus, material.poisson_ratio);
    if (overlap <= k_usual) return;
    const Place place = rules.given.place_of({modulus, "shear.normal_stress"});
    const auto stress = [](double value) { return format_quantity(value, Dimension::stress); };
    const std::string text =
        fmt::format("{} = {} under a normal stress of {} makes balls overlap by about {:.2g} of their radius", modulus,
                    stress(material.shear_modulus), stress(test.shear.normal_stress), overlap);
    // Overlap goes as modulus to the power of -2/3.
    const double least = material.shear_modulus * std::pow(overlap / k_usual, 1.5);
    const std::string hint =
        fmt::format("Hertz's law is one of small overlaps; {:.2g} MPa would give {}", least * 1e-6, k_usual);
    if (overlap > k_largest) {
      rules.problems.error(place, text + ": grains would pass through each other", hint);
    } else {
      rules.problems.warning(place, text, hint);
    }
  };
  check("gravel", test.gravel, has_gravel(test.specimen));
  check("rubber", test.rubber, has_rubber(test.specimen));
}

}  // namespace dem
