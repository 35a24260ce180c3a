// SPDX-License-Identifier: BSD-3-Clause
// Names of tests from their values.
#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/campaign/study_axes.hpp"
#include "dem4grm/core/state_hash.hpp"

namespace dem {
namespace {

constexpr std::size_t k_longest_part = 40;

/// Three digits before the point, so that names sort as their values do.
std::string padded(double value) {
  const std::string text = format_decimal(value);
  const std::size_t digits = std::min(text.find('.'), text.size());
  return std::string(digits < 3 ? 3 - digits : 0, '0') + text;
}

bool is_usual_in_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-';
}

}  // namespace

std::string name_part(const StudyValue& value) {
  // The words of the field for the keys that nearly every study has. Only round numbers: others keep all their digits.
  if (value.number) {
    if (value.key == "specimen.rubber_content") return "vrc" + padded(scaled_decimal(*value.number, -2));
    if (value.key == "shear.normal_stress") return padded(*value.number) + "kPa";
    if (value.key == "seed") return fmt::format("seed{}", value.text);
  }
  // Of a file its name tells tests apart, wherever it lies.
  const std::size_t slash = value.number ? std::string::npos : value.text.rfind('/');
  std::string text;
  for (const char c : value.text.substr(slash == std::string::npos ? 0 : slash + 1)) {
    if (c == ' ' || c == '"') continue;
    text += is_usual_in_names(c) ? c : '_';
  }
  if (text.size() > k_longest_part) {
    StateHash hash;
    hash.add_bytes(value.text.data(), value.text.size());
    text = hash.text().substr(0, 12);
  }
  const std::size_t dot = value.key.rfind('.');
  std::string key = value.key.substr(dot == std::string::npos ? 0 : dot + 1);
  // A column without its unit has the section where two keys have one name.
  if (value.column.rfind(key, 0) != 0) key = value.key;
  return fmt::format("{}-{}", key, text);
}

}  // namespace dem
