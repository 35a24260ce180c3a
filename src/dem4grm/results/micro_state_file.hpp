// SPDX-License-Identifier: BSD-3-Clause
// Stored states of results.h5 as the micro-mechanics reads them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "dem4grm/micro/analysis.hpp"

namespace dem {

/// A state with its place in the file.
struct StoredMicroState {
  std::string name;           ///< "0003"
  double displacement = 0.0;  ///< m
  std::string state_hash;
  MicroState state;
};

/// The state nearest to `displacement` (m), or the last one when none is asked for. It must be within k_frame_reach.
/// The numbers of its analysis have the bits of those of the simulation that wrote it.
/// Throws MissingFileError when there is no such file or no such state (the message lists those that there are), IoError
/// when the file is damaged, of another kind, or from a build whose states did not hold what an analysis needs.
StoredMicroState read_micro_state(const std::filesystem::path& results, std::optional<double> displacement);

/// How far a stored state may be from the displacement that was asked for, m.
inline constexpr double k_frame_reach = 0.05e-3;

}  // namespace dem
