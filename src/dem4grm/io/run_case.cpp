// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/io/run_case.hpp"

#include <new>

namespace dem {
namespace {

RunOutcome outcome_of_complete(const std::filesystem::path& folder) {
  return {read_json_file(folder / file_name::k_summary), true};
}

JsonObject run_test(const TestCase& test, TestWriter& writer) {
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) return writer.finish(run_direct_shear(*shear, writer));
  return writer.finish(run_grain_compression(std::get<GrainCompressionCase>(test), writer));
}

}  // namespace

RunOutcome run_case(const LoadedCase& loaded, const RunSettings& settings) {
  // A finished folder may be read-only and needs no lock.
  if (look_into(settings.folder, loaded) == FolderContent::complete) return outcome_of_complete(settings.folder);
  const OutputFolder folder(settings.folder, loaded);
  if (folder.found() == FolderContent::complete) return outcome_of_complete(settings.folder);
  TestWriter writer(folder, loaded, settings.threads, settings.links);
  if (!folder.lock_note().empty()) writer.note(folder.lock_note());
  if (folder.found() == FolderContent::unfinished) {
    writer.note("the folder holds an unfinished run of this case; there is no checkpoint yet, so it starts anew");
  }
  try {
    return {run_test(loaded.test, writer), false};
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
