// SPDX-License-Identifier: BSD-3-Clause
// Profiles over the height of the specimen: read off the stored states of results.h5, written as profiles.csv.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "dem4grm/micro/height_profile.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/table_file.hpp"

namespace dem {

/// The profile of every stored state against the first one, in their order. layers: 0 for the default.
/// Throws MissingFileError when there is no such file or it holds no state, IoError when it is damaged, Error with
/// ExitCode::usage when it is of another test.
std::vector<StateProfile> read_profiles(const std::filesystem::path& results, int layers = 0);

/// Columns of profiles.csv: one row for each layer of each state, the lowest first.
std::span<const ColumnInfo> profile_columns();
std::vector<double> profile_values(const StateProfile& profile, const ProfileLayer& layer);
/// All rows of all states, brought to the disk. table: of profile_columns. Throws IoError.
void append_profiles(TableFile& table, std::span<const StateProfile> profiles);

/// The shear band of each state: the list "shear_band" of summary.json.
JsonList shear_bands_as_json(std::span<const StateProfile> profiles);

/// For `dem4grm profile`: a table of the layers of one state with its band, and all of it as JSON.
std::string profile_text(const StateProfile& profile);
JsonObject profiles_as_json(std::span<const StateProfile> profiles);

}  // namespace dem
