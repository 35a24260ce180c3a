// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the literature that a report shows beside ours, from a CSV file: cases/paper/published.csv, or a user's own.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/results/json_text.hpp"

namespace dem {

struct PublishedValue {
  double rubber_content = 0.0;
  std::optional<double> normal_stress_kPa;  ///< nothing: holds for all
  std::string quantity;                     ///< a name of summary.json
  double value = 0.0;
  std::string source;
};

/// Header "rubber_content,normal_stress_kPa,quantity,value,source"; lines that begin with # are comments. Throws InputError with every
/// problem at its line and column; `name` stands for the file.
std::vector<PublishedValue> parse_published_values(std::string_view text, std::string_view name);

/// The shipped file as it was when the program was built.
std::string_view shipped_published_values();

JsonList published_as_json(const std::vector<PublishedValue>& values);

}  // namespace dem
