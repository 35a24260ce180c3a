// SPDX-License-Identifier: BSD-3-Clause
// One test folder as the page takes it (interface Test of web/src/data.ts).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/results/json_text.hpp"

namespace dem {

struct TestDataOptions {
  std::size_t states_in_view = 12;  ///< of the 3D view; 0: no view
  int resamples = 200;              ///< of the confidence bands; 0: no bands
  bool has_wall_table = true;       ///< walls.csv is large and of little use in a page of many tests
};

/// Numbers are those of the files. A file that is not there, or is damaged, leaves its part null and adds a sentence to `notes`.
/// Throws MissingFileError when the folder holds no test.
JsonObject test_data(const std::filesystem::path& folder, const std::string& name, const TestDataOptions& options,
                     std::vector<std::string>& notes);

/// {columns, values[column][row]} of a CSV file that a run wrote; what is no number is null. Throws IoError, also
/// for a row with another number of cells; a last row without its end, of a test that runs, is left out.
JsonObject table_data(const std::filesystem::path& csv);

}  // namespace dem
