// SPDX-License-Identifier: BSD-3-Clause
// Whether a file of results is whole: every dataset read to its end, against the checksums that it was written with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dem {

enum class SealState { fits, broken, none };  ///< none: written by an older build, or copied by a program that drops it

struct ResultsCheck {
  SealState seal = SealState::none;
  int datasets = 0;
  int without_checksum = 0;               ///< of a build before there were any
  std::vector<std::string> damaged;       ///< paths of datasets and groups, "frames/0003/balls/position"
  std::vector<std::string> whole_states;  ///< names of the states without damage, in their order
};

/// Reads all of results.h5 or specimen.h5. Throws MissingFileError, or IoError when it cannot be opened at all.
ResultsCheck check_results(const std::filesystem::path& path);

/// One line: "whole: every byte fits the seal (273 datasets)". Throws IoError that names what is damaged and which states are whole.
std::string verdict_of(const std::filesystem::path& path, const ResultsCheck& check);

}  // namespace dem
