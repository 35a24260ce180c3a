// SPDX-License-Identifier: BSD-3-Clause
// Reading of case files and gradings from disk.
#include "dem4grm/case_file/text_file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {

std::string read_text_file(const std::filesystem::path& path) {
  const std::string shown = printable(path.string(), 300);
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw MissingFileError(fmt::format("{}: no such file", shown));
  }
  if (error) throw MissingFileError(fmt::format("{}: {}", shown, error.message()));
  if (std::filesystem::is_directory(status)) {
    throw MissingFileError(fmt::format("{}: is a folder, not a file", shown));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text;
  if (file) {
    text.resize(k_largest_case_file + 1);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
  }
  if (!file.is_open() || file.bad()) {
    throw MissingFileError(fmt::format("{}: cannot be read: {}", shown,
                                       std::error_code(errno == 0 ? EIO : errno, std::generic_category()).message()));
  }
  return text;
}

}  // namespace dem
