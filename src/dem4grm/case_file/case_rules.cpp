// SPDX-License-Identifier: BSD-3-Clause
// The rules between keys.
#include "dem4grm/case_file/case_rules.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <fmt/format.h>

#include "dem4grm/case_file/box_rules.hpp"
#include "dem4grm/case_file/overlap_rule.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/laws/inertial_number.hpp"

namespace dem {
namespace {

std::string stress_text(double value) { return format_quantity(value, Dimension::stress); }
std::string speed_text(double value) { return format_quantity(value, Dimension::speed); }

void check_materials(const SpecimenSettings& specimen, Rules& rules) {
  const auto& given = rules.given;
  if (!given.are_good({"specimen.rubber_content"})) return;
  const Place place = given.place_of({"specimen.rubber_content"});
  if (has_gravel(specimen) && !given.has("specimen.gravel_grading")) {
    rules.problems.error(place, "a specimen with gravel needs specimen.gravel_grading",
                         "a CSV file or a list of [sieve size, fraction passing by mass]");
  }
  if (has_rubber(specimen) && !given.has("specimen.rubber_grading")) {
    rules.problems.error(place, "a specimen with rubber needs specimen.rubber_grading",
                         "a CSV file or a list of [sieve size, fraction passing by mass]");
  }
  const auto check_count = [&](std::string_view key, const std::optional<int>& count, bool is_present) {
    if (!count || !given.are_good({key}) || (*count > 0) == is_present) return;
    rules.problems.error(given.place_of({key}), fmt::format("{} = {} does not go with rubber_content = {}", key, *count,
                                                            format_decimal(specimen.rubber_content)));
  };
  check_count("specimen.gravel_clumps", specimen.gravel_clumps, has_gravel(specimen));
  check_count("specimen.rubber_grains", specimen.rubber_grains, has_rubber(specimen));
}

/// Shapes and their shares belong together, and shapes that are written down are meant to be used.
void check_shapes(const SpecimenSettings& specimen, Rules& rules) {
  const auto& [given, problems] = rules;
  constexpr double k_rounding = 0.0101;  // shares such as 0.33, 0.33, 0.33 are meant to be everything
  if (!given.are_good({"specimen.clump_templates", "specimen.clump_shapes"})) return;
  const auto is_used = [&](const ClumpShape& own) {
    const auto& names = specimen.clump_shapes;
    return std::find(names.begin(), names.end(), own.name) != names.end();
  };
  const auto& own = specimen.clump_templates;
  if (!own.empty() && std::none_of(own.begin(), own.end(), is_used)) {
    problems.warning(given.place_of({"specimen.clump_templates"}),
                     "specimen.clump_shapes names none of the shapes of specimen.clump_templates",
                     fmt::format("as clump_shapes = [\"{}\"]", own.front().name));
  }
  if (!given.has("specimen.clump_shares") || !given.are_good({"specimen.clump_shares"})) return;
  const Place place = given.place_of({"specimen.clump_shares"});
  const std::size_t shapes = specimen.clump_shapes.size(), shares = specimen.clump_shares.size();
  if (shapes != shares) {
    problems.error(place, fmt::format("specimen.clump_shares gives {} share(s) for {} clump_shapes", shares, shapes));
    return;
  }
  double sum = 0.0;
  for (const double share : specimen.clump_shares) sum += share;
  if (std::abs(sum - 1.0) > k_rounding) {
    problems.error(place, fmt::format("specimen.clump_shares add up to {}, not to 1", format_decimal(sum)),
                   "fractions of the volume of the gravel");
  }
}

/// Between the frictions that give e_min and e_max; a search needs room for its trials.
constexpr double k_least_friction_range = 0.01;

void check_preparation(const DirectShearCase& test, Rules& rules) {
  const auto& [given, problems] = rules;
  const SpecimenSettings& specimen = test.specimen;
  if (given.has("specimen.relative_density") && given.has("specimen.preparation_friction")) {
    problems.error(given.place_of({"specimen.preparation_friction"}),
                   "specimen.preparation_friction and specimen.relative_density exclude each other",
                   "the friction sets the density; give it, or the density to be searched for");
  }
  if (given.are_good({"specimen.smallest_friction", "specimen.largest_friction"}) &&
      !(specimen.smallest_friction + k_least_friction_range <= specimen.largest_friction)) {
    problems.error(given.place_of({"specimen.smallest_friction", "specimen.largest_friction"}),
                   fmt::format("specimen.smallest_friction = {} must be {} below specimen.largest_friction = {}",
                               format_decimal(specimen.smallest_friction), format_decimal(k_least_friction_range),
                               format_decimal(specimen.largest_friction)));
  }
  for (const std::string_view key : {"specimen.relative_density_tolerance", "specimen.smallest_friction",
                                     "specimen.largest_friction", "specimen.branch_stress_ratio"}) {
    if (!given.has(key) || !given.has("specimen.preparation_friction")) continue;
    problems.warning(
        given.place_of({key}),
        fmt::format("{} has no effect beside specimen.preparation_friction: nothing is searched for", key));
  }
  if (given.are_good({"specimen.load_steps"}) &&
      std::adjacent_find(specimen.load_steps.begin(), specimen.load_steps.end(), std::greater_equal<>()) !=
          specimen.load_steps.end()) {
    problems.error(given.place_of({"specimen.load_steps"}), "specimen.load_steps must rise from entry to entry");
  }
}

void check_recording(const DirectShearCase& test, Rules& rules) {
  const GivenKeys& given = rules.given;
  CaseProblems& problems = rules.problems;
  const RecordingSettings& recording = test.recording;
  const double displacement = test.shear.displacement;
  if (given.are_good({"recording.interval", "shear.displacement"}) && recording.interval > displacement) {
    problems.error(given.place_of({"recording.interval", "shear.displacement"}),
                   fmt::format("recording.interval = {} is longer than shear.displacement = {}",
                               length_text(recording.interval), length_text(displacement)));
  }
  const auto check_not_shorter = [&](std::string_view key, double value) {
    if (!given.are_good({"recording.interval", key}) || value >= recording.interval) return;
    problems.error(given.place_of({key, "recording.interval"}),
                   fmt::format("{} = {} is shorter than recording.interval = {}", key, length_text(value),
                               length_text(recording.interval)));
  };
  check_not_shorter("recording.frame_interval", recording.frame_interval);
  check_not_shorter("recording.micro_interval", recording.micro_interval);
  if (given.has("recording.extra_frames") && given.are_good({"recording.extra_frames", "shear.displacement"})) {
    const auto& frames = recording.extra_frames;
    const auto largest = std::max_element(frames.begin(), frames.end());
    if (largest != frames.end() && *largest > displacement) {
      problems.warning(given.place_of({"recording.extra_frames"}),
                       fmt::format("recording.extra_frames: {} is never reached, the test ends at {}",
                                   length_text(*largest), length_text(displacement)));
    }
  }
}

void check_shear(const DirectShearCase& test, Rules& rules) {
  const auto& [given, problems] = rules;
  const ShearSettings& shear = test.shear;
  if (given.are_good({"shear.normal_stress"}) && (shear.normal_stress < 10e3 || shear.normal_stress > 500e3)) {
    problems.warning(given.place_of({"shear.normal_stress"}),
                     fmt::format("shear.normal_stress = {} is outside the usual 10 kPa to 500 kPa",
                                 stress_text(shear.normal_stress)),
                     "published: 30, 60 and 100 kPa");
  }
  if (!given.are_good({"shear.velocity"})) return;
  if (shear.velocity && *shear.velocity > 0.050) {
    problems.warning(
        given.place_of({"shear.velocity"}),
        fmt::format("shear.velocity = {} is above 50 mm/s: hardly quasi-static", speed_text(*shear.velocity)),
        "published: 2 mm/s");
  }
  if (!shear.inertial_number || !given.are_good({"shear.inertial_number"})) return;
  const Place place = given.place_of({"shear.inertial_number"});
  if (shear.velocity) {
    problems.warning(
        place,
        fmt::format("shear.inertial_number has no effect beside shear.velocity = {}", speed_text(*shear.velocity)),
        "velocity = \"quasi-static\" chooses the velocity for it");
  } else if (*shear.inertial_number > k_quasi_static) {
    problems.warning(place,
                     fmt::format("shear.inertial_number = {} is above {}: not quasi-static beyond doubt",
                                 format_decimal(*shear.inertial_number), format_decimal(k_quasi_static)),
                     "published: below 1e-4");
  }
}

void check_bond(const BondSettings& bond, Rules& rules) {
  const GivenKeys& given = rules.given;
  CaseProblems& problems = rules.problems;
  if (given.are_good({"rubber.bond.spring_friction", "rubber.bond.hertz_contact"}) && bond.spring_friction > 0.0 &&
      bond.hertz_contact) {
    problems.error(given.place_of({"rubber.bond.hertz_contact", "rubber.bond.spring_friction"}),
                   "rubber.bond.hertz_contact = true does not go with rubber.bond.spring_friction above 0",
                   "bonded balls have one kind of friction beside the bond");
  }
  if (given.are_good({"rubber.bond.spring_friction", "rubber.bond.linear_spring"}) && bond.spring_friction > 0.0 &&
      !bond.linear_spring) {
    problems.error(given.place_of({"rubber.bond.spring_friction", "rubber.bond.linear_spring"}),
                   "rubber.bond.spring_friction needs rubber.bond.linear_spring = true");
  }
  if (!given.are_good({"rubber.bond.form"}) || bond.form != BondForm::history_free) return;
  const auto check_strength = [&](std::string_view key, double strength) {
    constexpr double k_never = 1e100;  // Pa; from here on a bond counts as unbreakable
    if (!given.are_good({key}) || strength >= k_never) return;
    problems.error(given.place_of({key}),
                   fmt::format("{} = {} needs rubber.bond.form = \"incremental\"", key, stress_text(strength)),
                   "bonds of the history-free form cannot break");
  };
  check_strength("rubber.bond.tensile_strength", bond.tensile_strength);
  check_strength("rubber.bond.shear_strength", bond.shear_strength);
  if (given.are_good({"rubber.bond.moment_scale"}) && bond.moment_scale < 0.1) {
    problems.error(given.place_of({"rubber.bond.moment_scale"}),
                   fmt::format("rubber.bond.moment_scale = {} is below 0.1 with rubber.bond.form = \"history_free\"",
                               format_decimal(bond.moment_scale)),
                   "the history-free form needs moments; a grain without them is a mechanism");
  }
}

void check_integration(const IntegrationSettings& integration, Rules& rules) {
  const auto& [given, problems] = rules;
  if (given.are_good({"integration.time_step_safety"}) && integration.time_step_safety > 0.9) {
    problems.warning(given.place_of({"integration.time_step_safety"}),
                     fmt::format("integration.time_step_safety = {} leaves little room to the stability limit",
                                 format_decimal(integration.time_step_safety)));
  }
  if (given.are_good({"integration.local_damping"}) && integration.local_damping > 0.8) {
    problems.warning(given.place_of({"integration.local_damping"}),
                     fmt::format("integration.local_damping = {} slows every motion down",
                                 format_decimal(integration.local_damping)),
                     "published: 0.2");
  }
}

}  // namespace

void check_rules(const DirectShearCase& test, const GivenKeys& given, CaseProblems& problems) {
  Rules rules{given, problems};
  check_materials(test.specimen, rules);
  check_preparation(test, rules);
  check_shapes(test.specimen, rules);
  check_box_rules(test, rules);
  check_overlap(test, rules);
  check_recording(test, rules);
  check_shear(test, rules);
  check_bond(test.bond, rules);
  check_integration(test.integration, rules);
  if (given.are_good({"equilibrium.most_steps", "equilibrium.hold_steps"}) &&
      test.equilibrium.most_steps <= test.equilibrium.hold_steps) {
    problems.error(given.place_of({"equilibrium.most_steps", "equilibrium.hold_steps"}),
                   fmt::format("equilibrium.most_steps = {} must be greater than equilibrium.hold_steps = {}",
                               test.equilibrium.most_steps, test.equilibrium.hold_steps));
  }
}

void check_rules(const GrainCompressionCase& test, const GivenKeys& given, CaseProblems& problems) {
  Rules rules{given, problems};
  check_bond(test.bond, rules);
  check_integration(test.integration, rules);
}

}  // namespace dem
