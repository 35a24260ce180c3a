// SPDX-License-Identifier: BSD-3-Clause
// How a laboratory has written its table of a grading: what separates the columns, units, and what the second one means.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dem {

struct GradingDialect {
  char separator = ',';
  bool has_decimal_commas = false;
  int size_exponent = -3;          ///< sizes are written in 10^this m
  int share_exponent = -2;         ///< shares are written in 10^this: per cent, or 0 for fractions
  bool is_retained = false;        ///< shares are those that stay on the sieve or above it
  std::vector<std::string> notes;  ///< what was understood of a header other than ours, one phrase each
};

/// From the header of the table, "size_mm,passing_percent" or the words of a laboratory: a size (sieve, opening, diameter, ...)
/// with its unit (mm, um, cm, m; mm when it has none) and a share (passing, finer, cumulative retained) as per cent or fraction. Nothing
/// when one of the two is not recognised.
std::optional<GradingDialect> grading_dialect(std::string_view header);

/// UTF-16 text with a byte-order mark, as spreadsheets write, in UTF-8; other text as it is.
std::string without_utf16(std::string_view bytes);

}  // namespace dem
