// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/study_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/case_file/case_values.hpp"
#include "dem4grm/case_file/nearest_name.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_axis_values = 10'000;

bool is_range(const TomlNode& node) {
  return node.kind == TomlKind::table && (find_member(node, "from") != nullptr || find_member(node, "step") != nullptr);
}

bool names_a_file(const Key& key) {
  return std::holds_alternative<GradingSlot>(key.slot) || std::holds_alternative<ClumpTemplatesSlot>(key.slot);
}

std::vector<const Key*> keys_called(const Schema& schema, std::string_view name) {
  std::vector<const Key*> found;
  for (const Key& key : schema.keys) {
    if (key.name == name) found.push_back(&key);
  }
  return found;
}

/// The text of a TOML string without its quotes; other text as it is.
std::string_view bare(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

/// Powers of ten between SI and the usual unit, so that 60 kPa is 60 in a column.
int usual_power(Dimension dimension) {
  const std::string_view unit = usual_unit(dimension);
  if (unit.empty()) return 0;
  const ParsedQuantity one = parse_quantity(fmt::format("1 {}", unit), dimension);
  return one.value ? static_cast<int>(std::lround(std::log10(*one.value))) : 0;
}

std::optional<double> number_of(const Key& key, std::string_view text) {
  if (key.dimension == Dimension::none) return parse_decimal(text);
  const std::optional<double> value = parse_quantity(bare(text), key.dimension).value;
  if (!value) return std::nullopt;
  return scaled_decimal(*value, usual_power(key.dimension));
}

/// Rounded to twelve digits, so that from + 3 step is 0.3 and not 0.30000000000000004.
double decimal(double value) { return parse_decimal(fmt::format("{:.12g}", value)).value_or(value); }

TomlNode node_of_number(const Key& key, double value, const Place& place) {
  TomlNode node;
  node.place = place;
  const bool is_whole = std::holds_alternative<int*>(key.slot) ||
                        std::holds_alternative<std::optional<int>*>(key.slot) ||
                        std::holds_alternative<std::uint64_t*>(key.slot);
  if (key.has_unit()) {
    node.kind = TomlKind::text;
    node.text = format_quantity(value, key.dimension);
  } else if (is_whole && value == std::floor(value) && std::fabs(value) < 9e15) {
    node.kind = TomlKind::integer;
    node.integer = static_cast<std::int64_t>(value);
  } else {
    node.kind = TomlKind::number;
    node.number = value;
  }
  return node;
}

/// The number of a bound or a step, SI; nothing for what is none, or without a unit.
std::optional<double> bound(const Key& key, const TomlNode& range, const char* name) {
  const TomlNode* node = find_member(range, name);
  if (node == nullptr) return std::nullopt;
  if (key.has_unit()) {
    return node->kind == TomlKind::text ? parse_quantity(node->text, key.dimension).value : std::nullopt;
  }
  if (node->kind == TomlKind::integer) return static_cast<double>(node->integer);
  return node->kind == TomlKind::number ? std::optional(node->number) : std::nullopt;
}

}  // namespace

std::string study_column(const Schema& schema, const Key& key) {
  std::string column = keys_called(schema, key.name).size() == 1 ? std::string(key.name) : key.path();
  std::replace(column.begin(), column.end(), '.', '_');
  std::string unit(usual_unit(key.dimension));
  if (unit.empty()) return column;
  if (const std::size_t slash = unit.find('/'); slash != std::string::npos) unit.replace(slash, 1, "_per_");
  return fmt::format("{}_{}", column, unit);
}

const Key* StudyTables::find_key(const TomlMember& member, const std::string& path) {
  const Key* key = schema_.find(path);
  const std::vector<const Key*> called = keys_called(schema_, path);
  if (called.size() == 1) key = called.front();
  if (key == nullptr && called.size() > 1) {
    std::vector<std::string> paths;
    paths.reserve(called.size());
    for (const Key* one : called) paths.push_back(one->path());
    problems_.error(member.key_place,
                    fmt::format("{} is the name of several keys: write {}", path, fmt::join(paths, " or ")));
    return nullptr;
  }
  if (key == nullptr) {
    std::vector<std::string_view> names;
    std::vector<std::string> paths;
    paths.reserve(schema_.keys.size());
    for (const Key& known : schema_.keys) paths.push_back(known.path());
    for (const Key& known : schema_.keys) names.push_back(known.name);
    names.insert(names.end(), paths.begin(), paths.end());
    const auto near = nearest_name(path, names);
    problems_.error(member.key_place, fmt::format("unknown key \"{}\"{}", printable(path),
                                                  near ? fmt::format("; did you mean \"{}\"?", *near) : ""));
    return nullptr;
  }
  if (std::holds_alternative<TestName>(key->slot) || key->path() == "name") {
    problems_.error(member.key_place, fmt::format("{} cannot differ from test to test of a study", path));
    return nullptr;
  }
  return key;
}

std::vector<StudyTables::Found> StudyTables::keys_of(const TomlNode& table, const std::string& section) {
  std::vector<Found> found;
  for (const TomlMember& member : table.members) {
    const std::string path = section.empty() ? member.key : fmt::format("{}.{}", section, member.key);
    if (member.value.kind == TomlKind::table && !is_range(member.value)) {
      for (const Found& inner : keys_of(member.value, path)) found.push_back(inner);
    } else if (const Key* key = find_key(member, path)) {
      const bool is_twice = std::any_of(found.begin(), found.end(), [key](const Found& f) { return f.key == key; });
      if (is_twice) problems_.error(member.key_place, fmt::format("{} is given twice", key->path()));
      if (!is_twice) found.push_back({key, &member});
    }
  }
  return found;
}

