// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/test_data.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/report/case_inputs.hpp"
#include "dem4grm/report/quality_panel.hpp"
#include "dem4grm/report/view_data.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/histogram_curves.hpp"
#include "dem4grm/results/micro_state_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/sieve_report.hpp"
#include "dem4grm/results/written_table.hpp"

namespace dem {
namespace {

constexpr double k_degrees = 180.0 / std::numbers::pi;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw MissingFileError(fmt::format("{}: cannot be opened", path.string()));
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// What `make` returns, or null with a note when it fails.
template <class Make>
JsonValue or_note(std::vector<std::string>& notes, const Make& make) {
  try {
    return make();
  } catch (const Error& error) {
    notes.emplace_back(error.what());
    return {};
  }
}

JsonValue table_or_null(const std::filesystem::path& csv, std::vector<std::string>& notes) {
  if (!is_there(csv)) return {};
  return or_note(notes, [&] { return JsonValue(table_data(csv)); });
}

JsonObject object_or_empty(const std::filesystem::path& path, std::vector<std::string>& notes) {
  if (!is_there(path)) return {};
  try {
    return read_json_file(path);
  } catch (const Error& error) {
    notes.emplace_back(error.what());
    return {};
  }
}

/// Six digits are more than a picture shows, and a third of the text.
JsonList short_numbers(const std::vector<double>& values) {
  JsonList out;
  for (const double value : values) {
    if (std::isfinite(value) && value != 0.0) {
      const double unit = std::pow(10.0, std::floor(std::log10(std::fabs(value))) - 5.0);
      out.emplace_back(std::round(value / unit) * unit);
    } else {
      out.emplace_back(value);
    }
  }
  return out;
}

JsonValue band_or_null(const Band& band, double scale) {
  if (!std::isfinite(band.low) || !std::isfinite(band.high)) return {};
  return JsonList{band.low * scale, band.high * scale};
}

JsonObject histogram_as_json(const PolarHistogram& histogram, const AnisotropyBands& bands, const char* set) {
  const HistogramCurves c = histogram_curves(histogram);
  return {{"set", set},
          {"contacts", histogram.count},
          {"angle_deg", short_numbers(c.angle_deg)},
          {"density", short_numbers(c.density)},
          {"normal_force_N", short_numbers(c.normal_force)},
          {"shear_force_N", short_numbers(c.shear_force)},
          {"signed_shear_force_N", short_numbers(c.signed_shear)},
          {"fit", JsonObject{{"density", short_numbers(c.density_fit)},
                             {"normal_force_N", short_numbers(c.normal_force_fit)},
                             {"shear_force_N", short_numbers(c.shear_force_fit)},
                             {"signed_shear_force_N", short_numbers(c.signed_shear_fit)}}},
          {"bands", JsonObject{{"a", band_or_null(bands.fabric_amplitude, 1.0)},
                               {"theta_a_deg", band_or_null(bands.fabric_direction, k_degrees)},
                               {"a_n", band_or_null(bands.normal_amplitude, 1.0)},
                               {"theta_n_deg", band_or_null(bands.normal_direction, k_degrees)},
                               {"a_t", band_or_null(bands.shear_amplitude, 1.0)},
                               {"theta_t_deg", band_or_null(bands.shear_direction, k_degrees)},
                               {"a_s", band_or_null(bands.signed_shear_amplitude, 1.0)},
                               {"theta_s_deg", band_or_null(bands.signed_shear_direction, k_degrees)}}}};
}

JsonList histograms_of(const std::filesystem::path& results, int resamples) {
  MicroOptions options;
  options.resamples = resamples;
  JsonList states;
  for (const StoredFrame& frame : read_outline(results).frames) {
    const StoredMicroState stored = read_micro_state(results, frame.displacement);
    const MicroAnalysis analysis = analyse(stored.state, options);
    JsonList sets;
    for (std::size_t set = 0; set < k_contact_sets; ++set) {
      if (!(analysis.histograms[set].count > 0.0)) continue;
      sets.emplace_back(histogram_as_json(analysis.histograms[set], analysis.bands[set], k_set_names[set]));
    }
    states.emplace_back(JsonObject{{"displacement_mm", stored.displacement * 1e3}, {"sets", std::move(sets)}});
  }
  return states;
}

JsonObject sieve_of(const std::filesystem::path& folder) {
  const SieveReport report = sieve_report(read_stored_grains(folder), {});
  std::vector<double> openings;
  for (const double opening : report.table.openings) openings.push_back(opening * 1e3);
  JsonList materials;
  for (const auto& [name, column] :
       {std::pair{"gravel", &report.table.gravel}, std::pair{"rubber", &report.table.rubber},
        std::pair{"both", &report.table.together}}) {
    if (!column->is_there()) continue;
    const auto per_cent = [](const std::vector<double>& shares) {
      std::vector<double> out;
      out.reserve(shares.size());
      for (const double share : shares) out.push_back(100.0 * share);
      return short_numbers(out);
    };
    materials.emplace_back(JsonObject{{"name", name},
                                      {"sieve_mm", short_numbers(openings)},
                                      {"passing_per_cent", per_cent(column->measured)},
                                      {"target_per_cent", per_cent(column->asked)}});
  }
  return {{"materials", std::move(materials)}};
}

/// results.h5, else specimen.h5, else nothing.
std::filesystem::path states_file(const std::filesystem::path& folder) {
  for (const char* name : {file_name::k_results, file_name::k_specimen}) {
    if (is_there(folder / name)) return folder / name;
  }
  return {};
}

/// What a shell takes as one word.
std::string as_word(const std::string& text) {
  const bool is_plain = !text.empty() && text.find_first_not_of(
                                             "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                             "_./-+=:,@%") == std::string::npos;
  if (is_plain) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// A branched test starts from a state of another one.
std::string from_option(const std::filesystem::path& folder, std::vector<std::string>& notes) {
  const std::string source = text_in(object_or_empty(folder / file_name::k_branch, notes), "source");
  return source.empty() ? "" : " --from " + as_word(source);
}

struct FoundFiles {
  bool is_compression = false, is_specimen = false;
  JsonObject summary, status;
};

FoundFiles look_at(const std::filesystem::path& folder, std::vector<std::string>& notes) {
  FoundFiles out;
  out.summary = object_or_empty(folder / file_name::k_summary, notes);
  out.status = object_or_empty(folder / file_name::k_status, notes);
  out.is_compression = is_there(folder / file_name::k_grain) || text_in(out.summary, "test") == "grain_compression";
  if (out.summary.empty() && !out.is_compression) {
    out.summary = object_or_empty(folder / file_name::k_specimen_summary, notes);
    out.is_specimen = !out.summary.empty() && !is_there(folder / file_name::k_shear);
  }
  return out;
}

}  // namespace

JsonObject table_data(const std::filesystem::path& csv) {
  const WrittenTable table = read_table(csv);
  JsonList values;
  for (const std::vector<double>& column : table.columns) {
    JsonList numbers;
    for (const double number : column) numbers.push_back(std::isnan(number) ? JsonValue() : JsonValue(number));
    values.emplace_back(std::move(numbers));
  }
  return {{"columns", JsonValue(table.names)}, {"values", std::move(values)}};
}

JsonObject test_data(const std::filesystem::path& folder, const std::string& name, const TestDataOptions& options,
                     std::vector<std::string>& notes) {
  const bool has_case = is_there(folder / file_name::k_resolved);
  if (!has_case && !is_there(folder / file_name::k_summary)) {
    throw MissingFileError(fmt::format("{}: holds no test: there is neither {} nor {}", folder.string(),
                                       file_name::k_resolved, file_name::k_summary));
  }
  const FoundFiles found = look_at(folder, notes);
  const std::filesystem::path states = found.is_compression ? std::filesystem::path() : states_file(folder);
  JsonObject out{{"name", name},
                 {"folder", folder.string()},
                 {"kind", found.is_compression ? "grain_compression"
                          : found.is_specimen  ? "specimen"
                                               : "direct_shear"},
                 {"state", text_in(found.status, "state")},
                 {"command", fmt::format("dem4grm {} {}{} -o {}", found.is_specimen ? "specimen" : "run",
                                         as_word((folder / file_name::k_resolved).string()), from_option(folder, notes),
                                         as_word(folder.string() + "-again"))},
                 {"state_hash", text_in(found.summary, "state_hash")}};
  out.push_back(
      {"inputs", has_case
                     ? or_note(notes, [&] { return JsonValue(case_inputs(text_of(folder / file_name::k_resolved))); })
                     : JsonValue(JsonList{})});
  out.push_back({"summary", found.summary});
  out.push_back({"status", found.status});
  out.push_back(
      {"tables",
       JsonObject{{"shear", table_or_null(folder / file_name::k_shear, notes)},
                  {"walls", options.has_wall_table ? table_or_null(folder / file_name::k_walls, notes) : JsonValue()},
                  {"micro", table_or_null(folder / file_name::k_micro, notes)},
                  {"profiles", table_or_null(folder / file_name::k_profiles, notes)},
                  {"compression", table_or_null(folder / file_name::k_grain, notes)}}});
  const bool has_states = !states.empty();
  JsonValue histograms = JsonList{};
  if (has_states) histograms = or_note(notes, [&] { return JsonValue(histograms_of(states, options.resamples)); });
  out.push_back(
      {"histograms", std::holds_alternative<std::monostate>(histograms.data) ? JsonValue(JsonList{}) : histograms});
  out.push_back({"sieve", has_states ? or_note(notes, [&] { return JsonValue(sieve_of(folder)); }) : JsonValue()});
  out.push_back({"quality", quality_panel(found.summary, found.status)});
  out.push_back({"view", has_states && options.states_in_view > 0
                             ? or_note(notes, [&] { return JsonValue(view_of(states, options.states_in_view)); })
                             : JsonValue()});
  return out;
}

}  // namespace dem
