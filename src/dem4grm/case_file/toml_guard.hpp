// SPDX-License-Identifier: BSD-3-Clause
// TOML text to a small tree with the place of every key and value; the only door to toml++.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/case_file/toml_scan.hpp"

namespace dem {

enum class TomlKind : std::uint8_t {
  text,
  integer,
  number,
  flag,
  date,
  array,
  table,
  option_text,  ///< value of a --set option, typed only when its key is known
};

struct TomlMember;

/// A value; only the field of its kind is set.
struct TomlNode {
  TomlKind kind = TomlKind::table;
  std::string text;  ///< of text and option_text
  std::int64_t integer = 0;
  double number = 0.0;
  bool flag = false;
  std::vector<TomlNode> items;      ///< of an array
  std::vector<TomlMember> members;  ///< of a table, in the order of the file
  Place place;
};

struct TomlMember {
  std::string key;
  Place key_place;
  TomlNode value;
};

/// What could be read, and what is wrong. A line with a problem of its own does not stop the others: its value is
/// replaced by an empty text and the line is listed, so that nothing else is said about it.
struct TomlDocument {
  TomlNode root;
  std::vector<TomlProblem> problems;
  std::set<int> reported_lines;
  bool is_usable = true;  ///< false: `root` is empty, only the problems count
};

/// Parses TOML behind the guard. Never throws on any bytes.
TomlDocument parse_toml(std::string_view bytes);

/// The member of that key, or nullptr.
const TomlNode* find_member(const TomlNode& table, std::string_view key);

}  // namespace dem
