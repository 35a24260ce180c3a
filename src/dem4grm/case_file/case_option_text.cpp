// SPDX-License-Identifier: BSD-3-Clause
// The text of a --set option becomes a value of the kind that its key asks for.
#include <charconv>

#include <fmt/format.h>

#include "dem4grm/case_file/case_values.hpp"

namespace dem {
namespace {

std::string_view trimmed(std::string_view text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  while (text.ends_with(' ') || text.ends_with('\t')) text.remove_suffix(1);
  return text;
}

std::string without_quotes(std::string_view text) {
  text = trimmed(text);
  const bool is_quoted =
      text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return std::string(is_quoted ? text.substr(1, text.size() - 2) : text);
}

TomlNode text_node(std::string_view text) {
  TomlNode node;
  node.kind = TomlKind::text;
  node.text = without_quotes(text);
  return node;
}

/// A number or a flag when the whole text is one; else text, which the reader then refuses with its own words.
TomlNode plain_node(std::string_view text) {
  TomlNode node;
  text = trimmed(text);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), node.integer);
  if (error == std::errc{} && end == text.data() + text.size()) {
    node.kind = TomlKind::integer;
  } else if (const std::optional<double> number = parse_decimal(text)) {
    node.kind = TomlKind::number;
    node.number = *number;
  } else if (text == "true" || text == "false") {
    node.kind = TomlKind::flag;
    node.flag = text == "true";
  } else {
    return text_node(text);
  }
  return node;
}

TomlNode list_node(const Key& key, std::string_view text) {
  const bool is_of_numbers = std::holds_alternative<std::vector<double>*>(key.slot) && !key.has_unit();
  TomlNode list;
  list.kind = TomlKind::array;
  while (!trimmed(text).empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    list.items.push_back(is_of_numbers ? plain_node(item) : text_node(item));
    text = comma == std::string_view::npos ? std::string_view() : text.substr(comma + 1);
  }
  return list;
}

/// The list in the brackets as TOML reads it; text when it does not.
TomlNode bracketed_node(std::string_view text) {
  const TomlDocument document = parse_toml(fmt::format("value = {}", text));
  const TomlNode* value = document.problems.empty() ? find_member(document.root, "value") : nullptr;
  return value != nullptr ? *value : text_node(text);
}

void move_to(TomlNode& node, const Place& place) {
  node.place = place;
  for (TomlNode& item : node.items) move_to(item, place);
  for (TomlMember& member : node.members) {
    member.key_place = place;
    move_to(member.value, place);
  }
}

TomlNode node_for(const Key& key, std::string_view text) {
  const bool is_list =
      std::holds_alternative<ShapeNamesSlot>(key.slot) || std::holds_alternative<std::vector<double>*>(key.slot);
  const bool is_table =
      std::holds_alternative<GradingSlot>(key.slot) || std::holds_alternative<ClumpTemplatesSlot>(key.slot);
  if ((is_list || is_table) && trimmed(text).starts_with('[')) return bracketed_node(text);
  if (is_list) return list_node(key, text);
  const bool is_plain =
      std::holds_alternative<int*>(key.slot) || std::holds_alternative<std::optional<int>*>(key.slot) ||
      std::holds_alternative<std::uint64_t*>(key.slot) || std::holds_alternative<bool*>(key.slot) ||
      std::holds_alternative<double*>(key.slot) || std::holds_alternative<std::optional<double>*>(key.slot);
  // A quantity without its unit is text here: parse_quantity says that the unit is missing.
  return is_plain && !key.has_unit() ? plain_node(text) : text_node(text);
}

}  // namespace

TomlNode typed_option(const Key& key, const TomlNode& node) {
  TomlNode typed = node_for(key, node.text);
  move_to(typed, node.place);
  return typed;
}

}  // namespace dem
