// SPDX-License-Identifier: BSD-3-Clause
// The keys that a case gives, with their places: known ones found, unknown ones reported with what was meant.
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "dem4grm/case_file/case_override.hpp"
#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/toml_guard.hpp"

namespace dem {

/// What was given where. The nodes point into the tree that was searched.
struct GivenKeys {
  std::map<std::string, const TomlNode*, std::less<>> nodes;  ///< by path, "rubber.bond.modulus"
  std::map<std::string, Place, std::less<>> sections;         ///< of the headers
  std::set<std::string, std::less<>> bad;                     ///< keys with a problem, missing ones too

  [[nodiscard]] bool has(std::string_view path) const { return nodes.contains(path); }
  /// True when a rule about these keys makes sense: none of them has a problem of its own.
  [[nodiscard]] bool are_good(std::initializer_list<std::string_view> paths) const;
  /// The value of the first of these keys that was given; else the header of its section; else the whole file.
  [[nodiscard]] Place place_of(std::initializer_list<std::string_view> paths) const;
};

/// Puts the options into the tree, in place of what the file says; an option for one of two keys that exclude each other also replaces the
/// other one. Options that cannot be placed are reported.
void apply_overrides(TomlNode& root, std::span<const Override> overrides, CaseProblems& problems);

/// Finds the keys of the schema in the tree and reports everything else. `other` is the schema of the other test, for
/// suggestions only. Required keys that are missing are reported and listed as bad.
GivenKeys find_keys(const TomlNode& root, const Schema& schema, const Schema& other, CaseProblems& problems);

}  // namespace dem
