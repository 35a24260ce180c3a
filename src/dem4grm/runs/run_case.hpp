// SPDX-License-Identifier: BSD-3-Clause
// From a loaded case to a filled output folder.
#pragma once

#include <filesystem>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/runs/branch_source.hpp"
#include "dem4grm/runs/test_writer.hpp"

namespace dem {

struct RunSettings {
  std::filesystem::path folder;
  int threads = 1;  ///< for the record; the caller sets the number for OpenMP
  RunLinks links;
  std::string job{};                 ///< batch job of this process, as for FolderLock
  std::filesystem::path specimen{};  ///< file or folder of a finished specimen to start from; empty: prepare one
  BranchSource* from = nullptr;      ///< state of another test to start from, given up once the folder has it; or null
};

struct RunOutcome {
  JsonObject summary;         ///< as in summary.json
  bool was_complete = false;  ///< nothing was computed, the folder held the finished run
};

/// Runs the test, or reads the summary when the folder holds its finished run (or, when only the specimen is wanted, its
/// finished specimen). Notes about what the folder held go to
/// the listener. A run that ends early leaves its rows and states, status "stopped" or "failed", and a free folder; the
/// error is thrown on: StoppedOnRequest, FolderInUseError, IoError, PhysicsError, InputError, Error with
/// ExitCode::usage for a folder that holds another case. With `from`, InputError that lists every key that cannot differ from the
/// case of that state.
RunOutcome run_case(const LoadedCase& loaded, const RunSettings& settings);

}  // namespace dem
