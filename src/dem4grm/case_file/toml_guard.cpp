// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes toml++.
#include "dem4grm/case_file/toml_guard.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "dem4grm/case_file/toml_syntax.hpp"

// Debian's toml++ calls assert() on some malformed keys: a debug build would abort on bad input. Without the assert the
// parser returns a proper error. The macro only acts on the header-only form; the compiled library keeps its asserts.
#define TOML_ASSERT(condition) static_cast<void>(0)
#undef TOML_HEADER_ONLY
#undef TOML_SHARED_LIB
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

namespace dem {
namespace {

constexpr int k_most_repairs = 20;

Place place_of(const toml::source_region& region) {
  Place place{static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 1};
  if (region.end.line == region.begin.line && region.end.column > region.begin.column) {
    place.length = static_cast<int>(region.end.column - region.begin.column);
  }
  return place;
}

TomlNode convert(const toml::node& node) {
  TomlNode result;
  result.place = place_of(node.source());
  if (const auto* table = node.as_table()) {
    result.kind = TomlKind::table;
    for (const auto& [key, value] : *table) {
      result.members.push_back({std::string(key.str()), place_of(key.source()), convert(value)});
    }
    std::stable_sort(result.members.begin(), result.members.end(), [](const TomlMember& a, const TomlMember& b) {
      return std::pair(a.key_place.line, a.key_place.column) < std::pair(b.key_place.line, b.key_place.column);
    });
  } else if (const auto* array = node.as_array()) {
    result.kind = TomlKind::array;
    for (const auto& item : *array) result.items.push_back(convert(item));
  } else if (const auto* text = node.as_string()) {
    result.kind = TomlKind::text;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = TomlKind::integer;
    result.integer = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = TomlKind::number;
    result.number = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    result.kind = TomlKind::flag;
    result.flag = flag->get();
  } else {
    result.kind = TomlKind::date;
  }
  return result;
}

/// Line number and text of one line of `text`; the byte range allows it to be replaced.
struct LineRange {
  std::size_t begin = 0;
  std::size_t length = 0;
};

std::optional<LineRange> find_line(std::string_view text, int line) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return std::nullopt;
    begin = end + 1;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  return LineRange{begin, end - begin};
}

/// Reports the error and tries to make its line harmless, so that the rest of the file can be read as well.
/// False when nothing more can be read.
bool repair(std::string& text, const toml::parse_error& error, TomlDocument& document) {
  const Place place = place_of(error.source());
  const std::optional<LineRange> range = find_line(text, place.line);
  const std::string line = range ? text.substr(range->begin, range->length) : std::string();
  SyntaxAdvice advice = advise_on_syntax(line, place, error.description());
  const bool is_first = document.reported_lines.insert(place.line).second;
  // A second error in one line: a line with a foreign character, or a repair that did not help.
  if (is_first) document.problems.push_back(std::move(advice.problem));
  if (!range || !advice.harmless_line || *advice.harmless_line == line) return false;
  text.replace(range->begin, range->length, *advice.harmless_line);
  return true;
}

}  // namespace

TomlDocument parse_toml(std::string_view bytes) {
  TomlDocument document;
  TomlScan scan = scan_toml(bytes);
  document.problems = std::move(scan.problems);
  document.is_usable = !scan.is_fatal;
  for (const TomlProblem& problem : document.problems) document.reported_lines.insert(problem.place.line);
  if (scan.is_fatal) return document;
  for (int attempt = 0; attempt <= k_most_repairs; ++attempt) {
    try {
      const toml::table table = toml::parse(std::string_view(scan.text));
      document.root = convert(table);
      document.root.place = {};
      return document;
    } catch (const toml::parse_error& error) {
      if (!repair(scan.text, error, document)) break;
    }
  }
  document.is_usable = false;
  return document;
}

const TomlNode* find_member(const TomlNode& table, std::string_view key) {
  for (const TomlMember& member : table.members) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

}  // namespace dem
