// SPDX-License-Identifier: BSD-3-Clause
// One full state as a group of an HDF5 file, SI units.
#pragma once

#include <string>

#include "dem4grm/lab/observer.hpp"
#include "dem4grm/results/hdf5_handle.hpp"

namespace dem {

/// Writes the group `name` with attributes and the groups balls, clumps, rubber_grains, contacts, bonds, walls. Lists
/// are in the order of ids. Throws IoError.
void write_frame(const hdf5::Handle& parent, const std::string& name, const Simulation& state, const FrameInfo& info);

}  // namespace dem
