// SPDX-License-Identifier: BSD-3-Clause
// Rendering and ordering of the problems of a case.
#include "dem4grm/case_file/case_problems.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_shown = 100;  // a file with more wrong lines than that is not a case file
constexpr int k_excerpt_width = 100;

struct Excerpt {
  std::string text;
  int column = 0;  ///< of the caret, from 0
  int length = 1;
};

/// The line, or the part of a long line around the place.
Excerpt excerpt_of(std::string_view line, const Place& place) {
  const int length = character_count(line);
  const int column = std::clamp(place.column - 1, 0, length);
  const int begin = length > k_excerpt_width ? std::max(0, std::min(column - 30, length - k_excerpt_width)) : 0;
  Excerpt result;
  result.text = printable(characters(line, begin, k_excerpt_width), k_excerpt_width);
  result.column = column - begin;
  if (begin > 0) {
    result.text = "..." + result.text;
    result.column += 3;
  }
  if (begin + k_excerpt_width < length) result.text += "...";
  result.length = std::clamp(place.length, 1, std::max(1, std::min(length, begin + k_excerpt_width) - column));
  return result;
}

}  // namespace

std::string render_problem(std::string_view file, std::span<const std::string_view> lines, const Place& place,
                           std::string_view severity, std::string_view message, std::string_view note) {
  std::string text = fmt::format("{}:{}:{}: {}: {}", file, place.line, place.column, severity, message);
  const auto index = static_cast<std::size_t>(place.line - 1);
  if (place.length == 0 || index >= lines.size()) {
    return note.empty() ? text : fmt::format("{}\n      | {}", text, note);
  }
  const Excerpt excerpt = excerpt_of(lines[index], place);
  const std::string carets(static_cast<std::size_t>(excerpt.length), '^');
  const std::string pad(static_cast<std::size_t>(excerpt.column), ' ');
  text += fmt::format("\n{:>5} | {}\n      | {}{}", place.line, excerpt.text, pad, carets);
  if (!note.empty()) text += fmt::format(" {}", note);
  return text;
}

CaseProblems::CaseProblems(std::string file, std::string_view text, std::span<const Override> overrides)
    : file_(std::move(file)), lines_(split_lines(text)), overrides_(overrides) {}

bool CaseProblems::ignores(const Place& place) const {
  return place.option < 0 && place.length > 0 && ignored_lines_.contains(place.line);
}

void CaseProblems::error(const Place& place, std::string_view message, std::string_view note) {
  if (!ignores(place)) errors_.push_back({place, std::string(message), std::string(note)});
}

void CaseProblems::warning(const Place& place, std::string_view message, std::string_view note) {
  if (!ignores(place)) warnings_.push_back({place, std::string(message), std::string(note)});
}

void CaseProblems::rendered_error(const Place& place, std::string text) {
  if (!ignores(place)) errors_.push_back({place, std::move(text), {}, true});
}

std::string CaseProblems::render(const Entry& entry, std::string_view severity) const {
  if (entry.is_rendered) return entry.message;
  if (entry.place.option < 0) return render_problem(file_, lines_, entry.place, severity, entry.message, entry.note);
  const Override& option = overrides_[static_cast<std::size_t>(entry.place.option)];
  const std::string tail = entry.note.empty() ? std::string() : fmt::format("\n      | {}", entry.note);
  return fmt::format("{} {}={}: {}: {}{}", option.origin, printable(option.key), printable(option.value), severity,
                     entry.message, tail);
}

void CaseProblems::sort(std::vector<Entry>& entries) {
  const auto order = [](const Place& place) {
    return std::tuple(place.option >= 0, place.option, place.line, place.column);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return order(a.place) < order(b.place); });
}

void CaseProblems::throw_errors() {
  if (errors_.empty()) return;
  sort(errors_);
  std::string text;
  const std::size_t shown = std::min(errors_.size(), k_most_shown);
  std::vector<std::string> each;
  for (std::size_t i = 0; i < shown; ++i) {
    each.push_back(render(errors_[i], "error"));
    text += each.back() + "\n";
  }
  if (shown < errors_.size()) text += fmt::format("and {} more\n", errors_.size() - shown);
  text += fmt::format("{} error{}, nothing was run", errors_.size(), errors_.size() == 1 ? "" : "s");
  throw InputError(text, std::move(each));
}

std::vector<std::string> CaseProblems::take_warnings() {
  sort(warnings_);
  std::vector<std::string> texts;
  for (const Entry& entry : warnings_) texts.push_back(render(entry, "warning"));
  warnings_.clear();
  return texts;
}

}  // namespace dem
