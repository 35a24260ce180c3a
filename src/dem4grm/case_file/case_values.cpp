// SPDX-License-Identifier: BSD-3-Clause
// Reading of single values.
#include "dem4grm/case_file/case_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dem4grm/case_file/case_scalars.hpp"
#include "dem4grm/case_file/clump_file.hpp"
#include "dem4grm/case_file/grading_file.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_items = 1000;

/// Visits the slot of a key with the node that was given for it.
class ValueReader {
 public:
  ValueReader(const Key& key, const TomlNode& node, const std::filesystem::path& folder, CaseProblems& problems)
      : key_(key), node_(node), folder_(folder), problems_(problems), scalar_(key, problems) {}

  bool operator()(const TestName&) { return scalar_.choice(node_).has_value(); }
  bool operator()(double* slot) { return store(slot, scalar_.quantity(node_)); }
  bool operator()(std::optional<double>* slot) { return store(slot, scalar_.quantity(node_)); }
  bool operator()(int* slot) { return store(slot, scalar_.integer(node_)); }
  bool operator()(std::optional<int>* slot) { return store(slot, scalar_.integer(node_)); }

  bool operator()(const QuantityOrWord& slot) {
    if (!begins_with_letter()) return store(slot.value, scalar_.quantity(node_));
    slot.value->reset();
    return scalar_.is_word(node_, slot.word);
  }

  bool operator()(std::uint64_t* slot) { return store(slot, scalar_.natural(node_)); }

  bool operator()(bool* slot) {
    if (node_.kind != TomlKind::flag) return scalar_.wrong_kind(node_, "must be true or false, without quotes");
    *slot = node_.flag;
    return true;
  }

  bool operator()(std::string* slot) {
    if (!scalar_.is_sound_text(node_)) return false;
    *slot = node_.text;
    return true;
  }

  bool operator()(const ShapeNamesSlot& slot) {
    if (!is_list()) return scalar_.wrong_kind(node_, "must be a list of names, as [\"T1\", \"T2\"]");
    if (node_.items.empty()) return scalar_.fail(node_, "is empty; name at least one");
    Key with_own = key_;
    for (const ClumpShape& shape : slot.specimen->clump_templates) with_own.choices.emplace_back(shape.name);
    // A file of shapes that could not be read has its message; nobody knows which names it would have held.
    const bool is_checked = slot.specimen->clump_templates_file.empty() || !slot.specimen->clump_templates.empty();
    std::vector<std::string> names;
    bool is_good = true;
    for (const TomlNode& item : node_.items) {
      if (is_checked ? !ScalarReader(with_own, problems_).choice(item) : !scalar_.is_sound_text(item)) {
        is_good = false;
      } else if (std::find(names.begin(), names.end(), item.text) != names.end()) {
        is_good = scalar_.fail(item, "is listed twice");
      } else {
        names.push_back(item.text);
      }
    }
    *slot.names = std::move(names);
    return is_good;
  }

  bool operator()(std::vector<double>* slot) {
    if (!is_list()) {
      return scalar_.wrong_kind(node_, key_.has_unit() ? "must be a list, as [\"0.2 mm\", \"8 mm\"]"
                                                       : "must be a list of numbers, as [0.6, 0.4]");
    }
    std::vector<double> values;
    bool is_good = true;
    for (const TomlNode& item : node_.items) {
      const std::optional<double> value = scalar_.quantity(item);
      is_good = is_good && value.has_value();
      if (value) values.push_back(*value);
    }
    *slot = std::move(values);
    return is_good;
  }

  bool operator()(const GradingSlot& slot) {
    if (node_.kind == TomlKind::text) return read_grading(slot);
    if (!is_list()) {
      return scalar_.wrong_kind(node_,
                                "must be the name of a CSV file or a list, as [[\"3.5 mm\", 0.0], [\"8.5 mm\", 1.0]]");
    }
    return inline_grading(slot);
  }

  bool operator()(const ClumpTemplatesSlot& slot) {
    if (node_.kind == TomlKind::text) return read_clumps(slot);
    if (!is_list()) {
      return scalar_.wrong_kind(node_, "must be the name of a CSV file or a list, as [[\"egg\", 0, 0, 0, 1]]");
    }
    return inline_clumps(slot);
  }

  template <class Enumeration>
  requires std::is_enum_v<Enumeration>
  bool operator()(Enumeration* slot) {
    const std::optional<std::size_t> index = scalar_.choice(node_);
    if (index) *slot = static_cast<Enumeration>(*index);
    return index.has_value();
  }

 private:
  template <class Target, class Value>
  bool store(Target* slot, const std::optional<Value>& value) {
    if (value) *slot = *value;
    return value.has_value();
  }

  /// No number does; "inf" and "nan" are refused in the same words as any other.
  bool begins_with_letter() const {
    const std::size_t first = node_.text.find_first_not_of(" \t");
    if (node_.kind != TomlKind::text || first == std::string::npos) return false;
    const char c = node_.text[first];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  }

  bool is_list() const { return node_.kind == TomlKind::array && node_.items.size() <= k_most_items; }

  /// Reads the file that the key names and takes over its problems; what it holds goes to `take`.
  template <class Read, class Take>
  bool read_file(std::string& name, const Read& read, const Take& take) {
    if (!scalar_.is_sound_text(node_)) return false;
    name = node_.text;  // also of a file that is wrong: rules of other keys ask whether one is named
    try {
      auto file = read(folder_ / node_.text);
      for (std::string& text : file.problems) problems_.rendered_error(node_.place, std::move(text));
      take(file);
      return file.problems.empty();
    } catch (const Error& error) {
      problems_.error(node_.place, fmt::format("{}: {}", key_.path(), error.what()),
                      "paths count from the folder of the case file");
      return false;
    }
  }

