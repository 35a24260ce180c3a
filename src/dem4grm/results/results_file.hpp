// SPDX-License-Identifier: BSD-3-Clause
// results.h5 and specimen.h5: full states and tables in one layout (docs/reference/output-folder.md).
//
// Each addition is made to a copy beside the file, which is sealed (sealed_file.hpp), brought to the disk and then takes its name. So the
// file is whole at any time: other programs can read it while the test runs, and a killed run or a power cut leaves the states that
// were finished. A copy costs little beside the minutes between two states (docs/decisions/0032-sealed-results.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "dem4grm/lab/observer.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/table_file.hpp"

namespace dem {

/// What a file of results says about its origin. Nothing in it depends on the time or the machine.
struct ResultsOrigin {
  std::string test;  ///< "direct_shear", "grain_compression"
  std::string case_name;
  std::string case_text;  ///< as it was read
  std::string resolved_toml;
};

struct NamedTable {
  std::string group;  ///< "shear", "walls", "micro", "profiles", "compression"
  const TableFile* table = nullptr;
};

/// Changes a copy of a file, seals it and lets it take the name of the file. Throws IoError, which names the file, and leaves the file.
void change_sealed_file(const std::filesystem::path& path, const std::function<void(const hdf5::Handle&)>& change);

class ResultsFile {
 public:
  /// A new file with /meta and an empty /frames; an old one is replaced. Throws IoError.
  ResultsFile(std::filesystem::path path, const ResultsOrigin& origin);

  /// A file of that name reduced to /meta and the frames with these numbers, for a run that goes on. Throws IoError when
  /// it is damaged or lacks one of them.
  ResultsFile(std::filesystem::path path, const ResultsOrigin& origin, std::span<const FrameInfo> kept);

  /// Adds /frames/NNNN. Throws IoError.
  void add_frame(const Simulation& state, const FrameInfo& info);
  /// Adds for each table a group with one dataset for each column. Throws IoError.
  void add_tables(std::span<const NamedTable> tables);

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

/// Opens a file whose seal fits, or one without a seal. Throws IoError when it is damaged.
hdf5::Handle open_results(const std::filesystem::path& path);

/// Opens a file, whether its seal fits or not, and reads its outline. Throws MissingFileError, or IoError when it is damaged or of another
/// kind.
StoredResults read_outline(const std::filesystem::path& path);

}  // namespace dem
