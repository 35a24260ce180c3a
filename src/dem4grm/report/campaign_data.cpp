// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/campaign_data.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace dem {
namespace {

constexpr double k_degrees_per_rad = 180.0 / std::numbers::pi;

/// Numbers as numbers, texts without the quotes of TOML.
JsonObject values_as_json(const std::vector<StudyValue>& values) {
  JsonObject out;
  for (const StudyValue& value : values) {
    if (value.number) {
      out.push_back({value.column, *value.number});
      continue;
    }
    const bool is_quoted = value.text.size() >= 2 && value.text.front() == '"' && value.text.back() == '"';
    out.push_back({value.column, is_quoted ? value.text.substr(1, value.text.size() - 2) : value.text});
  }
  return out;
}

bool has_all(const std::vector<StudyValue>& values, const std::vector<StudyValue>& wanted) {
  return std::all_of(wanted.begin(), wanted.end(), [&](const StudyValue& value) {
    return std::find(values.begin(), values.end(), value) != values.end();
  });
}

/// Values of a test but for those that the points of one envelope differ in.
std::size_t count_of_mixture(const std::vector<StudyValue>& values) {
  return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](const StudyValue& value) {
    return value.key != "shear.normal_stress" && value.key != "seed";
  }));
}

JsonValue low_of(const Estimate& e, double scale) { return e.low ? JsonValue(*e.low * scale) : JsonValue(); }
JsonValue high_of(const Estimate& e, double scale) { return e.high ? JsonValue(*e.high * scale) : JsonValue(); }

JsonObject envelope_as_json(const MixtureEnvelope& envelope, const Collection& collection) {
  JsonList points;
  const std::string field = envelope.quantity + "_shear_stress_kPa";
  for (std::size_t k = 0; k < collection.tests.size(); ++k) {
    const std::vector<StudyValue>& values = collection.tests[k].values;
    const bool belongs = count_of_mixture(values) == envelope.values.size() && has_all(values, envelope.values);
    if (!belongs || !has_number(collection.summaries[k], field)) continue;
    points.emplace_back(JsonObject{{"normal_stress_kPa", number_in(collection.summaries[k], "normal_stress_mean_kPa")},
                                   {"shear_stress_kPa", number_in(collection.summaries[k], field)},
                                   {"test", collection.tests[k].name}});
  }
  const Estimate none;
  const bool is_line = envelope.fit.friction_angle.has_value();
  const Estimate& angle = is_line ? *envelope.fit.friction_angle : none;
  const Estimate& cohesion = envelope.fit.cohesion ? *envelope.fit.cohesion : none;
  return {{"values", values_as_json(envelope.values)},
          {"quantity", envelope.quantity},
          {"points", std::move(points)},
          {"tests_still_rising", envelope.hardening},
          {"friction_angle_deg", is_line ? JsonValue(angle.value * k_degrees_per_rad) : JsonValue()},
          {"friction_angle_low_deg", low_of(angle, k_degrees_per_rad)},
          {"friction_angle_high_deg", high_of(angle, k_degrees_per_rad)},
          {"cohesion_kPa", envelope.fit.cohesion ? JsonValue(cohesion.value * 1e-3) : JsonValue()},
          {"cohesion_low_kPa", low_of(cohesion, 1e-3)},
          {"cohesion_high_kPa", high_of(cohesion, 1e-3)}};
}

}  // namespace

JsonObject campaign_data(const CampaignRecord& record, const std::vector<TestStatus>& tests,
                         const Collection& collection) {
  JsonList columns, rows, envelopes;
  for (const RecordedTest& test : record.tests) {
    for (const StudyValue& value : test.values) {
      const bool is_known = std::any_of(columns.begin(), columns.end(), [&](const JsonValue& known) {
        return std::get<std::string>(known.data) == value.column;
      });
      if (!is_known) columns.emplace_back(value.column);
    }
  }
  for (std::size_t k = 0; k < record.tests.size(); ++k) {
    rows.emplace_back(JsonObject{{"name", record.tests[k].name},
                                 {"values", values_as_json(record.tests[k].values)},
                                 {"state", test_state_name(tests[k].state)},
                                 {"reason", tests[k].cause}});
  }
  for (const MixtureEnvelope& envelope : collection.envelopes) {
    envelopes.emplace_back(envelope_as_json(envelope, collection));
  }
  return {{"name", record.study},
          {"columns", std::move(columns)},
          {"tests", std::move(rows)},
          {"envelopes", std::move(envelopes)}};
}

}  // namespace dem
