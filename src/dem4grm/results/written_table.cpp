// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/written_table.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

/// Splits at commas; what a run writes has no quotes.
std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

WrittenTable read_table(const std::filesystem::path& csv) {
  std::ifstream file(csv, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw IoError(fmt::format("{}: cannot be read", csv.string()));
  WrittenTable table;
  std::string_view rest = text;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::size_t end = rest.find('\n');
    table.is_cut = end == std::string_view::npos;
    if (table.is_cut) break;
    const std::vector<std::string_view> cells = cells_of(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (line == 1) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size()) {
      throw IoError(fmt::format("{}:{}: {} cells in place of {}: the row is incomplete", csv.string(), line,
                                cells.size(), table.names.size()));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      table.columns[c].push_back(parse_decimal(cells[c]).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  return table;
}

}  // namespace dem
