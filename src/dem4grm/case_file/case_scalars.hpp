// SPDX-License-Identifier: BSD-3-Clause
// Single numbers, choices and texts of a key, with the message for each way of getting them wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/toml_guard.hpp"

namespace dem {

/// Reads nodes as values of one key. Whatever is wrong goes to the problems and nothing (or false) comes back.
class ScalarReader {
 public:
  ScalarReader(const Key& key, CaseProblems& problems) : key_(key), problems_(problems) {}

  /// A number, or text with a unit where the key has a dimension, inside the range of the key. SI.
  std::optional<double> quantity(const TomlNode& node);
  /// True for the word; any other text is reported, with both forms that the key takes.
  bool is_word(const TomlNode& node, std::string_view word);
  /// A whole number inside the range of the key; 2e6 counts as one.
  std::optional<int> integer(const TomlNode& node);
  /// A whole number from 0 on.
  std::optional<std::uint64_t> natural(const TomlNode& node);
  /// Index of the text among the choices of the key.
  std::optional<std::size_t> choice(const TomlNode& node);
  /// True for text of one line that is not empty (notes may be) and not endless.
  bool is_sound_text(const TomlNode& node);

  /// Reports "section.key = value predicate"; returns false.
  bool fail(const TomlNode& node, std::string_view predicate);
  /// The same for a value of a wrong kind, which may have no short text of its own.
  bool wrong_kind(const TomlNode& node, std::string_view predicate);

 private:
  std::optional<double> number_with_unit(const TomlNode& node);
  std::optional<double> plain_number(const TomlNode& node);
  bool is_in_range(double value, const TomlNode& node);

  const Key& key_;
  CaseProblems& problems_;
};

}  // namespace dem
