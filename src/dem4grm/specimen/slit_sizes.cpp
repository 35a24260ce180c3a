// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/slit_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "dem4grm/grains/clump_template.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/specimen/grading.hpp"

namespace dem {
namespace {

std::string length_words(double value) { return fmt::format("{:.4g} mm", value * 1e3); }

/// Pebbles of a shape with the sieve size 1; none for a name that nobody knows.
std::vector<Pebble> pebbles_of(const SpecimenSettings& settings, const std::string& name) {
  for (const ClumpShape& own : settings.clump_templates) {
    if (own.name == name) return make_clump_template(own.name, own.pebbles).pebbles;
  }
  const ClumpTemplate* shape = find_clump_template(name);
  return shape != nullptr ? shape->pebbles : std::vector<Pebble>();
}

}  // namespace

SlitSizes slit_sizes(const SpecimenSettings& settings, double ball_density, double solid_density) {
  constexpr double none = std::numeric_limits<double>::infinity();
  SlitSizes out{none, none, {}};
  const auto take = [&](double passes, double enters, const std::string& grain) {
    if (passes < out.passes) {
      out.passes = passes;
      out.grain = grain;
    }
    out.enters = std::min(out.enters, enters);
  };
  if (settings.rubber_content < 1.0 && !settings.gravel_grading.empty()) {
    const double size = smallest_grain(settings.gravel_grading);
    for (const std::string& name : settings.clump_shapes) {
      const std::vector<Pebble> pebbles = pebbles_of(settings, name);
      if (pebbles.empty()) continue;
      const auto [thin, thick] = std::minmax_element(
          pebbles.begin(), pebbles.end(), [](const Pebble& a, const Pebble& b) { return a.radius < b.radius; });
      const double thickest = 2.0 * thick->radius * size;
      take(thickest, 2.0 * thin->radius * size,
           fmt::format("gravel of {} and shape {}, whose thickest pebble is {}", length_words(size), name,
                       length_words(thickest)));
    }
  }
  if (settings.rubber_content > 0.0 && !settings.rubber_grading.empty()) {
    const double size = smallest_grain(settings.rubber_grading);
    take(size, 2.0 * rubber_ball_radius(size, ball_density, solid_density),
         fmt::format("rubber of {}", length_words(size)));
  }
  return out;
}

}  // namespace dem
