// SPDX-License-Identifier: BSD-3-Clause
// A saved state as a group of an HDF5 file: one dataset for each entry.
#pragma once

#include <cstdint>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/results/hdf5_handle.hpp"

namespace dem {

inline constexpr std::int64_t k_state_format = 6;  ///< raised with every change of what is saved

/// Throws IoError.
void write_state(const hdf5::Handle& group, const StateArchive& state);

/// Throws IoError when the group is damaged.
StateArchive read_state(const hdf5::Handle& group);

}  // namespace dem
