// SPDX-License-Identifier: BSD-3-Clause
// Stored states of results.h5 as the micro-mechanics reads them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/results_file.hpp"

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

/// Contacts, bodies and rubber of one state, a group of /frames of any test; the box is empty where there is none. Throws
/// IoError that names what does not fit.
MicroState read_micro_state(const hdf5::Handle& frame);

/// The state nearest to `displacement` (m), or the last one when none is asked for. Throws MissingFileError, with the
/// states that there are, when none is within k_frame_reach.
const StoredFrame& choose_frame(const std::filesystem::path& path, const std::vector<StoredFrame>& frames,
                                std::optional<double> displacement);

/// How far a stored state may be from the displacement that was asked for, m.
inline constexpr double k_frame_reach = 0.05e-3;

}  // namespace dem
