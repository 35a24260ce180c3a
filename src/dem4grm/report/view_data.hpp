// SPDX-License-Identifier: BSD-3-Clause
// The stored states of a test as the 3D view of the page takes them: small whole numbers in place of doubles.
//
// Places lie on a lattice of at most 2^14 steps along each side of the room that all states fill: 7 um at full size, a
// three-hundredth of the smallest ball. Balls of a rubber grain are predicted from one another (grain_prediction.hpp), pebbles follow from
// the place and orientation of their clump.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "dem4grm/results/json_text.hpp"

namespace dem {

/// The states that a page shows: all when there are few, else so many, evenly chosen, the first and the last among them.
std::vector<std::size_t> chosen_states(std::size_t available, std::size_t most);

/// The view (interface View of web/src/data.ts) of results.h5 or specimen.h5 of a direct shear test, of at most `most` states.
/// Throws MissingFileError and IoError as read_micro_state does; IoError when the states do not fit together.
JsonObject view_of(const std::filesystem::path& results, std::size_t most);

}  // namespace dem
