// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/io/run_case.hpp"

#include <fmt/format.h>

#include <new>
#include <optional>

#include "dem4grm/io/checkpoint_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

RunOutcome outcome_of_complete(const std::filesystem::path& folder) {
  return {read_json_file(folder / file_name::k_summary), true};
}

JsonObject run_test(const TestCase& test, TestWriter& writer, StateArchive* from) {
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) {
    return writer.finish(run_direct_shear(*shear, writer, from));
  }
  return writer.finish(run_grain_compression(std::get<GrainCompressionCase>(test), writer));
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
  // A finished folder may be read-only and needs no lock.
  if (look_into(settings.folder, loaded) == FolderContent::complete) return outcome_of_complete(settings.folder);
  const OutputFolder folder(settings.folder, loaded);
  if (folder.found() == FolderContent::complete) return outcome_of_complete(settings.folder);
  std::optional<StoredCheckpoint> checkpoint;
  if (folder.has_checkpoint()) checkpoint = read_checkpoint(folder.file(file_name::k_checkpoint));
  TestWriter writer(folder, loaded, settings.threads, settings.links, checkpoint ? checkpoint->facts.wall_time : 0.0);
  if (!folder.lock_note().empty()) writer.note(folder.lock_note());
  if (folder.found() == FolderContent::unfinished) writer.note(note_about(checkpoint));
  try {
    return {run_test(loaded.test, writer, checkpoint ? &checkpoint->state : nullptr), false};
  } catch (const StoppedOnRequest& stop) {
    writer.give_up(RunState::stopped, stop.what());
    throw;
  } catch (const std::bad_alloc&) {
    writer.give_up(RunState::failed, "out of memory");
    throw;
  } catch (const std::exception& e) {
    writer.give_up(RunState::failed, e.what());
    throw;
  }
}

}  // namespace dem
