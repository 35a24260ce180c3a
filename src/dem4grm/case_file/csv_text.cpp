// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/csv_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/toml_scan.hpp"

namespace dem {

CsvText::CsvText(std::string_view text, std::string_view name) : name_(name), lines_(split_lines(text)) {}

std::vector<CsvField> CsvText::fields_of(std::size_t line, char separator) const {
  return fields_of_line(lines_[line], separator);
}

std::vector<CsvField> fields_of_line(std::string_view text, char separator) {
  std::vector<CsvField> fields;
  for (std::size_t begin = 0; begin <= text.size();) {
    std::size_t end = std::min(text.find(separator, begin), text.size());
    const std::size_t next = end + 1;
    while (begin < end && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
    while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
    fields.push_back({text.substr(begin, end - begin), begin});
    begin = next;
  }
  return fields;
}

std::string CsvText::problem(std::size_t line, const CsvField& field, std::string_view message,
                             std::string_view note) const {
  const Place place{static_cast<int>(line) + 1, character_count(lines_[line].substr(0, field.begin)) + 1,
                    std::max(1, character_count(field.text))};
  return render_problem(name_, lines_, place, "error", message, note);
}

std::string CsvText::problem(std::string_view message) const {
  return render_problem(name_, lines_, {}, "error", message, "");
}

bool is_blank_or_comment(const std::vector<CsvField>& fields) {
  const bool is_blank = fields.size() == 1 && fields[0].text.empty();
  return is_blank || fields[0].text.starts_with('#');
}

std::string not_a_number(const CsvField& field) {
  return fmt::format("\"{}\" is not a plain decimal number", printable(field.text, 40));
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

}  // namespace dem
