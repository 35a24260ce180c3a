// SPDX-License-Identifier: BSD-3-Clause
// CSV files that a run wrote, read back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dem {

struct WrittenTable {
  std::vector<std::string> names;            ///< of the columns, in the order of the file
  std::vector<std::vector<double>> columns;  ///< [column][row]; NaN where a cell holds no number
  bool is_cut = false;                       ///< the last line has no end and was left out: it is being written
};

/// Names and numbers of a file; one without a whole header has no columns. Throws IoError, with the file's name and line, when it cannot
/// be read or a row has not one cell for each column.
WrittenTable read_table(const std::filesystem::path& csv);

}  // namespace dem
