// SPDX-License-Identifier: BSD-3-Clause
// results.h5 and specimen.h5: full states and tables in one layout (docs/reference/output-folder.md).
//
// The file is opened for each addition and closed after it, so that it is whole between two of them: other programs
// can read it while the test runs, and a killed run leaves the frames that it had finished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dem4grm/lab/observer.hpp"
#include "dem4grm/results/table_file.hpp"

namespace dem {

/// What a file of results says about its origin. Nothing in it depends on the time or the machine.
struct ResultsOrigin {
  std::string test;  ///< "direct_shear", "grain_compression"
  std::string case_name;
  std::string case_text;  ///< as it was read
  std::string resolved_toml;
};

class ResultsFile {
 public:
  /// A new file with /meta and an empty /frames; an old one is replaced. Throws IoError.
  ResultsFile(std::filesystem::path path, const ResultsOrigin& origin);

  /// A file of that name reduced to /meta and the frames with these numbers, for a run that goes on. Throws IoError when
  /// it is damaged or lacks one of them.
  ResultsFile(std::filesystem::path path, const ResultsOrigin& origin, std::span<const FrameInfo> kept);

  /// Adds /frames/NNNN. Throws IoError.
  void add_frame(const Simulation& state, const FrameInfo& info);
  /// Adds a group with one dataset for each column. Throws IoError.
  void add_table(const std::string& group, const TableFile& table);

 private:
  std::filesystem::path path_;
};

/// What `info` shows of one stored state.
struct StoredFrame {
  std::string name;           ///< "0003"
  double displacement = 0.0;  ///< m
  std::string state_hash;
  std::size_t balls = 0, clumps = 0, rubber_grains = 0, contacts = 0, bonds = 0;
};

/// What `info` shows of a file of results.
struct StoredResults {
  std::string test, case_name, version, commit;
  std::vector<StoredFrame> frames;
  std::size_t table_rows = 0;  ///< of /shear or /compression
};

/// results.h5 of a folder, or the file itself. Throws MissingFileError for a folder without it.
std::filesystem::path results_in(const std::filesystem::path& path);

/// Opens a file and reads its outline. Throws MissingFileError, or IoError when it is damaged or of another kind.
StoredResults read_outline(const std::filesystem::path& path);

}  // namespace dem
