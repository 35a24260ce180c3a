// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/run_case.hpp"

#include <fmt/format.h>

#include <new>
#include <optional>

#include "dem4grm/results/specimen_file.hpp"
#include "dem4grm/runs/branch_rules.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

/// What a folder says that holds all that is wanted of it.
std::optional<RunOutcome> outcome_of_complete(const RunSettings& settings, FolderContent content) {
  if (content == FolderContent::complete)
    return RunOutcome{read_json_file(settings.folder / file_name::k_summary), true};
  const std::filesystem::path specimen = settings.folder / file_name::k_specimen_summary;
  const bool is_ready = content == FolderContent::unfinished && std::filesystem::exists(specimen);
  if (!settings.links.is_specimen_only || !is_ready) return std::nullopt;
  return RunOutcome{read_json_file(specimen), true};
}

JsonObject run_test(const TestCase& test, TestWriter& writer, StateArchive* from) {
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) {
    const DirectShearResult result = run_direct_shear(*shear, writer, from);
    return writer.wants_shear() ? writer.finish(result) : writer.finish_specimen(result);
  }
  return writer.finish(run_grain_compression(std::get<GrainCompressionCase>(test), writer));
}

/// Throws Error with ExitCode::usage when a test without a specimen is asked for one.
void check_settings(const LoadedCase& loaded, const RunSettings& settings) {
  if (std::holds_alternative<DirectShearCase>(loaded.test)) return;
  if (settings.links.is_specimen_only || !settings.specimen.empty() || !settings.links.store.empty()) {
    throw Error(ExitCode::usage,
                fmt::format("{} is no direct shear test: it has no specimen to prepare, to start from or to keep",
                            case_name(loaded.test)));
  }
}

/// Numbers of grains that the user gives and that no specimen can be made of are refused before the folder is made.
void check_grain_numbers(const LoadedCase& loaded) {
  const auto* test = std::get_if<DirectShearCase>(&loaded.test);
  if (test == nullptr || (!test->specimen.gravel_clumps && !test->specimen.rubber_grains)) return;
  check_fills_box(draw_grains(test->specimen, test->box, test->rubber.density, test->rubber_solid_density, test->seed),
                  test->specimen, test->box);
}

bool has_checkpoint(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / file_name::k_checkpoint, ignored) ||
         std::filesystem::exists(folder / file_name::k_previous_checkpoint, ignored) ||
         std::filesystem::exists(folder / file_name::k_end_state, ignored);
}

/// The specimen that the user names, when the run begins at its beginning.
std::optional<StoredSpecimen> chosen_specimen(const LoadedCase& loaded, const RunSettings& settings) {
  if (settings.specimen.empty()) return std::nullopt;
  return read_specimen(settings.specimen, std::get<DirectShearCase>(loaded.test));
}

/// Before anything is written: whether the test may start from that state, where its folder does not go on by itself.
void check_branch(const LoadedCase& loaded, const RunSettings& settings, FolderContent content) {
  const BranchSource& source = *settings.from;
  std::error_code ignored;
  if (std::filesystem::weakly_canonical(settings.folder, ignored) == source.folder()) {
    throw Error(ExitCode::usage,
                fmt::format("{} is the folder that the test is to start from; choose another one with -o",
                            settings.folder.string()));
  }
  const bool is_begun =
      content == FolderContent::complete || content == FolderContent::shorter || content == FolderContent::unfinished;
  if (is_begun) check_same_branch(settings.folder, source);
  const bool goes_on = is_begun && (content == FolderContent::complete || has_checkpoint(settings.folder));
  if (content == FolderContent::other_case || goes_on) return;
  const auto* test = std::get_if<DirectShearCase>(&loaded.test);
  const std::string problem = test == nullptr ? fmt::format("{} is no direct shear test; {} is a state of one",
                                                            case_name(loaded.test), source.file.string())
                                              : branch_problem(source.point, source.test, *test, source.file.string());
  if (!problem.empty()) throw InputError(problem);
}

std::string note_about(const BranchSource& source, const JsonObject& origin) {
  std::string text = fmt::format("branches from {}, with {}", branch_words(origin), branch_changes_words(origin));
  if (source.commit != k_commit) {
    text += fmt::format("; it was written by commit {}, so results may not be those of one program", source.commit);
  }
  return text;
}

std::string note_about(const StoredSpecimen& specimen, const std::filesystem::path& path) {
  std::string text = fmt::format("starts from the specimen of {}", path.string());
  if (specimen.commit != k_commit) {
    text += fmt::format("; it was made by commit {}, so results may not be those of one program", specimen.commit);
  }
  return text;
}

