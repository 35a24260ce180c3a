// SPDX-License-Identifier: BSD-3-Clause
// A look at the bytes of a TOML file before any parser sees them, and the line and column helpers of its messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// Where something stands: lines and columns count from 1, columns and lengths in characters, not bytes.
/// A length of 0 stands for the file as a whole. `option` is the index of the --set option that gave the value
/// instead of the file, or -1.
struct Place {
  int line = 1;
  int column = 1;
  int length = 0;
  int option = -1;
};

/// One thing that is wrong, not yet rendered for people.
struct TomlProblem {
  Place place;
  std::string message;
  std::string note;  ///< goes beside the caret; may be empty
};

/// What the scan found. `text` is safe for toml++: no byte-order mark, ASCII outside comments and strings (other
/// characters are reported and replaced by x, one for one, so that columns hold).
struct TomlScan {
  std::string text;
  std::vector<TomlProblem> problems;
  bool is_fatal = false;  ///< parsing makes no sense or is not safe
};

inline constexpr std::size_t k_largest_case_file = std::size_t{1} << 20;  ///< bytes

/// Checks size, NUL, UTF-8, characters outside comments and strings, nesting of brackets and of dotted keys.
/// Never throws on any bytes.
TomlScan scan_toml(std::string_view bytes);

/// The lines of a text without their ends (LF or CR LF).
std::vector<std::string_view> split_lines(std::string_view text);

/// Text that is safe to print on one line of a terminal: control characters become '?', at most `most` characters
/// are kept (then "..." follows). The text must be valid UTF-8 or the result may break characters.
std::string printable(std::string_view text, std::size_t most = 60);

/// Number of characters of valid UTF-8.
int character_count(std::string_view text);

/// Bytes of `text` from character `begin` (from 0) on, `count` characters long or up to the end.
std::string_view characters(std::string_view text, int begin, int count);

}  // namespace dem
