// SPDX-License-Identifier: BSD-3-Clause
// The record of a shear test as part of a checkpoint.
#pragma once

#include <vector>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/lab/before_shear.hpp"
#include "dem4grm/lab/observer.hpp"

namespace dem {

/// Saves or loads lists of any length. Loading throws IoError when the archive does not hold them.
void exchange(StateArchive& archive, std::vector<FrameInfo>& frames);
void exchange(StateArchive& archive, std::vector<ShearRow>& rows);
void exchange(StateArchive& archive, std::vector<MicroRow>& rows);
/// What was measured before shear, which cannot be measured any more.
void exchange(StateArchive& archive, BeforeShear& before);

}  // namespace dem
