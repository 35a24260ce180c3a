// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/case_differences.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>

#include "dem4grm/case_file/case_schema.hpp"

namespace dem {
namespace {

/// The settings of a resolved case with their sections, without comments: "shear.normal_stress = "60 kPa"".
std::vector<std::string> settings_of(const std::string& text) {
  std::vector<std::string> settings;
  std::istringstream in(text);
  std::string section;
  for (std::string line; std::getline(in, line);) {
    line = line.substr(0, line.find("  # "));
    if (line.starts_with('[') && line.ends_with(']')) {
      section = line.substr(1, line.size() - 2) + '.';
    } else if (!line.empty() && !line.starts_with('#')) {
      settings.push_back((line.find(" = ") == std::string::npos ? "" : section) + line);
    }
  }
  return settings;
}

/// A value on one line, as a message shows it.
std::string shown(const std::optional<std::string>& value) {
  constexpr std::size_t k_longest = 60;
  if (!value) return "not set";
  std::string text = *value;
  std::replace(text.begin(), text.end(), '\n', ' ');
  const bool is_text = text.size() > 1 && text.front() == '"' && text.back() == '"';
  if (is_text) text = text.substr(1, text.size() - 2);
  return text.size() > k_longest ? text.substr(0, k_longest) + "..." : text;
}

}  // namespace

std::vector<KeyChange> case_changes(DirectShearCase before, DirectShearCase after) {
  const Schema a = case_schema(before), b = case_schema(after);
  std::vector<KeyChange> changes;
  for (std::size_t k = 0; k < a.keys.size(); ++k) {
    const std::optional<std::string> old_value = value_text(a.keys[k]), new_value = value_text(b.keys[k]);
    if (old_value != new_value) changes.push_back({a.keys[k].path(), shown(old_value), shown(new_value)});
  }
  return changes;
}

std::vector<std::string> case_differences(const std::string& stored, const std::string& wanted) {
  const std::vector<std::string> a = settings_of(stored), b = settings_of(wanted);
  std::vector<std::string> out;
  for (const std::string& line : a) {
    if (std::find(b.begin(), b.end(), line) == b.end()) out.push_back("made with  " + line);
  }
  for (const std::string& line : b) {
    if (std::find(a.begin(), a.end(), line) == a.end()) out.push_back("the case has  " + line);
  }
  return out;
}

}  // namespace dem
