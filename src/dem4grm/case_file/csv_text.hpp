// SPDX-License-Identifier: BSD-3-Clause
// The lines of a small CSV file that a user has written, cut into fields that know where they stand.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// One field without the blanks around it.
struct CsvField {
  std::string_view text;
  std::size_t begin = 0;  ///< bytes from the beginning of the line
};

/// A line cut at the separator.
std::vector<CsvField> fields_of_line(std::string_view line, char separator);

class CsvText {
 public:
  /// `text` must outlive this object; `name` is the file in messages.
  CsvText(std::string_view text, std::string_view name);

  [[nodiscard]] std::size_t line_count() const { return lines_.size(); }
  [[nodiscard]] std::vector<CsvField> fields_of(std::size_t line, char separator = ',') const;
  /// The whole line as one field.
  [[nodiscard]] CsvField whole(std::size_t line) const { return {lines_[line], 0}; }

  /// `file:line:column: error: message` with the line and a caret under the field.
  [[nodiscard]] std::string problem(std::size_t line, const CsvField& field, std::string_view message,
                                    std::string_view note = {}) const;
  /// A problem of the file as a whole.
  [[nodiscard]] std::string problem(std::string_view message) const;

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
};

/// True for lines that hold nothing, or a comment that begins with #.
bool is_blank_or_comment(const std::vector<CsvField>& fields);

/// "\"x\" is not a plain decimal number".
std::string not_a_number(const CsvField& field);

/// The text without a byte-order mark.
std::string_view without_mark(std::string_view text);

}  // namespace dem
