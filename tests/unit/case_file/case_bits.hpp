// SPDX-License-Identifier: BSD-3-Clause
// Every value of a case as text that is equal only for equal bits, so that tests can compare whole cases.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "dem4grm/case_file/case_schema.hpp"

namespace dem::testing_support {

inline std::string bits_of(double value) { return std::to_string(std::bit_cast<std::uint64_t>(value)); }
inline std::string bits_of(const std::string& value) { return value; }
template <class Number>
requires std::is_integral_v<Number> || std::is_enum_v<Number> std::string bits_of(Number value) {
  return std::to_string(static_cast<std::int64_t>(value));
}
template <class Item>
std::string bits_of(const std::optional<Item>& value) {
  return value ? bits_of(*value) : "not set";
}
template <class Item>
std::string bits_of(const std::vector<Item>& values) {
  std::string text;
  for (const Item& item : values) text += bits_of(item) + ",";
  return text;
}

struct SlotBits {
  std::string operator()(const TestName& slot) const { return std::string(slot.name); }
  std::string operator()(const GradingSlot& slot) const {
    std::string text = *slot.file;
    for (const GradingPoint& point : *slot.points) text += " " + bits_of(point.size) + "/" + bits_of(point.passing);
    return text;
  }
  std::string operator()(const ClumpTemplatesSlot& slot) const {
    std::string text = *slot.file;
    for (const ClumpShape& shape : *slot.shapes) {
      text += " " + shape.name;
      for (const auto& [p, radius] : shape.pebbles) {
        text += "/" + bits_of(p.x) + "," + bits_of(p.y) + "," + bits_of(p.z) + "," + bits_of(radius);
      }
    }
    return text;
  }
  std::string operator()(const ShapeNamesSlot& slot) const { return bits_of(*slot.names); }
  std::string operator()(const QuantityOrWord& slot) const { return bits_of(*slot.value); }
  template <class Value>
  std::string operator()(const Value* slot) const {
    return bits_of(*slot);
  }
};

/// One line for each key: path=bits.
template <class Test>
std::vector<std::string> all_bits(Test test) {
  std::vector<std::string> bits;
  for (const Key& key : case_schema(test).keys) bits.push_back(key.path() + "=" + std::visit(SlotBits{}, key.slot));
  return bits;
}

}  // namespace dem::testing_support
