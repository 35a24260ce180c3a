// SPDX-License-Identifier: BSD-3-Clause
// specimen.h5: a finished specimen before shear. Beside the readable state (results_file.hpp) it holds the complete one,
// from which any shear stage may start.
#pragma once

#include <filesystem>
#include <string>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

/// A specimen that was read.
struct StoredSpecimen {
  StateArchive state;
  std::string commit;         ///< of the program that made it
  std::string resolved_toml;  ///< of the case that it was made for
};

/// Adds the complete state to a file of results. Throws IoError.
void add_specimen_state(const std::filesystem::path& path, const StateArchive& state);

/// Would a specimen of the stored case (text of a resolved.toml) do for this one? False for a text that is no case of shear.
bool has_same_specimen(const std::string& stored_case, const DirectShearCase& test);

/// The specimen of a file, whatever case it is of. Throws as below.
StoredSpecimen read_specimen(const std::filesystem::path& path);

/// The specimen of a file, or of the file specimen.h5 in a folder, for run_direct_shear. Only name, shear (but not the
/// normal stress), record and servo.shear_speed_cap may differ from the case it was made for. Throws
/// MissingFileError, IoError for a file without a specimen, InputError that lists every key that differs.
StoredSpecimen read_specimen(const std::filesystem::path& path, const DirectShearCase& test);

}  // namespace dem
