// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/case_file/case_differences.hpp"

#include <algorithm>
#include <sstream>

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

}  // namespace

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