std::optional<StudyValue> StudyTables::read_one(const Key& key, const TomlNode& node) {
  if (node.kind == TomlKind::table) {
    problems_.error(node.place, fmt::format("{} takes one value here; a range belongs into [axes]", key.path()),
                    key_note(key));
    return std::nullopt;
  }
  if (!read_value(key, node, study_folder_, problems_)) return std::nullopt;
  StudyValue value{key.path(), value_text(key).value_or("\"\""), study_column(schema_, key), std::nullopt};
  // A table is laid out over several lines; as the value of a test it is one. Line breaks within texts are written as \n.
  std::replace(value.text.begin(), value.text.end(), '\n', ' ');
  if (names_a_file(key) && node.kind == TomlKind::text) {
    // The test reads the file from beside its case, and is told apart by the name of the file.
    const std::filesystem::path file = std::filesystem::absolute(study_folder_ / node.text);
    value.text = toml_quoted(file.lexically_relative(std::filesystem::absolute(case_folder_)).generic_string());
  }
  value.number = number_of(key, value.text);
  return value;
}

StudyValues StudyTables::read_values(const TomlNode& table) {
  StudyValues values;
  for (const auto& [key, member] : keys_of(table)) {
    if (auto value = read_one(*key, member->value)) values.push_back(std::move(*value));
  }
  return values;
}

StudyAxis StudyTables::read_list(const Key& key, const TomlMember& member) {
  const TomlNode& list = member.value;
  if (list.kind != TomlKind::array || list.items.empty()) {
    problems_.error(
        list.place,
        fmt::format("{} must be a list of values, as [a, b], or a range {{ from = a, to = b, step = c }}", key.path()),
        key_note(key));
    return {};
  }
  StudyAxis axis;
  for (const TomlNode& item : list.items) {
    std::optional<StudyValue> value = read_one(key, item);
    if (!value) continue;
    const bool is_twice =
        std::any_of(axis.begin(), axis.end(), [&](const StudyValues& v) { return v.front().text == value->text; });
    if (is_twice) {
      problems_.error(item.place, fmt::format("{} = {} is listed twice", key.path(), shown_value(item)));
    } else {
      axis.push_back({std::move(*value)});
    }
  }
  return axis;
}

StudyAxis StudyTables::read_range(const Key& key, const TomlMember& member) {
  const TomlNode& range = member.value;
  for (const TomlMember& part : range.members) {
    if (part.key == "from" || part.key == "to" || part.key == "step") continue;
    problems_.error(part.key_place, fmt::format("unknown key \"{}\" in a range: it takes from, to and step", part.key));
    return {};
  }
  const auto from = bound(key, range, "from"), to = bound(key, range, "to"), step = bound(key, range, "step");
  if (!from || !to || !step) {
    problems_.error(member.value.place,
                    fmt::format("the range of {} needs from, to and step, each a {}", key.path(),
                                key.has_unit() ? "number with its unit in quotes" : "number"),
                    key_note(key));
    return {};
  }
  const double count = std::floor((*to - *from) / *step + 1e-9) + 1.0;
  if (!(*step > 0.0) || !(count >= 1.0) || count > static_cast<double>(k_most_axis_values)) {
    problems_.error(member.value.place, fmt::format("the range of {} must rise from `from` to `to` in at most {} steps",
                                                    key.path(), k_most_axis_values));
    return {};
  }
  StudyAxis axis;
  for (int k = 0; k < static_cast<int>(count); ++k) {
    auto value = read_one(key, node_of_number(key, decimal(*from + k * *step), range.place));
    if (!value) return {};
    axis.push_back({std::move(*value)});
  }
  return axis;
}

StudyAxis StudyTables::read_axis(const Key& key, const TomlMember& member) {
  return is_range(member.value) ? read_range(key, member) : read_list(key, member);
}

std::vector<StudyAxis> StudyTables::read_axes(const TomlNode& table) {
  std::vector<StudyAxis> axes;
  for (const auto& [key, member] : keys_of(table)) axes.push_back(read_axis(*key, *member));
  return axes;
}

StudyAxis StudyTables::read_paired(const TomlMember& member, const TomlNode& table) {
  StudyAxis paired;
  std::string first;
  for (const auto& [key, one] : keys_of(table)) {
    // Paired lists may repeat a value: only the rows must differ.
    StudyAxis axis;
    if (one->value.kind == TomlKind::array) {
      for (const TomlNode& item : one->value.items) {
        if (auto value = read_one(*key, item)) axis.push_back({std::move(*value)});
      }
    } else {
      axis = read_axis(*key, *one);
    }
    if (first.empty()) {
      first = key->path();
      paired = std::move(axis);
    } else if (axis.size() != paired.size()) {
      problems_.error(one->key_place,
                      fmt::format("paired lists must be of one length: {} gives {} value(s), {} gives {}", first,
                                  paired.size(), key->path(), axis.size()));
    } else {
      for (std::size_t k = 0; k < axis.size(); ++k) paired[k].push_back(std::move(axis[k].front()));
    }
  }
  if (first.empty() && problems_.error_count() == 0) {
    problems_.error(member.key_place, "[[paired]] names no key");
  }
  return paired;
}

}  // namespace dem
