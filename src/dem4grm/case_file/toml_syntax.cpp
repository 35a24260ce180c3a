// SPDX-License-Identifier: BSD-3-Clause
// Advice on refused lines: units without quotes, words without quotes, per cent, decimal commas, keys given twice.
#include "dem4grm/case_file/toml_syntax.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_key_character(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.'; }
bool is_number_character(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// `key = value # comment` on one line, the value without quotes and brackets.
struct BareLine {
  std::string_view key, value;
  std::size_t value_begin = 0;  ///< bytes
};

std::optional<BareLine> split_bare_line(std::string_view line) {
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && is_blank(line[at])) ++at;
  };
  skip_blanks();
  const std::size_t key_begin = at;
  while (at < line.size() && is_key_character(line[at])) ++at;
  BareLine result{line.substr(key_begin, at - key_begin), {}, 0};
  skip_blanks();
  if (result.key.empty() || at == line.size() || line[at] != '=') return std::nullopt;
  ++at;
  skip_blanks();
  std::string_view value = line.substr(at, line.substr(at).find('#'));
  while (!value.empty() && is_blank(value.back())) value.remove_suffix(1);
  result.value = value;
  result.value_begin = at;
  return result;
}

std::size_t number_length(std::string_view value) {
  std::size_t length = 0;
  while (length < value.size() && is_number_character(value[length])) ++length;
  return length;
}

/// What a value without quotes should have been; empty when there is nothing better than the parser's words.
std::string advise_on_bare_value(std::string_view key, std::string_view value) {
  if (value.empty()) return fmt::format("{} has no value", printable(key));
  const std::size_t digits = number_length(value);
  const std::string shown = printable(value, 40);
  if (digits == 0 && is_letter(value.front())) {
    constexpr std::array k_yes_or_no{"yes", "no", "on", "off", "True", "False", "TRUE", "FALSE", "Yes", "No"};
    if (std::find(k_yes_or_no.begin(), k_yes_or_no.end(), value) != k_yes_or_no.end()) {
      return fmt::format("{} is not a value here; write true or false", shown);
    }
    return fmt::format("text needs quotes: {} = \"{}\"", printable(key), shown);
  }
  if (digits == 0) return {};
  std::string_view rest = value.substr(digits);
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  const std::string_view number = value.substr(0, digits);
  if (rest == "%") {
    const std::optional<double> fraction = parse_decimal(number, -2);
    return fraction ? fmt::format("fractions are not written in per cent: {} = {}", printable(key),
                                  format_decimal(*fraction))
                    : std::string();
  }
  if (rest.starts_with(',')) return fmt::format("write {} with a decimal point instead of the comma", shown);
  if (!rest.empty() && is_letter(rest.front())) {
    return fmt::format("a value with a unit is text and needs quotes: {} = \"{}\"", printable(key), shown);
  }
  if (rest.empty() && (number.starts_with('.') || number.ends_with('.'))) {
    return fmt::format("{}: a number needs a digit on both sides of its point", shown);
  }
  return {};
}

std::string without_preamble(std::string_view description) {
  constexpr std::string_view k_preamble = "Error while parsing ";
  if (description.starts_with(k_preamble)) {
    description.remove_prefix(k_preamble.size());
    const std::size_t colon = description.find(": ");
    if (colon != std::string_view::npos) {
      return printable(fmt::format("{} ({})", description.substr(colon + 2), description.substr(0, colon)), 200);
    }
  }
  return printable(description, 200);
}

/// "cannot redefine existing integer 'a'" -> a.
std::optional<std::string> name_given_twice(std::string_view description) {
  if (description.find("cannot redefine existing") == std::string_view::npos) return std::nullopt;
  const std::size_t begin = description.find('\'');
  const std::size_t end = description.rfind('\'');
  if (begin == std::string_view::npos || end <= begin) return std::nullopt;
  return printable(description.substr(begin + 1, end - begin - 1));
}

}  // namespace

SyntaxAdvice advise_on_syntax(std::string_view line, const Place& place, std::string_view description) {
  SyntaxAdvice advice;
  advice.problem.place = {std::max(1, place.line), std::max(1, place.column), 1};
  const std::optional<BareLine> bare = split_bare_line(line);
  if (const std::optional<std::string> name = name_given_twice(description)) {
    advice.problem.message = fmt::format("\"{}\" is given twice", *name);
    advice.problem.note = "the first one stands above; keep one of the two";
    if (bare) {
      const auto key_begin = static_cast<std::size_t>(bare->key.data() - line.data());
      advice.problem.place.column = character_count(line.substr(0, key_begin)) + 1;
      advice.problem.place.length = character_count(bare->key);
      // A value that may go on in the next line cannot be taken out by its first line.
      if (line.find_first_of("[{") == std::string_view::npos && line.find("\"\"\"") == std::string_view::npos &&
          line.find("'''") == std::string_view::npos) {
        advice.harmless_line = "";
      }
    }
    return advice;
  }
  advice.problem.message = fmt::format("not valid TOML: {}", without_preamble(description));
  if (!bare || bare->value.find_first_of("\"'[]{}") != std::string_view::npos) return advice;
  advice.harmless_line = fmt::format("{} = \"\"", bare->key);
  const std::string better = advise_on_bare_value(bare->key, bare->value);
  if (!better.empty()) {
    advice.problem.message = better;
    advice.problem.place.column = character_count(line.substr(0, bare->value_begin)) + 1;
    advice.problem.place.length = std::max(1, character_count(bare->value));
  }
  return advice;
}

}  // namespace dem
