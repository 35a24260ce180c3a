// SPDX-License-Identifier: BSD-3-Clause
// A stored state of a test, from which another test starts in a folder of its own. What it is read from is never touched.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/lab/branched_state.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

struct BranchSource {
  std::filesystem::path file;  ///< absolute
  std::string note;            ///< why it is not the newest state that was written; empty when it is
  DirectShearCase test;        ///< whose state it is
  std::string resolved_toml;   ///< the same as text
  std::string commit;          ///< of the program that wrote it
  double wall_time = 0.0;      ///< s, that the test had taken by then
  StateArchive state;
  BranchPoint point;

  [[nodiscard]] std::filesystem::path folder() const { return file.parent_path(); }
};

/// A checkpoint.h5, checkpoint.previous.h5, end_state.h5 or specimen.h5, or a folder: the end of a finished test, else the newest
/// whole checkpoint. Throws MissingFileError, or IoError for a file that is damaged or no state of a direct shear test.
BranchSource read_branch_source(const std::filesystem::path& given);

/// The case of the source with these changes; case.toml of its folder will be the complete case. Throws InputError.
LoadedCase branched_case(const BranchSource& source, std::span<const Override> overrides);

/// "runs/<name>-<what changes>".
std::filesystem::path default_branch_folder(const BranchSource& source, const LoadedCase& loaded);

/// What branch.json and summary.json say about the origin of a test.
JsonObject branch_origin(const BranchSource& source, const DirectShearCase& test);

/// The same in words: the file and the place, "shear, 0.512 mm, state hash ...", and what changes.
std::string branch_words(const JsonObject& origin);
std::string branch_place_words(const JsonObject& origin);
std::string branch_changes_words(const JsonObject& origin);

/// Puts into the new folder the state that the test starts from, and what the source recorded before it. The checkpoint comes last.
/// Throws MissingFileError or IoError.
void plant_branch(const BranchSource& source, const LoadedCase& loaded, const std::filesystem::path& folder);

/// Refuses a folder that holds a test of this case which is no branch of that source: throws Error with ExitCode::usage.
void check_same_branch(const std::filesystem::path& folder, const BranchSource& source);

}  // namespace dem
