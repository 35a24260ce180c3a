// SPDX-License-Identifier: BSD-3-Clause
// Edit distance for suggestions.
#include "dem4grm/case_file/nearest_name.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace dem {
namespace {

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '-') c = '_';
  }
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a_text, std::string_view b_text) {
  const std::string a = in_lower_case(a_text), b = in_lower_case(b_text);
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::optional<std::string_view> nearest_name(std::string_view name, std::span<const std::string_view> names) {
  constexpr std::size_t k_longest = 64;  // a longer name is no slip of the finger, and the distance would take long
  if (name.empty() || name.size() > k_longest) return std::nullopt;
  const std::string wanted = in_lower_case(name);
  std::optional<std::string_view> best;
  std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string_view candidate : names) {
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  if (best) return best;
  constexpr std::size_t k_shortest_part = 4;
  for (const std::string_view candidate : names) {
    if (name.size() >= k_shortest_part && candidate.find(wanted) != std::string_view::npos) return candidate;
  }
  return std::nullopt;
}

}  // namespace dem