JsonObject branch_origin_of(const LoadedCase& loaded, const RunSettings& settings) {
  const auto* test = std::get_if<DirectShearCase>(&loaded.test);
  return settings.from == nullptr || test == nullptr ? JsonObject() : branch_origin(*settings.from, *test);
}

OutputFolder open_folder(const LoadedCase& loaded, const RunSettings& settings, const JsonObject& origin) {
  if (settings.from == nullptr) return OutputFolder(settings.folder, loaded, settings.job);
  return OutputFolder(
      settings.folder, loaded, settings.job,
      [&](const std::filesystem::path& folder) { plant_branch(*settings.from, loaded, folder); }, json_text(origin));
}

std::string note_about(const std::optional<StoredCheckpoint>& checkpoint) {
  if (!checkpoint) return "the folder holds an unfinished run of this case without a checkpoint; it starts anew";
  std::string text =
      fmt::format("goes on from the checkpoint after {:.0f} s of wall time", checkpoint->facts.wall_time);
  if (checkpoint->facts.commit != k_commit) {
    text += fmt::format("; it was written by commit {}, so results may not be those of one program",
                        checkpoint->facts.commit);
  }
  return text;
}

}  // namespace

RunOutcome run_case(const LoadedCase& loaded, const RunSettings& settings) {
  check_settings(loaded, settings);
  const FolderContent content = look_into(settings.folder, loaded);
  if (settings.from != nullptr) check_branch(loaded, settings, content);
  // A finished folder may be read-only and needs no lock.
  if (auto outcome = outcome_of_complete(settings, content)) return *outcome;
  // Before anything is written: a specimen of another case must not leave a folder behind.
  std::optional<StoredSpecimen> start = chosen_specimen(loaded, settings);
  check_grain_numbers(loaded);
  const JsonObject origin = branch_origin_of(loaded, settings);
  const OutputFolder folder = open_folder(loaded, settings, origin);
  if (auto outcome = outcome_of_complete(settings, folder.found())) return *outcome;
  std::optional<StoredCheckpoint> checkpoint;
  std::string newer_is_damaged;
  if (folder.has_checkpoint()) {
    std::optional<NewestCheckpoint> newest =
        read_newest_checkpoint(folder.file(file_name::k_checkpoint), folder.file(file_name::k_previous_checkpoint));
    if (newest) {
      checkpoint = std::move(newest->stored);
      newer_is_damaged = std::move(newest->note);
    }
  }
  // A named specimen saves what is left of a preparation; shear that has begun goes on.
  if (start && checkpoint && !checkpoint->state.has_group("shear")) checkpoint.reset();
  StateArchive* from = checkpoint ? &checkpoint->state : start ? &start->state : nullptr;
  TestWriter writer(folder, loaded, settings.threads, settings.links, checkpoint ? checkpoint->facts.wall_time : 0.0);
  if (!folder.lock_note().empty()) writer.note(folder.lock_note());
  if (!newer_is_damaged.empty()) writer.warning(newer_is_damaged);
  const bool starts_from_specimen = start && !checkpoint;
  if (starts_from_specimen) writer.note(note_about(*start, settings.specimen));
  if (start && checkpoint) writer.note("shear has begun already; the specimen that was named is not used");
  if (folder.is_planted()) {
    if (!settings.from->note.empty()) writer.warning(settings.from->note);
    writer.note(note_about(*settings.from, origin));
    settings.from->state = {};
  }
  if (!starts_from_specimen && !folder.is_planted() && folder.found() == FolderContent::unfinished)
    writer.note(note_about(checkpoint));
  if (folder.found() == FolderContent::shorter) {
    writer.note("prolongs the test that the folder holds; " + note_about(checkpoint));
  }
  try {
    return {run_test(loaded.test, writer, from), false};
  } catch (const StoppedOnRequest& stop) {
    writer.give_up(RunState::stopped, stop.what(), stop.code());
    throw;
  } catch (const std::bad_alloc&) {
    writer.give_up(RunState::failed, "out of memory", ExitCode::memory);
    throw;
  } catch (const Error& e) {
    writer.give_up(RunState::failed, e.what(), e.code());
    throw;
  } catch (const std::exception& e) {
    writer.give_up(RunState::failed, e.what(), ExitCode::internal);
    throw;
  }
}

}  // namespace dem
