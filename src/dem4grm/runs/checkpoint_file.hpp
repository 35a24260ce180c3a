// SPDX-License-Identifier: BSD-3-Clause
// checkpoint.h5: the complete state of a running test, from which `run` goes on bit for bit. The one before it is kept as
// checkpoint.previous.h5; both are sealed (sealed_file.hpp), and the newest whole one is taken.
#pragma once

#include <filesystem>
#include <optional>
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
/// With `older` the old one, if it is whole, is kept under that name. Throws IoError, leaves the old ones and nothing else.
void write_checkpoint(const std::filesystem::path& path, const StateArchive& state, const CheckpointFacts& facts,
                      const std::filesystem::path& older = {});

/// Throws IoError when the file is damaged or of another format.
StoredCheckpoint read_checkpoint(const std::filesystem::path& path);

/// The newest checkpoint that can be read.
struct NewestCheckpoint {
  StoredCheckpoint stored;
  std::string note;  ///< why it is not the newest one that was written; empty when it is
};
/// Nothing when there is neither. Throws IoError with the reasons, and the way out, when none can be read.
std::optional<NewestCheckpoint> read_newest_checkpoint(const std::filesystem::path& path,
                                                       const std::filesystem::path& older);

}  // namespace dem