  bool read_grading(const GradingSlot& slot) {
    return read_file(*slot.file, read_grading_file, [&](GradingFile& file) {
      *slot.points = std::move(file.points);
      if (file.notes.empty() || !file.problems.empty()) return;
      problems_.warning(node_.place, fmt::format("{}: {} is not in our form and was understood as: {}", key_.path(),
                                                 node_.text, fmt::join(file.notes, "; ")));
    });
  }

  bool inline_grading(const GradingSlot& slot) {
    Grading points;
    bool is_good = true;
    for (const TomlNode& item : node_.items) {
      const std::optional<GradingPoint> point = grading_point(item);
      is_good = is_good && point.has_value();
      if (point) points.push_back(*point);
    }
    if (!is_good) return false;
    for (const GradingFault& fault : grading_faults(points, PassingUnit::fraction)) {
      const TomlNode* place = &node_;
      if (fault.part != GradingFault::Part::whole) {
        place = &node_.items[fault.row].items[fault.part == GradingFault::Part::size ? 0 : 1];
      }
      problems_.error(place->place, fmt::format("{}: {}", key_.path(), fault.message), key_note(key_));
      is_good = false;
    }
    *slot.points = std::move(points);
    return is_good;
  }

  std::optional<GradingPoint> grading_point(const TomlNode& item) {
    if (item.kind != TomlKind::array || item.items.size() != 2) {
      problems_.error(item.place, fmt::format("{}: every point is a pair, as [\"5.6 mm\", 0.5]", key_.path()),
                      key_note(key_));
      return std::nullopt;
    }
    // A key of its own for each column, so that both get the messages of ordinary quantities.
    Key size = key_, passing = key_;
    size.dimension = Dimension::length;
    size.help = "sieve size";
    passing.help = "fraction passing by mass";
    passing.range = {0.0, 1.0};
    size.published = passing.published = {};
    const std::optional<double> size_value = ScalarReader(size, problems_).quantity(item.items[0]);
    const std::optional<double> share = ScalarReader(passing, problems_).quantity(item.items[1]);
    if (!size_value || !share) return std::nullopt;
    return GradingPoint{*size_value, *share};
  }

  bool read_clumps(const ClumpTemplatesSlot& slot) {
    return read_file(*slot.file, read_clump_file, [&](ClumpFile& file) { *slot.shapes = std::move(file.shapes); });
  }

  bool inline_clumps(const ClumpTemplatesSlot& slot) {
    std::vector<ClumpRow> rows;
    bool is_good = true;
    for (const TomlNode& item : node_.items) {
      const std::optional<ClumpRow> row = clump_row(item);
      is_good = is_good && row.has_value();
      if (row) rows.push_back(*row);
    }
    *slot.shapes = clump_shapes_of(rows);
    if (!is_good) return false;
    for (const ClumpFault& fault : clump_faults(rows)) {
      const TomlNode* place = &node_;
      if (fault.part != ClumpFault::Part::whole) {
        const TomlNode& row = node_.items[fault.row];
        place = fault.part == ClumpFault::Part::row ? &row : &row.items[static_cast<std::size_t>(fault.part)];
      }
      problems_.error(place->place, fmt::format("{}: {}", key_.path(), fault.message));
      is_good = false;
    }
    return is_good;
  }

  std::optional<ClumpRow> clump_row(const TomlNode& item) {
    if (item.kind != TomlKind::array || item.items.size() != 5 || item.items[0].kind != TomlKind::text) {
      problems_.error(
          item.place,
          fmt::format("{}: every pebble is [shape, x, y, z, radius], as [\"egg\", 0, 0, 0, 1]", key_.path()),
          key_note(key_));
      return std::nullopt;
    }
    std::array<double, 4> numbers{};
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::optional<double> number = scalar_.quantity(item.items[k + 1]);
      if (!number) return std::nullopt;
      numbers[k] = *number;
    }
    return ClumpRow{item.items[0].text, {{numbers[0], numbers[1], numbers[2]}, numbers[3]}};
  }

  const Key& key_;
  const TomlNode& node_;
  const std::filesystem::path& folder_;
  CaseProblems& problems_;
  ScalarReader scalar_;
};

}  // namespace

std::string shown_value(const TomlNode& node) {
  switch (node.kind) {
    case TomlKind::text:
    case TomlKind::option_text:
      return fmt::format("\"{}\"", printable(node.text, 40));
    case TomlKind::integer:
      return fmt::format("{}", node.integer);
    case TomlKind::number:
      return std::isfinite(node.number) ? format_decimal(node.number) : fmt::format("{}", node.number);
    case TomlKind::flag:
      return node.flag ? "true" : "false";
    case TomlKind::date:
      return "a date";
    case TomlKind::array:
      return "[...]";
    case TomlKind::table:
      return "{...}";
  }
  return "";
}

bool read_value(const Key& key, const TomlNode& node, const std::filesystem::path& folder, CaseProblems& problems) {
  const TomlNode typed = node.kind == TomlKind::option_text ? typed_option(key, node) : node;
  return std::visit(ValueReader(key, typed, folder, problems), key.slot);
}

}  // namespace dem
