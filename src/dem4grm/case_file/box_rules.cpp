// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/box_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/specimen/grading.hpp"
#include "dem4grm/specimen/slit_sizes.hpp"

namespace dem {
namespace {

/// The grains that the box must hold. Zero when there is none or when its grading is wrong.
struct GrainSizes {
  double largest = 0.0;
};

GrainSizes grain_sizes(const SpecimenSettings& specimen, const GivenKeys& given) {
  GrainSizes sizes;
  const auto take = [&](std::string_view key, const Grading& grading, bool is_present) {
    if (!is_present || grading.empty() || !given.are_good({key, "specimen.rubber_content"})) return;
    sizes.largest = std::max(sizes.largest, largest_grain(grading));
  };
  take("specimen.gravel_grading", specimen.gravel_grading, has_gravel(specimen));
  take("specimen.rubber_grading", specimen.rubber_grading, has_rubber(specimen));
  return sizes;
}

/// Each side of the box against the largest grain. ASTM D3080 asks for a width of 10 and a height of 6 grains; the
/// published box has 6.2 in height. Below 5 the walls decide the result, below 2 there is nothing to shear.
void check_box_against_grains(const DirectShearCase& test, Rules& rules) {
  const GrainSizes grains = grain_sizes(test.specimen, rules.given);
  if (grains.largest == 0.0) return;
  const auto check_side = [&](std::string_view key, double side, double usual) {
    if (!rules.given.are_good({key})) return;
    const Place place = rules.given.place_of({key, "specimen.gravel_grading", "specimen.rubber_grading"});
    const double least = 2.0 * grains.largest;
    if (side < least * (1.0 - 1e-9)) {
      rules.problems.error(place, fmt::format("{} = {} is less than 2 of the largest grains ({}): at least {}", key,
                                              length_text(side), length_text(grains.largest),
                                              format_decimal(std::ceil(least * 1e4 - 1e-6) / 10.0) + " mm"));
    } else if (side < usual * grains.largest * (1.0 - 1e-9)) {
      rules.problems.warning(place, fmt::format("{} = {} is less than {} of the largest grains ({}), the least that "
                                                "ASTM D3080 asks for{}",
                                                key, length_text(side), usual, length_text(grains.largest),
                                                side < 5.0 * grains.largest ? "; the walls decide the result" : ""));
    }
  };
  check_side("box.length", test.box.length, 10.0);
  check_side("box.width", test.box.width, 10.0);
  check_side("box.height", test.box.height, 6.0);
}

void check_gap(const DirectShearCase& test, Rules& rules) {
  const auto& [given, problems] = rules;
  if (test.box.gap == 0.0 ||
      !given.are_good({"box.gap", "specimen.rubber_content", "specimen.gravel_grading", "specimen.rubber_grading",
                       "specimen.clump_shapes", "specimen.clump_templates"})) {
    return;
  }
  const SlitSizes sizes = slit_sizes(test.specimen, test.rubber.density, test.rubber_solid_density);
  const Place place = given.place_of({"box.gap"});
  if (test.box.gap >= sizes.passes) {
    problems.error(place,
                   fmt::format("box.gap = {} lets grains out of the box: {}", length_text(test.box.gap), sizes.grain),
                   fmt::format("a gap below {:.2f} mm keeps every grain in", std::floor(sizes.passes * 1e5) / 100.0));
  } else if (test.box.gap >= sizes.enters) {
    problems.warning(place,
                     fmt::format("box.gap = {} lets parts of grains in, which may wedge: the smallest pebbles or "
                                 "balls are {:.4g} mm thick",
                                 length_text(test.box.gap), sizes.enters * 1e3));
  }
}

void check_box(const DirectShearCase& test, Rules& rules) {
  const auto& [given, problems] = rules;
  const BoxSettings& box = test.box;
  if (given.are_good({"box.upper_height", "box.height"}) && !(box.upper_height > box.height / 2)) {
    problems.error(given.place_of({"box.upper_height", "box.height"}),
                   fmt::format("box.upper_height = {} must be greater than half of box.height ({})",
                               length_text(box.upper_height), length_text(box.height / 2)),
                   "the loose fill stands higher than the specimen");
  }
  const double displacement = test.shear.displacement;
  if (given.are_good({"shear.displacement", "box.wing"}) && displacement > box.wing) {
    problems.error(given.place_of({"shear.displacement", "box.wing"}),
                   fmt::format("shear.displacement = {} is longer than box.wing = {}: grains would fall out",
                               length_text(displacement), length_text(box.wing)));
  }
  if (given.are_good({"shear.displacement", "box.length"}) && displacement > box.length / 2) {
    problems.error(given.place_of({"shear.displacement", "box.length"}),
                   fmt::format("shear.displacement = {} is more than half of box.length = {}",
                               length_text(displacement), length_text(box.length)));
  }
}

/// Ribs of the plates. So many may be near one ball that the engine's list of them is not exceeded.
void check_ribs(const DirectShearCase& test, Rules& rules) {
  const auto& [given, problems] = rules;
  const BoxSettings& box = test.box;
  if (!given.are_good({"walls.plate_roughness", "walls.plate_roughness_pitch", "box.length"})) return;
  if (box.plate_roughness == 0.0) {
    if (box.plate_roughness_pitch > 0.0) {
      problems.warning(
          given.place_of({"walls.plate_roughness_pitch"}),
          "walls.plate_roughness_pitch has no effect without walls.plate_roughness: the plates are smooth");
    }
    return;
  }
  const double pitch = box.plate_roughness_pitch > 0.0 ? box.plate_roughness_pitch : 2.0 * box.plate_roughness;
  const Place place = given.place_of({"walls.plate_roughness_pitch", "walls.plate_roughness"});
  if (pitch > 0.5 * box.length) {
    problems.error(place, fmt::format("ribs {} apart do not fit a plate of {}: at least two", length_text(pitch),
                                      length_text(box.length)));
  }
  const double largest = grain_sizes(test.specimen, given).largest;
  if (pitch < 0.25 * largest * (1.0 - 1e-9)) {
    problems.error(place,
                   fmt::format("ribs {} apart are finer than a fourth of the largest grains ({}): at least {:.2f} mm",
                               length_text(pitch), length_text(largest), std::ceil(0.25 * largest * 1e5) / 100.0),
                   "walls.plate_roughness_pitch; twice walls.plate_roughness when it is not given");
  }
  if (given.are_good({"box.height"}) && box.plate_roughness > 0.25 * box.height) {
    problems.error(given.place_of({"walls.plate_roughness"}),
                   fmt::format("walls.plate_roughness = {} is more than a fourth of box.height = {}",
                               length_text(box.plate_roughness), length_text(box.height)));
  }
}

}  // namespace

void check_box_rules(const DirectShearCase& test, Rules& rules) {
  check_box_against_grains(test, rules);
  check_gap(test, rules);
  check_box(test, rules);
  check_ribs(test, rules);
}

}  // namespace dem
