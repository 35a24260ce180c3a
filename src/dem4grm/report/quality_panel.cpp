// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/quality_panel.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace dem {
namespace {

/// A number of the summary with the two borders between good, warning and bad.
struct Rule {
  const char* name;   ///< what a reader calls it
  const char* field;  ///< of the summary
  const char* unit;
  double scale;  ///< from the summary to the unit
  double good, bad;
  const char* limit;
};

// The borders of servo and inertial number are those of the warnings of a run (docs/reference/output-folder.md, summary.json).
constexpr std::array<Rule, 9> k_rules{{
    {"normal stress, largest error of a row", "normal_stress_max_error", "%", 100.0, 5.0, 10.0,
     "up to 5 % good, from 10 % the plate did not hold its stress"},
    {"inertial number, largest", "inertial_number_max", "1", 1.0, 1e-3, 1e-2,
     "up to 0.001 quasi-static: inertia does not count; from 0.01 a dense flow"},
    {"unbalanced force, mean ratio", "unbalanced_ratio_mean", "1", 1.0, 0.02, 0.1,
     "force left on a grain over the mean contact force: up to 0.02 good, from 0.1 not in equilibrium"},
    {"balance of the halves, mean difference", "half_force_imbalance_mean", "%", 100.0, 2.0, 10.0,
     "shear forces on the two halves over the peak: up to 2 % good, from 10 % the box is accelerated"},
    {"energy not accounted for", "energy_closure_per_cent", "%", 1.0, 1.0, 5.0,
     "work of the walls minus stored and lost energy: up to 1 % good, from 5 % energy is made or lost"},
    {"lost grains", "lost_grains", "1", 1.0, 0.0, 0.5, "none may leave the box"},
    {"grains caught in others before shear", "caught_balls_before_shear", "1", 1.0, 0.0, 0.5,
     "ball centres inside other grains: none may be"},
    {"overlap before shear, largest", "largest_overlap_before_shear", "of a radius", 1.0, 0.5, 1.0,
     "up to half of the smaller radius the contact law can be meant; from one radius the balls have passed"},
    {"broken bonds", "broken_bonds", "1", 1.0, 0.0, std::numeric_limits<double>::infinity(),
     "bonds of the published rubber do not break"},
}};

JsonObject line(const std::string& name, JsonValue value, const char* unit, const std::string& limit,
                const char* verdict) {
  return {{"name", name}, {"value", std::move(value)}, {"unit", unit}, {"limit", limit}, {"verdict", verdict}};
}

const char* verdict_of(double value, const Rule& rule) {
  if (!std::isfinite(value)) return "unknown";
  if (std::fabs(value) <= rule.good) return "good";
  return std::fabs(value) < rule.bad ? "warning" : "bad";
}

/// Mean normal stress against the one that was asked for.
JsonObject servo_line(const JsonObject& summary) {
  constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();
  const Rule rule{"normal stress, error of the mean", "", "%", 1.0, 1.0, 5.0, "up to 1 % good, from 5 % another test"};
  const double error = 100.0 * (number_in(summary, "normal_stress_mean_kPa", k_nothing) /
                                    number_in(summary, "normal_stress_target_kPa", k_nothing) -
                                1.0);
  return line(rule.name, error, rule.unit, rule.limit, verdict_of(error, rule));
}

}  // namespace

JsonList quality_panel(const JsonObject& summary, const JsonObject& status) {
  JsonList lines;
  const std::string state = text_in(status, "state");
  if (!state.empty() && state != "finished" && state != "specimen ready") {
    const std::string cause = text_in(status, "cause");
    lines.emplace_back(line("state of the run", JsonValue(), "", cause.empty() ? state : state + ": " + cause,
                            state == "failed" ? "bad" : "warning"));
  }
  if (has_number(summary, "normal_stress_mean_kPa")) lines.emplace_back(servo_line(summary));
  for (const Rule& rule : k_rules) {
    if (find_field(summary, rule.field) == nullptr) continue;  // another kind of test
    const double value = rule.scale * number_in(summary, rule.field, std::numeric_limits<double>::quiet_NaN());
    lines.emplace_back(line(rule.name, value, rule.unit, rule.limit, verdict_of(value, rule)));
  }
  const JsonValue* warnings = find_field(summary, "warnings");
  if (const auto* list = warnings == nullptr ? nullptr : std::get_if<JsonList>(&warnings->data)) {
    for (const JsonValue& text : *list) {
      if (const auto* words = std::get_if<std::string>(&text.data)) {
        lines.emplace_back(line("warning of the run", JsonValue(), "", *words, "warning"));
      }
    }
  }
  return lines;
}

}  // namespace dem
