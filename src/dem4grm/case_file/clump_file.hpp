// SPDX-License-Identifier: BSD-3-Clause
// Clump shapes of the user: the CSV file, and the rules that they obey wherever they come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/specimen/settings.hpp"

namespace dem {

/// One pebble as it is written down: the shape that it belongs to, and where it is.
struct ClumpRow {
  std::string shape;
  Pebble pebble;
};

struct ClumpFault {
  enum class Part : std::uint8_t { name, x, y, z, radius, row, whole };
  std::size_t row = 0;
  Part part = Part::whole;
  std::string message;
};

/// Everything that is wrong with rows of pebbles: no rows, names that are shipped already, come twice or hold odd
/// characters, numbers out of range, shapes that do not hang together, pebbles inside others.
std::vector<ClumpFault> clump_faults(std::span<const ClumpRow> rows);

/// The shapes that the rows make, in the order of their first rows; rows of one shape stand together.
std::vector<ClumpShape> clump_shapes_of(std::span<const ClumpRow> rows);

/// Shapes read from CSV, and all problems rendered as `file:line:column: error: ...` with the line and a caret.
struct ClumpFile {
  std::vector<ClumpShape> shapes;  ///< with problems: what could be read, for its names
  std::vector<std::string> problems;
};

/// Reads the columns "shape,x,y,z,radius", any unit of length; lines that begin with # are comments. Throws
/// MissingFileError.
ClumpFile read_clump_file(const std::filesystem::path& path);

/// The same from text; `name` is the file in messages. Never throws on any bytes.
ClumpFile parse_clumps(std::string_view text, std::string_view name);

}  // namespace dem
