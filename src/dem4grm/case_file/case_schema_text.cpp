// SPDX-License-Identifier: BSD-3-Clause
// The words of the schema: ranges, notes and values as TOML text.
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>

#include "dem4grm/case_file/case_schema.hpp"

namespace dem {
namespace {

std::string number_or_quantity(double value, Dimension dimension) {
  return dimension == Dimension::none ? toml_number(value) : toml_quoted(format_quantity(value, dimension));
}

std::string bare_bound(double value, Dimension dimension) { return format_quantity(value, dimension); }

std::string listed(const std::vector<std::string>& items) { return fmt::format("[{}]", fmt::join(items, ", ")); }

std::string grading_text(const Grading& grading) {
  // Four points a line keep a grading of a dozen points in a case on the screen.
  std::string text = "[";
  for (std::size_t i = 0; i < grading.size(); ++i) {
    text += i % 4 == 0 ? "\n  " : " ";
    text += fmt::format("[{}, {}],", toml_quoted(format_quantity(grading[i].size, Dimension::length)),
                        toml_number(grading[i].passing));
  }
  return text + "\n]";
}

std::string pebbles_text(const std::vector<ClumpShape>& shapes) {
  std::string text = "[";
  for (const ClumpShape& shape : shapes) {
    for (const Pebble& p : shape.pebbles) {
      text += fmt::format("\n  [{}, {}, {}, {}, {}],", toml_quoted(shape.name), toml_number(p.position.x),
                          toml_number(p.position.y), toml_number(p.position.z), toml_number(p.radius));
    }
  }
  return text + "\n]";
}

/// The value of a slot as TOML text.
struct ValueText {
  const Key& key;

  std::optional<std::string> operator()(const TestName& test) const { return toml_quoted(test.name); }
  std::optional<std::string> operator()(const double* value) const { return number_or_quantity(*value, key.dimension); }
  std::optional<std::string> operator()(const std::optional<double>* value) const {
    if (!*value) return std::nullopt;
    return number_or_quantity(**value, key.dimension);
  }
  std::optional<std::string> operator()(const QuantityOrWord& slot) const {
    return *slot.value ? number_or_quantity(**slot.value, key.dimension) : toml_quoted(slot.word);
  }
  std::optional<std::string> operator()(const int* value) const { return fmt::format("{}", *value); }
  std::optional<std::string> operator()(const std::optional<int>* value) const {
    if (!*value) return std::nullopt;
    return fmt::format("{}", **value);
  }
  std::optional<std::string> operator()(const std::uint64_t* value) const { return fmt::format("{}", *value); }
  std::optional<std::string> operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::optional<std::string> operator()(const std::string* value) const { return toml_quoted(*value); }
  std::optional<std::string> operator()(const ShapeNamesSlot& slot) const {
    std::vector<std::string> items;
    for (const std::string& item : *slot.names) items.push_back(toml_quoted(item));
    return listed(items);
  }
  std::optional<std::string> operator()(const std::vector<double>* value) const {
    if (value->empty() && !key.default_words.empty()) return std::nullopt;
    std::vector<std::string> items;
    for (const double item : *value) items.push_back(number_or_quantity(item, key.dimension));
    return listed(items);
  }
  std::optional<std::string> operator()(const GradingSlot& slot) const {
    if (slot.points->empty()) return std::nullopt;
    return grading_text(*slot.points);
  }
  std::optional<std::string> operator()(const ClumpTemplatesSlot& slot) const {
    if (slot.shapes->empty()) return std::nullopt;
    return pebbles_text(*slot.shapes);
  }
  template <class Enumeration>
  requires std::is_enum_v<Enumeration> std::optional<std::string>
  operator()(const Enumeration* value) const { return toml_quoted(key.choices[static_cast<std::size_t>(*value)]); }
};

}  // namespace

std::string Key::path() const { return section.empty() ? std::string(name) : fmt::format("{}.{}", section, name); }

const Key* Schema::find(std::string_view path) const {
  const auto found = std::find_if(keys.begin(), keys.end(), [path](const Key& key) { return key.path() == path; });
  return found == keys.end() ? nullptr : &*found;
}

bool Schema::has_section(std::string_view name) const {
  return std::any_of(sections.begin(), sections.end(), [name](const Section& section) {
    return section.name == name || section.name.starts_with(fmt::format("{}.", name));
  });
}

std::string range_text(const Key& key) {
  const bool has_least = std::isfinite(key.range.least);
  const bool has_most = std::isfinite(key.range.most);
  if (!has_least && !has_most) return {};
  return fmt::format("[{}, {}]", bare_bound(key.range.least, key.dimension), bare_bound(key.range.most, key.dimension));
}

std::string key_note(const Key& key) {
  std::string note(key.help);
  const bool is_number =
      std::holds_alternative<double*>(key.slot) || std::holds_alternative<std::optional<double>*>(key.slot);
  if (key.has_unit()) {
    note += fmt::format(", unit {}", accepted_units(key.dimension));
  } else if (is_number) {
    note += ", no unit";
  }
  if (!key.published.empty()) note += fmt::format(" (published: {})", key.published);
  return note;
}

std::optional<std::string> value_text(const Key& key) { return std::visit(ValueText{key}, key.slot); }

std::string toml_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string toml_number(double value) {
  std::string text = format_decimal(value);
  // Without a point or an exponent TOML reads a 64-bit integer.
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace dem
