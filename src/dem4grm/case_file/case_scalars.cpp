// SPDX-License-Identifier: BSD-3-Clause
// Reading of numbers, choices and texts.
#include "dem4grm/case_file/case_scalars.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "dem4grm/case_file/case_values.hpp"
#include "dem4grm/case_file/nearest_name.hpp"

namespace dem {
namespace {

constexpr std::size_t k_longest_text = 1000;  // characters of a name or path

std::string_view kind_words(TomlKind kind) {
  switch (kind) {
    case TomlKind::text:
    case TomlKind::option_text:
      return "text";
    case TomlKind::integer:
    case TomlKind::number:
      return "a number";
    case TomlKind::flag:
      return "true or false";
    case TomlKind::date:
      return "a date";
    case TomlKind::array:
      return "a list";
    case TomlKind::table:
      return "a section";
  }
  return "";
}

bool is_number(const TomlNode& node) { return node.kind == TomlKind::integer || node.kind == TomlKind::number; }

double number_of(const TomlNode& node) {
  return node.kind == TomlKind::integer ? static_cast<double>(node.integer) : node.number;
}

/// The whole number that is written, as 7 or as 2e6; nothing for other kinds and for fractions.
std::optional<std::int64_t> whole_number(const TomlNode& node) {
  if (node.kind == TomlKind::integer) return node.integer;
  constexpr double k_exact = 9007199254740992.0;  // 2^53: beyond it a double is no longer every whole number
  if (node.kind != TomlKind::number || !(std::abs(node.number) <= k_exact)) return std::nullopt;
  if (node.number != std::floor(node.number)) return std::nullopt;
  return static_cast<std::int64_t>(node.number);
}

std::optional<double> fraction_of(std::string_view percent) {
  percent.remove_suffix(1);
  while (percent.ends_with(' ')) percent.remove_suffix(1);
  return parse_decimal(percent, -2);
}

}  // namespace

bool ScalarReader::fail(const TomlNode& node, std::string_view predicate) {
  problems_.error(node.place, fmt::format("{} = {} {}", key_.path(), shown_value(node), predicate), key_note(key_));
  return false;
}

bool ScalarReader::wrong_kind(const TomlNode& node, std::string_view predicate) {
  const std::string what = node.kind == TomlKind::array || node.kind == TomlKind::table || node.kind == TomlKind::date
                               ? fmt::format(" {}, not {}", predicate, kind_words(node.kind))
                               : fmt::format(" = {} {}", shown_value(node), predicate);
  problems_.error(node.place, key_.path() + what, key_note(key_));
  return false;
}

std::optional<double> ScalarReader::quantity(const TomlNode& node) {
  const std::optional<double> value = key_.has_unit() ? number_with_unit(node) : plain_number(node);
  if (!value || is_in_range(*value, node)) return value;
  return std::nullopt;
}

bool ScalarReader::is_word(const TomlNode& node, std::string_view word) {
  if (node.text == word) return true;
  const bool is_near = nearest_name(node.text, std::array{word}).has_value();
  return fail(
      node, fmt::format("is neither a {} with its unit, as \"1 {}\", nor \"{}\"{}", dimension_name(key_.dimension),
                        usual_unit(key_.dimension), word, is_near ? fmt::format("; did you mean \"{}\"?", word) : ""));
}

std::optional<double> ScalarReader::number_with_unit(const TomlNode& node) {
  if (is_number(node)) {
    fail(node, fmt::format("has no unit; write it as text with a unit, as \"{} {}\"", shown_value(node),
                           usual_unit(key_.dimension)));
    return std::nullopt;
  }
  if (node.kind != TomlKind::text) {
    wrong_kind(node, fmt::format("must be text with a unit, as \"1 {}\"", usual_unit(key_.dimension)));
    return std::nullopt;
  }
  ParsedQuantity parsed = parse_quantity(printable(node.text, k_longest_text), key_.dimension);
  if (!parsed.value) fail(node, parsed.problem);
  return parsed.value;
}

std::optional<double> ScalarReader::plain_number(const TomlNode& node) {
  if (is_number(node)) return number_of(node);
  if (node.kind == TomlKind::text) {
    if (const std::optional<double> meant = parse_decimal(node.text)) {
      fail(node, fmt::format("is text; write the number without quotes: {}", format_decimal(*meant)));
    } else if (node.text.ends_with('%') && fraction_of(node.text)) {
      fail(node, fmt::format("is in per cent; write a fraction: {}", format_decimal(*fraction_of(node.text))));
    } else {
      fail(node, "must be a plain number");
    }
  } else {
    wrong_kind(node, "must be a plain number");
  }
  return std::nullopt;
}

bool ScalarReader::is_in_range(double value, const TomlNode& node) {
  if (value >= key_.range.least && value <= key_.range.most) return true;
  std::string predicate = fmt::format("is outside {}", range_text(key_));
  // Whoever writes 25 for a share means per cent; 1.2 is another kind of mistake.
  if (!key_.has_unit() && key_.range.least == 0.0 && key_.range.most == 1.0 && value >= 2.0 && value <= 100.0) {
    predicate += fmt::format("; a fraction: did you mean {}?", format_decimal(value, 2));
  }
  return fail(node, predicate);
}

std::optional<int> ScalarReader::integer(const TomlNode& node) {
  const std::optional<std::int64_t> value = whole_number(node);
  if (!value) {
    wrong_kind(node, "must be a whole number");
    return std::nullopt;
  }
  if (!is_in_range(static_cast<double>(*value), node)) return std::nullopt;
  return static_cast<int>(*value);
}

std::optional<std::uint64_t> ScalarReader::natural(const TomlNode& node) {
  const std::optional<std::int64_t> value = whole_number(node);
  if (value && *value >= 0) return static_cast<std::uint64_t>(*value);
  if (value) {
    fail(node, "must not be negative");
  } else {
    wrong_kind(node, "must be a whole number from 0 to 2^63 - 1, from 2^53 on without an exponent");
  }
  return std::nullopt;
}

std::optional<std::size_t> ScalarReader::choice(const TomlNode& node) {
  const std::string accepted = fmt::format("{}", fmt::join(key_.choices, ", "));
  if (node.kind != TomlKind::text) {
    wrong_kind(node, fmt::format("must be one of {}, in quotes", accepted));
    return std::nullopt;
  }
  const auto found = std::find(key_.choices.begin(), key_.choices.end(), node.text);
  if (found != key_.choices.end()) return static_cast<std::size_t>(found - key_.choices.begin());
  const std::optional<std::string_view> near = nearest_name(node.text, key_.choices);
  fail(node, fmt::format("is not one of {}{}", accepted, near ? fmt::format("; did you mean \"{}\"?", *near) : ""));
  return std::nullopt;
}

bool ScalarReader::is_sound_text(const TomlNode& node) {
  if (node.kind != TomlKind::text) return wrong_kind(node, "must be text in quotes");
  const bool has_control = std::any_of(node.text.begin(), node.text.end(),
                                       [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
  if (has_control) return fail(node, "contains a control character");
  if (node.text.size() > k_longest_text) return fail(node, "is too long");
  if (node.text.empty() && !key_.name.ends_with("_source")) return fail(node, "is empty");
  return true;
}

}  // namespace dem
