// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/output_folder.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dem4grm/case_file/case_differences.hpp"
#include "dem4grm/lab/prolongation.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/specimen_file.hpp"

namespace dem {
namespace {

/// What a run writes anew; the log is kept.
constexpr std::array k_results_of_run{file_name::k_summary,
                                      file_name::k_status,
                                      file_name::k_shear,
                                      file_name::k_grain,
                                      file_name::k_results,
                                      file_name::k_specimen,
                                      file_name::k_checkpoint,
                                      file_name::k_specimen_summary,
                                      file_name::k_micro,
                                      file_name::k_walls,
                                      file_name::k_previous_checkpoint,
                                      file_name::k_end_state,
                                      file_name::k_profiles};

std::optional<std::string> content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

bool is_there(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(path, error);
  return status.type() != std::filesystem::file_type::not_found && status.type() != std::filesystem::file_type::none;
}

/// The case of a text of resolved.toml when it is that of `wanted` but for a smaller displacement; else nothing.
std::optional<DirectShearCase> shorter_case(const std::string& stored, const LoadedCase& wanted) {
  const auto* longer = std::get_if<DirectShearCase>(&wanted.test);
  if (longer == nullptr) return std::nullopt;
  try {
    const LoadedCase loaded = parse_case(stored, file_name::k_resolved);
    const auto* shorter = std::get_if<DirectShearCase>(&loaded.test);
    if (shorter == nullptr || shorter->shear.displacement >= longer->shear.displacement) return std::nullopt;
    DirectShearCase same = *shorter;
    same.shear.displacement = longer->shear.displacement;
    return resolved_toml(same) == wanted.resolved_toml ? std::optional(*shorter) : std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool has_state_to_go_on_from(const std::filesystem::path& folder) {
  return is_there(folder / file_name::k_end_state) || is_there(folder / file_name::k_checkpoint) ||
         is_there(folder / file_name::k_previous_checkpoint);
}

/// Why a shorter test in a folder cannot be prolonged; empty for a test that can be or that is another.
std::string why_not_prolonged(const std::filesystem::path& path, const std::string& stored, const LoadedCase& loaded) {
  const std::optional<DirectShearCase> shorter = shorter_case(stored, loaded);
  if (!shorter) return {};
  const std::string problem = prolongation_problem(*shorter, std::get<DirectShearCase>(loaded.test));
  if (!problem.empty()) return ". It cannot be prolonged: " + problem;
  if (has_state_to_go_on_from(path)) return {};
  return fmt::format(". It cannot be prolonged, since its {} is not there", file_name::k_end_state);
}

/// What is different about the case in the folder, and what a user who meant the same test would do.
std::string other_case_message(const std::filesystem::path& path, const LoadedCase& loaded) {
  const std::string way_out = "choose another folder with -o, or remove this one";
  const std::optional<std::string> stored = content_of(path / file_name::k_resolved);
  if (!stored) {
    return fmt::format(
        "{} holds another case, or files of a run whose {} is missing, so that nobody can tell which case "
        "they belong to; {}",
        path.string(), file_name::k_resolved, way_out);
  }
  std::vector<std::string> differences = case_differences(*stored, loaded.resolved_toml);
  constexpr std::size_t k_most = 12;
  if (differences.size() > k_most) {
    const std::size_t more = differences.size() - k_most;
    differences.resize(k_most);
    differences.push_back(fmt::format("and {} more lines", more));
  }
  const auto* shear = std::get_if<DirectShearCase>(&loaded.test);
  const bool has_specimen =
      shear != nullptr && is_there(path / file_name::k_specimen) && has_same_specimen(*stored, *shear);
  return fmt::format(
      "{} holds another case:\n  {}\n{}{}", path.string(), fmt::join(differences, "\n  "), way_out,
      why_not_prolonged(path, *stored, loaded) +
          (has_specimen
               ? fmt::format(". Its specimen would do for this case: -o NEW_FOLDER --specimen {}", path.string())
               : ""));
}

[[noreturn]] void throw_other_case(const std::filesystem::path& path, const LoadedCase& loaded) {
  throw Error(ExitCode::usage, other_case_message(path, loaded));
}

[[noreturn]] void throw_lost_branch(const std::filesystem::path& path) {
  throw Error(
      ExitCode::usage,
      fmt::format("{} is for a test that starts from {}, and has no checkpoint of it: run it with --from again, or "
                  "remove {} to start anew",
                  path.string(), text_in(read_json_file(path / file_name::k_branch), "source"), file_name::k_branch));
}

void make_folder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", path.string(), error.message()));
}

}  // namespace

FolderContent look_into(const std::filesystem::path& folder, const LoadedCase& loaded) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (status.type() == std::filesystem::file_type::not_found) return FolderContent::nothing;
  if (status.type() != std::filesystem::file_type::directory) {
    throw IoError(fmt::format("{}: is no folder{}", folder.string(), error ? ": " + error.message() : ""));
  }
  const std::optional<std::string> resolved = content_of(folder / file_name::k_resolved);
  if (resolved) {
    if (*resolved != loaded.resolved_toml) {
      const std::optional<DirectShearCase> shorter = shorter_case(*resolved, loaded);
      const bool goes_on = shorter && has_state_to_go_on_from(folder) &&
                           prolongation_problem(*shorter, std::get<DirectShearCase>(loaded.test)).empty();
      return goes_on ? FolderContent::shorter : FolderContent::other_case;
    }
    return is_there(folder / file_name::k_summary) ? FolderContent::complete : FolderContent::unfinished;
  }
  // Files of our names without a case beside them are not ours to overwrite; the case itself may lie there.
  for (const char* name : k_results_of_run) {
    if (is_there(folder / name)) return FolderContent::other_case;
  }
  const std::optional<std::string> source = content_of(folder / file_name::k_case);
  return !source || *source == loaded.source_text ? FolderContent::nothing : FolderContent::other_case;
}

std::filesystem::path default_folder(const std::string& case_name) {
  std::string name = case_name.empty() ? "case" : case_name;
  for (char& c : name) {
    const bool is_usual = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                          c == '_' || c == '.' || c == '+';
    if (!is_usual) c = '_';
  }
  if (name.front() == '.') name.front() = '_';
  return std::filesystem::path("runs") / name;
}

namespace {

/// What killed processes left half written; the folder is locked, so nobody is at work on them.
void remove_drafts(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_ours = std::any_of(k_results_of_run.begin(), k_results_of_run.end(),
                                     [&](const char* ours) { return name == std::string(ours) + ".tmp"; });
    std::error_code ignored;
    if (is_ours) std::filesystem::remove(entry->path(), ignored);
  }
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path path, const LoadedCase& loaded, const std::string& job,
                           const std::function<void(const std::filesystem::path&)>& plant, const std::string& origin)
    : path_(std::move(path)) {
  if (look_into(path_, loaded) == FolderContent::other_case) throw_other_case(path_, loaded);
  make_folder(path_);
  lock_ = std::make_unique<FolderLock>(path_, job);
  remove_drafts(path_);
  // Another process may have come and gone between the first look and the lock.
  found_ = look_into(path_, loaded);
  if (found_ == FolderContent::other_case) throw_other_case(path_, loaded);
  if (found_ == FolderContent::complete) return;
  if (found_ == FolderContent::shorter) become_longer(loaded);
  has_checkpoint_ = (found_ == FolderContent::unfinished || found_ == FolderContent::shorter) &&
                    (is_there(file(file_name::k_checkpoint)) || is_there(file(file_name::k_previous_checkpoint)));
  if (has_checkpoint_) return;
  if (!plant && is_there(file(file_name::k_branch))) throw_lost_branch(path_);
  for (const char* name : k_results_of_run) {
    std::error_code error;
    std::filesystem::remove(file(name), error);
    if (error) throw IoError(fmt::format("{}: cannot be removed: {}", file(name).string(), error.message()));
  }
  // The origin first: whoever comes after a process that died here must not begin such a test at its beginning.
  if (plant) replace_file(file(file_name::k_branch), origin);
  replace_file(file(file_name::k_resolved), loaded.resolved_toml);
  replace_file(file(file_name::k_case), loaded.source_text);
  if (!plant) return;
  plant(path_);
  has_checkpoint_ = is_planted_ = true;
}

void OutputFolder::become_longer(const LoadedCase& loaded) {
  // In this order, so that a process that dies on the way leaves the finished shorter test, or one of the two that goes on from its
  // end, but never files of one beside the case of the other.
  std::error_code error;
  if (is_there(file(file_name::k_end_state)) && is_there(file(file_name::k_summary))) {
    std::filesystem::rename(file(file_name::k_end_state), file(file_name::k_checkpoint), error);
  }
  if (!error) std::filesystem::remove(file(file_name::k_summary), error);
  if (error) throw IoError(fmt::format("{}: the test cannot be prolonged: {}", path_.string(), error.message()));
  replace_file(file(file_name::k_resolved), loaded.resolved_toml);
  replace_file(file(file_name::k_case), loaded.source_text);
}

}  // namespace dem
