// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/branch_rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

constexpr unsigned bit(BranchStage stage) { return 1U << static_cast<unsigned>(stage); }
constexpr unsigned k_in_fill = bit(BranchStage::fill), k_in_search = bit(BranchStage::search),
                   k_in_compression = bit(BranchStage::compression),
                   k_in_final_friction = bit(BranchStage::final_friction), k_with_specimen = bit(BranchStage::specimen),
                   k_in_shear = bit(BranchStage::shear);
constexpr unsigned k_never = 0,
                   k_before_shear = k_in_fill | k_in_search | k_in_compression | k_in_final_friction | k_with_specimen,
                   k_always = k_before_shear | k_in_shear;

// A key may change as long as no stage that has begun has read it. The stages in their order: fill, search, compression, final
// friction, finished specimen, shear. States of fill and search are shared between runs by their case (preparation_store.hpp),
// one more reason to let nothing change there that they depend on.
constexpr std::array k_rules{
    BranchRule{"test", k_never, "it is another test"},
    BranchRule{"name", k_always, ""},
    BranchRule{"recording.*", k_always, ""},  // the motion does not know what is written of it
    BranchRule{"shear.displacement", k_always, ""},
    BranchRule{"shear.velocity", k_always, ""},
    BranchRule{"shear.inertial_number", k_always, ""},
    // The load of the plate: the specimen comes to rest under the new one, at the latest with the halves standing still in shear.
    BranchRule{"shear.normal_stress", k_always & ~k_in_search,
               "void ratios of branches that came to rest under different stresses cannot be compared"},
    BranchRule{"shear.moving_half", k_before_shear,
               "the displacements of the grains are recorded against the half at rest"},
    BranchRule{"servo.shear_speed_cap", k_always, ""},  // read in shear alone
    BranchRule{"servo.gain", k_always & ~k_in_search, "all branches of a search follow one control"},
    BranchRule{"equilibrium.branch_*", k_in_fill, "all branches of a search rest by one criterion"},
    BranchRule{"equilibrium.*", k_always & ~k_in_search, "all branches of a search rest by one criterion"},
    BranchRule{"specimen.relative_density", k_in_fill | k_in_search, "the friction for it is found"},
    BranchRule{"specimen.relative_density_tolerance", k_in_fill | k_in_search, "the friction for it is found"},
    BranchRule{"specimen.preparation_friction", k_in_fill, "the grains are being compressed with it"},
    BranchRule{"specimen.smallest_friction", k_in_fill, "e_min is measured with it"},
    BranchRule{"specimen.largest_friction", k_in_fill, "e_max is measured with it"},
    BranchRule{"specimen.branch_stress_ratio", k_in_fill, "all branches of a search rest under one stress"},
    BranchRule{"specimen.load_steps", k_in_fill, "the specimen has rested under them"},
    BranchRule{"specimen.preparation_plate_friction", k_in_fill, "the grains are being compressed with it"},
    BranchRule{"specimen.approach_speed", k_in_fill, "the plate compresses the grains with it"},
    BranchRule{"specimen.approach_inertial_number", k_in_fill, "the plate compresses the grains with it"},
    BranchRule{"specimen.gravel_grading_source", k_always, ""},  // notes that nothing reads
    BranchRule{"specimen.rubber_grading_source", k_always, ""},
    BranchRule{"specimen.clump_templates_source", k_always, ""},
    BranchRule{"box.split_plane", k_in_fill | k_in_search | k_in_compression,
               "the halves part there since the final friction was set"},
    BranchRule{"specimen.*", k_never, "the grains were drawn and placed by it"},
    BranchRule{"seed", k_never, "the grains were drawn and placed by it"},
    BranchRule{"box.*", k_never, "the grains lie between these walls"},
    BranchRule{"gravel.*", k_never, "masses and contact forces of the state are of this material"},
    BranchRule{"rubber.bond.*", k_never, "the bonds of the state hold forces of this law"},
    BranchRule{"rubber.*", k_never, "masses and contact forces of the state are of this material"},
    BranchRule{"walls.*", k_never, "the grains lie between these walls"},
    BranchRule{"contact.*", k_never, "the contacts of the state hold forces of this law"},
    BranchRule{"integration.*", k_never, "the state was calculated with this time step and damping"},
};

bool fits(std::string_view pattern, std::string_view key) {
  if (!pattern.ends_with('*')) return pattern == key;
  return key.starts_with(pattern.substr(0, pattern.size() - 1));
}

std::string stages_words(unsigned stages) {
  if (stages == k_never) return "at no stored point";
  if (stages == k_before_shear) return "until shear begins";
  std::vector<std::string> words;
  for (unsigned k = 0; k <= static_cast<unsigned>(BranchStage::shear); ++k) {
    if ((stages & (1U << k)) != 0) words.push_back(stage_words(static_cast<BranchStage>(k)));
  }
  if (words.size() == 1) return "in " + words.front() + " only";
  return fmt::format("in {} and {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

std::string line_of(const KeyChange& change, const std::string& why) {
  return fmt::format("\n  {} = {} -> {}: {}", change.key, change.before, change.after, why);
}

/// A change of the motion that has no way left to show.
bool changes_motion(const std::vector<KeyChange>& changes) {
  return std::any_of(changes.begin(), changes.end(), [](const KeyChange& c) {
    return c.key != "name" && c.key != "shear.displacement" && !c.key.starts_with("recording.") &&
           !c.key.ends_with("_source");
  });
}

}  // namespace

const BranchRule& branch_rule_of(std::string_view key) {
  for (const BranchRule& rule : k_rules) {
    if (fits(rule.key, key)) return rule;
  }
  throw Error(ExitCode::internal, fmt::format("no rule says when {} may change", key));
}

std::string branch_problem(const BranchPoint& point, const DirectShearCase& from, const DirectShearCase& to,
                           const std::string& origin) {
  const std::vector<KeyChange> changes = case_changes(from, to);
  const bool is_in_shear = point.stage == BranchStage::shear;
  std::string lines;
  for (const KeyChange& change : changes) {
    const BranchRule& rule = branch_rule_of(change.key);
    if ((rule.stages & bit(point.stage)) == 0) {
      lines += line_of(change, fmt::format("may change {}; {}", stages_words(rule.stages), rule.reason));
    } else if (change.key == "shear.displacement" && is_in_shear && to.shear.displacement < point.displacement) {
      lines += line_of(change, fmt::format("{:.6g} mm are reached", point.displacement * 1e3));
    }
  }
  if (!lines.empty()) {
    return fmt::format(
        "{} is a state of {}{}, which these changes contradict:{}\na test that starts anew takes them: dem4grm run "
        "CASE "
        "without --from",
        origin, stage_words(point.stage), is_in_shear ? fmt::format(" at {:.6g} mm", point.displacement * 1e3) : "",
        lines);
  }
  const bool is_at_end = is_in_shear && point.displacement >= to.shear.displacement * (1.0 - 1e-12);
  if (is_at_end && changes_motion(changes)) {
    return fmt::format(
        "{} has reached the end of shear, {}, so the changes would have no effect; say how far to shear on, as with "
        "--set shear.displacement=\"{}\"",
        origin, format_quantity(to.shear.displacement, Dimension::length),
        format_quantity(2.0 * to.shear.displacement, Dimension::length));
  }
  return {};
}

}  // namespace dem
