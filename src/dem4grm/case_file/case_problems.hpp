// SPDX-License-Identifier: BSD-3-Clause
// Collects everything that is wrong with a case, and renders it in the order of the file.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/case_file/case_override.hpp"
#include "dem4grm/case_file/toml_scan.hpp"

namespace dem {

/// `file:line:column: severity: message`, the line of the text and a caret with the note below the place:
///
///     case.toml:12:12: error: rubber.friction = -0.27 is outside [0, 5]
///        12 | friction = -0.27
///           |            ^^^^^ friction coefficient, no unit (published: 0.27)
std::string render_problem(std::string_view file, std::span<const std::string_view> lines, const Place& place,
                           std::string_view severity, std::string_view message, std::string_view note);

class CaseProblems {
 public:
  /// `text` and `overrides` must outlive this object.
  CaseProblems(std::string file, std::string_view text, std::span<const Override> overrides);

  void error(const Place& place, std::string_view message, std::string_view note = {});
  void warning(const Place& place, std::string_view message, std::string_view note = {});
  /// Errors of another file, already rendered; `place` is where the case names that file.
  void rendered_error(const Place& place, std::string text);
  /// Errors on these lines of the file are dropped from now on: the lines have their own message already.
  void ignore_lines(std::set<int> lines) { ignored_lines_ = std::move(lines); }
  [[nodiscard]] bool ignores(const Place& place) const;

  [[nodiscard]] std::size_t error_count() const { return errors_.size(); }
  /// Throws InputError with all errors, then "n errors, nothing was run"; returns when there is none.
  void throw_errors();
  /// Rendered warnings in the order of the file.
  [[nodiscard]] std::vector<std::string> take_warnings();

 private:
  /// Rendered only when shown: a hostile file may hold a hundred thousand problems in one long line.
  struct Entry {
    Place place;
    std::string message, note;
    bool is_rendered = false;
  };
  [[nodiscard]] std::string render(const Entry& entry, std::string_view severity) const;
  static void sort(std::vector<Entry>& entries);

  std::string file_;
  std::vector<std::string_view> lines_;
  std::span<const Override> overrides_;
  std::set<int> ignored_lines_;
  std::vector<Entry> errors_, warnings_;
};

}  // namespace dem
