// SPDX-License-Identifier: BSD-3-Clause
// checkpoint.h5: the complete state of a running test, from which `run` goes on bit for bit.
#pragma once

#include <filesystem>
#include <string>

#include "dem4grm/core/state_archive.hpp"

namespace dem {

/// What a checkpoint says beside the state.
struct CheckpointFacts {
  std::string resolved_toml;  ///< the case that it belongs to
  double wall_time = 0.0;     ///< s, of the run so far, all its parts
  std::string commit;         ///< of the program that wrote it; set by write_checkpoint
};

/// A checkpoint that was read.
struct StoredCheckpoint {
  CheckpointFacts facts;
  StateArchive state;
};

/// Written beside the old one, brought to the disk, then renamed: a reader finds the old one or the new one, whole.
/// Throws IoError and leaves the old one.
void write_checkpoint(const std::filesystem::path& path, const StateArchive& state, const CheckpointFacts& facts);

/// Throws IoError when the file is damaged or of another format.
StoredCheckpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace dem
