// SPDX-License-Identifier: BSD-3-Clause
// What the files of an output folder are called.
#pragma once

namespace dem {

/// Names of the files in an output folder.
namespace file_name {
inline constexpr const char* k_case = "case.toml";
inline constexpr const char* k_resolved = "resolved.toml";
inline constexpr const char* k_log = "run.log";
inline constexpr const char* k_status = "status.json";
inline constexpr const char* k_shear = "shear.csv";
inline constexpr const char* k_grain = "grain.csv";
inline constexpr const char* k_walls = "walls.csv";
inline constexpr const char* k_micro = "micro.csv";
inline constexpr const char* k_profiles = "profiles.csv";
inline constexpr const char* k_summary = "summary.json";
inline constexpr const char* k_results = "results.h5";
inline constexpr const char* k_specimen = "specimen.h5";
inline constexpr const char* k_specimen_summary = "specimen.json";
inline constexpr const char* k_preparation = "preparation";  ///< folder
inline constexpr const char* k_checkpoint = "checkpoint.h5";
inline constexpr const char* k_end_state = "end_state.h5";
inline constexpr const char* k_branch = "branch.json";
inline constexpr const char* k_previous_checkpoint = "checkpoint.previous.h5";
}  // namespace file_name

}  // namespace dem
