// SPDX-License-Identifier: BSD-3-Clause
// Reading of the tests of a collection.
#include "dem4grm/campaign/collect.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/profile_file.hpp"
#include "dem4grm/results/written_table.hpp"

namespace dem {
namespace {

constexpr std::size_t k_longest_text = 120;
constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();

/// The rows of a CSV file that a run wrote, added to a table; unknown columns are those of another version of the program.
void add_rows(const std::filesystem::path& path, std::int32_t test, std::span<const ColumnInfo> known,
              CollectedTable& table) {
  const WrittenTable file = read_table(path);
  if (file.names.size() < 2) throw IoError(fmt::format("{}: has no columns", path.string()));
  if (file.is_cut) throw IoError(fmt::format("{}: the last row is incomplete", path.string()));
  if (table.columns.empty()) {
    for (const ColumnInfo& info : known) {
      table.columns.push_back({std::string(info.name), std::string(info.unit), std::string(info.description), {}});
    }
  }
  const std::size_t n_rows = file.columns.front().size();
  table.test.insert(table.test.end(), n_rows, test);
  for (CollectedTable::Column& column : table.columns) {
    const auto found = std::find(file.names.begin(), file.names.end(), column.name);
    if (found == file.names.end()) {
      column.values.insert(column.values.end(), n_rows, k_nothing);
    } else {
      const std::vector<double>& values = file.columns[static_cast<std::size_t>(found - file.names.begin())];
      column.values.insert(column.values.end(), values.begin(), values.end());
    }
  }
}

/// Numbers and short texts; names of an object inside begin with the name of the object.
JsonObject flattened(const JsonObject& summary) {
  JsonObject flat;
  for (const JsonField& field : summary) {
    if (const auto* inner = std::get_if<JsonObject>(&field.value.data)) {
      for (const JsonField& f : *inner) flat.push_back({fmt::format("{}_{}", field.name, f.name), f.value});
    } else if (const auto* text = std::get_if<std::string>(&field.value.data)) {
      if (text->size() <= k_longest_text) flat.push_back(field);
    } else if (!std::holds_alternative<JsonList>(field.value.data)) {
      flat.push_back(field);
    }
  }
  return flat;
}

/// The rows of one test behind those of the tests before it.
void append_rows(CollectedTable& all, CollectedTable fresh) {
  if (all.columns.empty()) {
    all = std::move(fresh);
    return;
  }
  all.test.insert(all.test.end(), fresh.test.begin(), fresh.test.end());
  for (std::size_t c = 0; c < fresh.columns.size(); ++c) {
    const std::vector<double>& values = fresh.columns[c].values;
    all.columns[c].values.insert(all.columns[c].values.end(), values.begin(), values.end());
  }
}

void add_test(const CollectedTest& test, Collection& out) {
  const auto number = static_cast<std::int32_t>(out.tests.size());
  const JsonObject summary = read_json_file(test.folder / file_name::k_summary);
  Collection fresh;  // a test that turns out to be damaged must leave no rows behind
  const auto add_if_there = [&](const char* name, std::span<const ColumnInfo> columns, CollectedTable& table) {
    if (std::filesystem::exists(test.folder / name)) add_rows(test.folder / name, number, columns, table);
  };
  if (text_in(summary, "test") == "grain_compression") {
    add_rows(test.folder / file_name::k_grain, number, compression_columns(), fresh.compression);
  } else {
    add_rows(test.folder / file_name::k_shear, number, shear_columns(), fresh.shear);
    add_rows(test.folder / file_name::k_micro, number, micro_columns(), fresh.micro);
    add_if_there(file_name::k_walls, wall_columns(), fresh.walls);
    add_if_there(file_name::k_profiles, profile_columns(), fresh.profiles);
  }
  append_rows(out.shear, std::move(fresh.shear));
  append_rows(out.walls, std::move(fresh.walls));
  append_rows(out.micro, std::move(fresh.micro));
  append_rows(out.profiles, std::move(fresh.profiles));
  append_rows(out.compression, std::move(fresh.compression));
  out.tests.push_back(test);
  out.summaries.push_back(flattened(summary));
}

bool is_of_mixture(const StudyValue& value) { return value.key != "shear.normal_stress" && value.key != "seed"; }

void find_envelopes(Collection& out) {
  struct Mixture {
    std::vector<StudyValue> values;
    std::vector<StrengthPoint> peak, residual;
    int hardening = 0;
  };
  std::vector<Mixture> mixtures;
  std::map<std::string, std::size_t> places;
  for (std::size_t k = 0; k < out.tests.size(); ++k) {
    const JsonObject& summary = out.summaries[k];
    if (find_field(summary, "peak_shear_stress_kPa") == nullptr) continue;
    std::vector<StudyValue> values;
    std::string key;
    for (const StudyValue& value : out.tests[k].values) {
      if (!is_of_mixture(value)) continue;
      key += fmt::format("{}={};", value.key, value.text);
      values.push_back(value);
    }
    const auto [place, is_new] = places.emplace(key, mixtures.size());
    if (is_new) mixtures.push_back({values, {}, {}, 0});
    Mixture& mixture = mixtures[place->second];
    const double sigma = 1e3 * number_in(summary, "normal_stress_mean_kPa");
    const auto take = [&](std::vector<StrengthPoint>& points, const char* name) {  // a short record has none
      if (has_number(summary, name)) points.push_back({sigma, 1e3 * number_in(summary, name)});
    };
    take(mixture.peak, "peak_shear_stress_kPa");
    take(mixture.residual, "residual_shear_stress_kPa");
    mixture.hardening += is_set_in(summary, "hardening") ? 1 : 0;
  }
  for (const Mixture& mixture : mixtures) {
    for (const auto& [quantity, points] :
         {std::pair{"peak", &mixture.peak}, std::pair{"residual", &mixture.residual}}) {
      if (points->empty()) continue;
      out.envelopes.push_back({mixture.values, quantity, mixture.hardening, fit_envelope(*points)});
    }
  }
}

std::string bounds_text(const Estimate& estimate, double scale) {
  std::string text = fmt::format("{:.1f}", scale * estimate.value);
  if (estimate.low && estimate.high)
    text += fmt::format(" ({:.1f} to {:.1f})", scale * *estimate.low, scale * *estimate.high);
  return text;
}

}  // namespace

Collection read_collection(const std::vector<CollectedTest>& tests) {
  Collection out;
  for (const CollectedTest& test : tests) {
    try {
      add_test(test, out);
    } catch (const Error& error) {
      out.warnings.push_back(fmt::format("{} is left out: {}", test.name, error.what()));
      continue;
    }
    for (const StudyValue& value : test.values) {
      if (std::find(out.columns.begin(), out.columns.end(), value.column) == out.columns.end()) {
        out.columns.push_back(value.column);
      }
    }
  }
  find_envelopes(out);
  return out;
}

std::string envelopes_text(const Collection& collection) {
  constexpr double k_degrees_per_radian = 180.0 / std::numbers::pi;
  std::string text;
  for (const MixtureEnvelope& e : collection.envelopes) {
    if (!e.fit.friction_angle) continue;
    std::vector<std::string> words;
    for (const StudyValue& value : e.values) words.push_back(fmt::format("{} {}", value.column, value.text));
    text += fmt::format(
        "  {:<40} {:<9} phi {} degrees, c {} kPa, {} tests{}\n", fmt::join(words, ", "), e.quantity,
        bounds_text(*e.fit.friction_angle, k_degrees_per_radian), bounds_text(*e.fit.cohesion, 1e-3), e.fit.points,
        e.quantity == "peak" && e.hardening > 0 ? fmt::format(", {} still hardening", e.hardening) : "");
  }
  return text;
}

}  // namespace dem
