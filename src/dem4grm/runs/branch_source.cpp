// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/branch_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/specimen_file.hpp"
#include "dem4grm/runs/branch_rules.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/runs/output_folder.hpp"

namespace dem {
namespace {

bool is_present(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

void take(BranchSource& source, StoredCheckpoint stored) {
  source.resolved_toml = std::move(stored.facts.resolved_toml);
  source.commit = std::move(stored.facts.commit);
  source.wall_time = stored.facts.wall_time;
  source.state = std::move(stored.state);
}

void read_file(BranchSource& source) {
  if (source.file.filename() != file_name::k_specimen) {
    take(source, read_checkpoint(source.file));
    return;
  }
  StoredSpecimen stored = read_specimen(source.file);
  source.resolved_toml = std::move(stored.resolved_toml);
  source.commit = std::move(stored.commit);
  source.state = std::move(stored.state);
}

void read_folder(BranchSource& source, const std::filesystem::path& folder) {
  if (is_present(folder / file_name::k_summary)) {
    source.file = folder / file_name::k_end_state;
    if (!is_present(source.file)) {
      throw MissingFileError(
          fmt::format("{}: the test is finished, but its {} is not there; its {} may do, from which shear begins",
                      folder.string(), file_name::k_end_state, file_name::k_specimen));
    }
    read_file(source);
    return;
  }
  const std::filesystem::path newest = folder / file_name::k_checkpoint,
                              older = folder / file_name::k_previous_checkpoint;
  std::optional<NewestCheckpoint> found = read_newest_checkpoint(newest, older);
  if (!found) {
    throw MissingFileError(
        fmt::format("{}: holds no state to start from; a run writes its first checkpoint after ten minutes or when its "
                    "first stage is done (kill -USR1 asks for one)",
                    folder.string()));
  }
  source.file = found->note.empty() && is_present(newest) ? newest : older;
  source.note = std::move(found->note);
  take(source, std::move(found->stored));
}

/// Whole even of a running source, whose files are replaced as a whole.
void copy_over(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code ignored;
  std::filesystem::remove(to, ignored);
  copy_to_new_file(from, to);
}

/// Stored states of shear are in results.h5 alone, so what was recorded before the branch is taken from there.
void copy_record(const BranchSource& source, const LoadedCase& loaded, const std::filesystem::path& folder) {
  const std::filesystem::path results = source.folder() / file_name::k_results,
                              specimen = source.folder() / file_name::k_specimen;
  if (!is_present(results)) {
    throw MissingFileError(fmt::format(
        "{}: is not there; it holds the {} stored states of shear up to the branch, which the new test keeps",
        results.string(), source.point.frames.size()));
  }
  const ResultsOrigin origin{"direct_shear", case_name(loaded.test), loaded.source_text, loaded.resolved_toml};
  const std::filesystem::path target = folder / file_name::k_results;
  copy_over(results, target);
  const ResultsFile only_past(target, origin, source.point.frames);
  if (is_present(specimen)) copy_over(specimen, folder / file_name::k_specimen);
}

std::string value_or_dash(const JsonObject& object, const char* name) {
  const std::string text = text_in(object, name);
  return text.empty() ? "-" : text;
}

}  // namespace

BranchSource read_branch_source(const std::filesystem::path& given) {
  if (!is_present(given)) throw MissingFileError(fmt::format("{}: no such file or folder", given.string()));
  BranchSource source;
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::weakly_canonical(given);
  if (std::filesystem::is_directory(path, ignored)) {
    read_folder(source, path);
  } else {
    source.file = path;
    read_file(source);
  }
  const std::string shown = source.file.string();
  const LoadedCase loaded = parse_case(source.resolved_toml, shown);
  const auto* test = std::get_if<DirectShearCase>(&loaded.test);
  if (test == nullptr) throw IoError(fmt::format("{}: holds no state of a direct shear test", shown));
  source.test = *test;
  try {
    source.point = branch_point_of(source.state, source.test);
  } catch (const IoError& e) {
    throw IoError(fmt::format("{}: {}", shown, e.what()));
  }
  return source;
}

LoadedCase branched_case(const BranchSource& source, std::span<const Override> overrides) {
  LoadedCase loaded = parse_case(source.resolved_toml, source.file, overrides);
  // What was unusual about the source was said when it was run.
  const std::vector<std::string> said = parse_case(source.resolved_toml, source.file).warnings;
  std::erase_if(loaded.warnings,
                [&](const std::string& text) { return std::find(said.begin(), said.end(), text) != said.end(); });
  const JsonObject origin = branch_origin(source, std::get<DirectShearCase>(loaded.test));
  loaded.source_text = fmt::format("# Branch of {}\n# with {}\n{}", branch_words(origin), branch_changes_words(origin),
                                   loaded.resolved_toml);
  return loaded;
}

std::filesystem::path default_branch_folder(const BranchSource& source, const LoadedCase& loaded) {
  constexpr std::size_t k_longest = 100;
  std::string name = case_name(loaded.test);
  const auto* test = std::get_if<DirectShearCase>(&loaded.test);
  if (name != source.test.name || test == nullptr) return default_folder(name);
  const std::vector<KeyChange> changes = case_changes(source.test, *test);
  for (const KeyChange& change : changes) {
    std::string value = change.after;
    std::erase_if(value, [](char c) { return c == ' ' || c == '[' || c == ']' || c == '"'; });
    name += fmt::format("-{}-{}", change.key.substr(change.key.rfind('.') + 1), value);
  }
  if (changes.empty()) name += "-again";
  return default_folder(name.substr(0, k_longest));
}

JsonObject branch_origin(const BranchSource& source, const DirectShearCase& test) {
  JsonList changes;
  for (const KeyChange& c : case_changes(source.test, test)) {
    changes.emplace_back(JsonObject{{"key", c.key}, {"from", c.before}, {"to", c.after}});
  }
  const bool is_in_shear = source.point.stage == BranchStage::shear;
  JsonObject origin{{"source", source.file.string()},
                    {"case", source.test.name},
                    {"commit", source.commit},
                    {"stage", stage_words(source.point.stage)},
                    {"displacement_mm", is_in_shear ? JsonValue(source.point.displacement * 1e3) : JsonValue()},
                    {"state_hash", source.point.state_hash.empty() ? JsonValue() : JsonValue(source.point.state_hash)},
                    {"changes", std::move(changes)}};
  // A branch of a branch tells the whole line.
  const std::filesystem::path earlier = source.folder() / file_name::k_branch;
  if (is_present(earlier)) origin.push_back({"source_branch", read_json_file(earlier)});
  return origin;
}

std::string branch_place_words(const JsonObject& origin) {
  const std::string at =
      has_number(origin, "displacement_mm") ? fmt::format(", {:.6g} mm", number_in(origin, "displacement_mm")) : "";
  return fmt::format("{}{}, state hash {}", text_in(origin, "stage"), at, value_or_dash(origin, "state_hash"));
}

std::string branch_words(const JsonObject& origin) {
  return fmt::format("{} ({})", text_in(origin, "source"), branch_place_words(origin));
}

std::string branch_changes_words(const JsonObject& origin) {
  const JsonValue* changes = find_field(origin, "changes");
  const auto* list = changes == nullptr ? nullptr : std::get_if<JsonList>(&changes->data);
  std::string text;
  if (list != nullptr) {
    for (const JsonValue& one : *list) {
      const auto* change = std::get_if<JsonObject>(&one.data);
      if (change == nullptr) continue;
      text += fmt::format("{}{} {} -> {}", text.empty() ? "" : ", ", text_in(*change, "key"), text_in(*change, "from"),
                          text_in(*change, "to"));
    }
  }
  return text.empty() ? "no changes" : text;
}

void plant_branch(const BranchSource& source, const LoadedCase& loaded, const std::filesystem::path& folder) {
  const auto& test = std::get<DirectShearCase>(loaded.test);
  if (source.point.stage == BranchStage::shear) copy_record(source, loaded, folder);
  write_checkpoint(folder / file_name::k_checkpoint, branched_state(source.state, source.point, source.test, test),
                   {loaded.resolved_toml, source.wall_time, {}});
}

void check_same_branch(const std::filesystem::path& folder, const BranchSource& source) {
  const std::filesystem::path file = folder / file_name::k_branch;
  const std::string recorded = is_present(file) ? text_in(read_json_file(file), "source") : std::string();
  if (!recorded.empty() && std::filesystem::path(recorded).parent_path() == source.folder()) return;
  throw Error(ExitCode::usage,
              fmt::format("{} holds a test of this case that {}; choose another folder with -o", folder.string(),
                          recorded.empty() ? "started anew" : "was branched from " + recorded));
}

}  // namespace dem
