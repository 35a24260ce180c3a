// SPDX-License-Identifier: BSD-3-Clause
// Reads a small text file whole.
#pragma once

#include <filesystem>
#include <string>

namespace dem {

/// The bytes of the file, but not more than one byte beyond k_largest_case_file, so that a wrong name cannot fill the
/// memory. Throws MissingFileError when there is no such file, when it is a folder or when it cannot be read.
std::string read_text_file(const std::filesystem::path& path);

}  // namespace dem
