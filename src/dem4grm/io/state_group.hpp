// SPDX-License-Identifier: BSD-3-Clause
// A saved state as a group of an HDF5 file: one dataset for each entry.
#pragma once

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/io/hdf5_handle.hpp"

namespace dem {

/// Throws IoError.
void write_state(const hdf5::Handle& group, const StateArchive& state);

/// Throws IoError when the group is damaged.
StateArchive read_state(const hdf5::Handle& group);

}  // namespace dem
