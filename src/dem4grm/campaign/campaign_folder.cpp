// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/campaign_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "dem4grm/case_file/case_differences.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

constexpr int k_record_format = 1;
constexpr std::size_t k_most_changed_shown = 5;

std::optional<std::string> text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

/// Of a thousand cases none is worth a wait for the disk: a second call writes them again.
void write_plain(const std::filesystem::path& path, const std::string& text) {
  if (text_of(path) == text) return;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  if (!file.flush()) throw_io_error(path, "cannot be written");
}

void make_folders(const CampaignFolder& folder) {
  for (const char* name : {"cases", "tests", "logs", "store"}) {
    std::error_code error;
    std::filesystem::create_directories(folder.root() / name, error);
    if (error)
      throw IoError(fmt::format("{}: the folder cannot be made: {}", (folder.root() / name).string(), error.message()));
  }
}

void refuse_folder_of_a_run(const CampaignFolder& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder.root() / file_name::k_resolved, ignored)) return;
  throw Error(ExitCode::usage, fmt::format("{} is the output folder of a single test; choose another folder with -o",
                                           folder.root().string()));
}

/// Tests that were begun with another case than the study has now.
void refuse_changed_cases(const CampaignFolder& folder, const Study& study) {
  std::string text;
  std::size_t changed = 0;
  for (const StudyTest& test : study.tests) {
    const std::optional<std::string> begun = text_of(folder.test(test.name) / file_name::k_resolved);
    if (!begun || *begun == test.loaded.resolved_toml) continue;
    if (++changed > k_most_changed_shown) continue;
    text += fmt::format("\n  {}:\n    {}", test.name,
                        fmt::join(case_differences(*begun, test.loaded.resolved_toml), "\n    "));
  }
  if (changed == 0) return;
  if (changed > k_most_changed_shown) text += fmt::format("\n  and {} more", changed - k_most_changed_shown);
  throw Error(
      ExitCode::usage,
      fmt::format("{}: {} test(s) of the study were begun here with other values; nothing was changed. Take another "
                  "folder with -o, or remove the folders of these tests in {}:{}",
                  folder.root().string(), changed, (folder.root() / "tests").string(), text));
}

JsonValue values_as_json(const std::vector<StudyValue>& values) {
  JsonList list;
  for (const StudyValue& v : values) {
    list.emplace_back(JsonObject{{"key", v.key},
                                 {"value", v.text},
                                 {"column", v.column},
                                 {"number", v.number ? JsonValue(*v.number) : JsonValue()}});
  }
  return list;
}

std::vector<StudyValue> values_from_json(const JsonObject& test) {
  std::vector<StudyValue> values;
  const JsonValue* field = find_field(test, "values");
  const auto* list = field == nullptr ? nullptr : std::get_if<JsonList>(&field->data);
  if (list == nullptr) return values;
  for (const JsonValue& item : *list) {
    const auto* object = std::get_if<JsonObject>(&item.data);
    if (object == nullptr) continue;
    StudyValue value{text_in(*object, "key"), text_in(*object, "value"), text_in(*object, "column"), std::nullopt};
    const JsonValue* number = find_field(*object, "number");
    if (number != nullptr && !std::holds_alternative<std::monostate>(number->data))
      value.number = number_in(*object, "number");
    values.push_back(std::move(value));
  }
  return values;
}

}  // namespace

std::vector<std::string> write_campaign(const CampaignFolder& folder, const Study& study, const CampaignPlan& plan) {
  refuse_folder_of_a_run(folder);
  refuse_changed_cases(folder, study);
  std::vector<std::string> notes;
  std::error_code ignored;
  if (std::filesystem::exists(folder.record(), ignored)) {
    std::set<std::string> names;
    for (const StudyTest& test : study.tests) names.insert(test.name);
    std::size_t left = 0;
    for (const RecordedTest& test : read_campaign(folder).tests) left += names.contains(test.name) ? 0 : 1;
    if (left > 0) {
      notes.push_back(fmt::format(
          "{} test(s) of an earlier call are no longer in the study; their folders stay as they are", left));
    }
  }
  make_folders(folder);
  JsonList tests;
  for (std::size_t k = 0; k < study.tests.size(); ++k) {
    const StudyTest& test = study.tests[k];
    const PlannedTest& planned = plan.tests[k];
    write_plain(folder.case_of(test.name), test.loaded.resolved_toml);
    tests.emplace_back(JsonObject{{"name", test.name},
                                  {"values", values_as_json(test.values)},
                                  {"group", planned.group},
                                  {"forecast_preparation_s", planned.preparation_time},
                                  {"forecast_test_s", planned.test_time},
                                  {"memory_MB", planned.memory / 1e6}});
  }
  write_plain(folder.study(), study.source_text);
  replace_file(folder.record(), json_text(JsonObject{{"format", k_record_format},
                                                     {"study", study.name},
                                                     {"version", k_version},
                                                     {"commit", k_commit},
                                                     {"tests", tests}}));
  return notes;
}

CampaignRecord read_campaign(const CampaignFolder& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder.record(), ignored)) {
    throw MissingFileError(fmt::format("{}: is no folder of a campaign, it has no {}; dem4grm campaign run makes one",
                                       folder.root().string(), folder.record().filename().string()));
  }
  const JsonObject record = read_json_file(folder.record());
  const JsonValue* field = find_field(record, "tests");
  const auto* list = field == nullptr ? nullptr : std::get_if<JsonList>(&field->data);
  if (list == nullptr || number_in(record, "format") != k_record_format) {
    throw IoError(
        fmt::format("{}: is damaged, or of another version of the program; dem4grm campaign run writes it again",
                    folder.record().string()));
  }
  CampaignRecord out{text_in(record, "study"), {}};
  for (const JsonValue& item : *list) {
    const auto* test = std::get_if<JsonObject>(&item.data);
    if (test == nullptr || text_in(*test, "name").empty()) continue;
    out.tests.push_back({text_in(*test, "name"), values_from_json(*test), text_in(*test, "group"),
                         number_in(*test, "forecast_preparation_s"), number_in(*test, "forecast_test_s"),
                         1e6 * number_in(*test, "memory_MB")});
  }
  return out;
}

}  // namespace dem
