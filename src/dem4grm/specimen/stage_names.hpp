// SPDX-License-Identifier: BSD-3-Clause
// What the stages of a direct shear test are called in saved states.
#pragma once

namespace dem::stage_name {

inline constexpr const char* k_fill = "fill";
inline constexpr const char* k_branch = "branch";  ///< of the search for the density
inline constexpr const char* k_compression = "compression";
inline constexpr const char* k_final_friction = "final friction";
inline constexpr const char* k_shear = "shear";

}  // namespace dem::stage_name
