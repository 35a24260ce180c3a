// SPDX-License-Identifier: BSD-3-Clause
// Gradings: the CSV file, and the rules that a grading obeys wherever it comes from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/specimen/settings.hpp"

namespace dem {

/// How the share that passes is written: 0 to 100 in a CSV file, 0 to 1 in a case file.
enum class PassingUnit : std::uint8_t { percent, fraction };

struct GradingFault {
  enum class Part : std::uint8_t { size, passing, whole };
  std::size_t row = 0;  ///< index of the point
  Part part = Part::whole;
  std::string message;
};

/// Everything that is wrong with a grading: fewer than two points, sizes not positive or not increasing, passing
/// outside its range or falling, not 0 at the first sieve, not all at the last. `unit` is that of the messages.
std::vector<GradingFault> grading_faults(const Grading& grading, PassingUnit unit);

/// A grading read from CSV, and all problems rendered as `file:line:column: error: ...` with the line and a caret.
struct GradingFile {
  Grading points;  ///< sizes in m, passing as a fraction; meaningful only without problems
  std::vector<std::string> problems;
  std::vector<std::string> notes;  ///< what was understood of a table that is not in our form; grading_dialect.hpp
};

/// Reads the columns "size_mm,passing_percent", or a table as a laboratory exports it: other words, separators and units in the
/// header, decimal commas, coarsest sieve first, empty columns behind; lines that begin with # are comments. Throws MissingFileError.
GradingFile read_grading_file(const std::filesystem::path& path);

/// The same from text; `name` is the file in messages. Never throws on any bytes.
GradingFile parse_grading(std::string_view text, std::string_view name);

}  // namespace dem
