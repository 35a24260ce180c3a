// SPDX-License-Identifier: BSD-3-Clause
// Reading and checking of gradings.
#include "dem4grm/case_file/grading_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "dem4grm/case_file/csv_text.hpp"
#include "dem4grm/case_file/grading_dialect.hpp"
#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_grading_rows = 1000;
constexpr std::string_view k_grading_header = "size_mm,passing_percent";

std::string shown_size(double size) { return format_quantity(size, Dimension::length); }

std::string shown_passing(double passing, PassingUnit unit) {
  return unit == PassingUnit::percent ? format_decimal(passing, -2) + " %" : format_decimal(passing);
}

/// Reads the rows and remembers where each number stands.
class GradingReader {
 public:
  GradingReader(std::string_view text, std::string_view name) : text_(text, name) {}

  GradingFile run() {
    for (std::size_t i = 0; i < text_.line_count(); ++i) {
      std::vector<CsvField> fields = text_.fields_of(i, dialect_.separator);
      while (fields.size() > 2 && fields.back().text.empty()) fields.pop_back();  // as spreadsheets leave them
      if (is_blank_or_comment(fields) || std::all_of(fields.begin(), fields.end(), is_empty)) continue;
      if (!has_header_) {
        take_header(i);
      } else if (result_.points.size() < k_most_grading_rows) {
        take_row(i, fields);
      } else {
        problem(i, fields[0], fmt::format("more than {} rows", k_most_grading_rows), "");
        break;
      }
    }
    if (result_.problems.empty()) put_in_order();
    // Rules between rows say nothing useful about a table with holes.
    if (result_.problems.empty()) report_faults();
    return std::move(result_);
  }

 private:
  static bool is_empty(const CsvField& field) { return field.text.empty(); }

  void take_header(std::size_t line) {
    has_header_ = true;
    std::string_view header = text_.whole(line).text;
    while (header.ends_with(',')) header.remove_suffix(1);
    if (std::optional<GradingDialect> dialect = grading_dialect(header)) {
      dialect_ = std::move(*dialect);
      result_.notes = dialect_.notes;
      return;
    }
    problem(line, text_.whole(line), fmt::format("the first line must be the header \"{}\"", k_grading_header),
            "or one that names a size with its unit and a share: passing, finer or cumulative retained; percent or "
            "fraction");
  }

  std::optional<double> number(const CsvField& field, int exponent) const {
    std::string text(field.text);
    if (dialect_.has_decimal_commas && std::count(text.begin(), text.end(), ',') == 1) {
      std::replace(text.begin(), text.end(), ',', '.');
    }
    return parse_decimal(text, exponent);
  }

  void take_row(std::size_t line, const std::vector<CsvField>& fields) {
    if (fields.size() != 2) {
      const bool has_semicolon = text_.whole(line).text.find(';') != std::string_view::npos;
      problem(line, text_.whole(line), fmt::format("{} instead of 2 numbers", fields.size()),
              has_semicolon
                  ? "separate the columns in the header by what separates them here"
                  : "sieve size, share passing by mass; decimal commas need semicolons or tabs between columns");
      return;
    }
    const std::optional<double> size = number(fields[0], dialect_.size_exponent);
    std::optional<double> passing = number(fields[1], dialect_.share_exponent);
    if (!size) problem(line, fields[0], not_a_number(fields[0]), "sieve size");
    if (!passing) problem(line, fields[1], not_a_number(fields[1]), "share passing by mass");
    if (!size || !passing) return;
    // Decimals of a laboratory, not those of the subtraction.
    if (dialect_.is_retained) passing = std::round((1.0 - *passing) * 1e12) * 1e-12;
    result_.points.push_back({*size, *passing});
    rows_.push_back({line, {fields[0], fields[1]}});
  }

  /// Laboratories list the coarsest sieve first as often as last.
  void put_in_order() {
    const auto falls = [](const GradingPoint& a, const GradingPoint& b) { return !(b.size < a.size); };
    if (result_.points.size() < 2 ||
        std::adjacent_find(result_.points.begin(), result_.points.end(), falls) != result_.points.end()) {
      return;
    }
    std::reverse(result_.points.begin(), result_.points.end());
    std::reverse(rows_.begin(), rows_.end());
    result_.notes.emplace_back("from the coarsest sieve down");
  }

  void report_faults() {
    for (const GradingFault& fault : grading_faults(result_.points, PassingUnit::percent)) {
      if (fault.part == GradingFault::Part::whole || fault.row >= rows_.size()) {
        result_.problems.push_back(text_.problem(fault.message));
        continue;
      }
      const Row& row = rows_[fault.row];
      problem(row.line, row.fields[fault.part == GradingFault::Part::size ? 0 : 1], fault.message, "");
    }
  }

  void problem(std::size_t line, const CsvField& field, std::string_view message, std::string_view note) {
    result_.problems.push_back(text_.problem(line, field, message, note));
  }

  struct Row {
    std::size_t line;
    std::array<CsvField, 2> fields;
  };

  CsvText text_;
  std::vector<Row> rows_;
  GradingFile result_;
  GradingDialect dialect_;
  bool has_header_ = false;
};

}  // namespace

std::vector<GradingFault> grading_faults(const Grading& grading, PassingUnit unit) {
  using Part = GradingFault::Part;
  std::vector<GradingFault> faults;
  if (grading.size() < 2) {
    faults.push_back({0, Part::whole,
                      "a grading needs at least two rows: the sieve that nothing passes and the one "
                      "that everything passes"});
    return faults;
  }
  for (std::size_t i = 0; i < grading.size(); ++i) {
    const auto [size, passing] = grading[i];
    // Written so that a value that is not a number is a fault as well.
    if (!(size >= 1e-6 && size <= 1.0)) {
      faults.push_back({i, Part::size, fmt::format("sieve size {} is outside [0.001 mm, 1000 mm]", shown_size(size))});
    } else if (i > 0 && size <= grading[i - 1].size) {
      faults.push_back(
          {i, Part::size,
           fmt::format("sieve sizes must increase: {} after {}", shown_size(size), shown_size(grading[i - 1].size))});
    }
    if (!(passing >= 0.0 && passing <= 1.0)) {
      faults.push_back({i, Part::passing,
                        fmt::format("passing {} is outside [{}, {}]", shown_passing(passing, unit),
                                    shown_passing(0.0, unit), shown_passing(1.0, unit))});
    } else if (i > 0 && passing < grading[i - 1].passing) {
      faults.push_back({i, Part::passing,
                        fmt::format("the share that passes must not fall: {} after {}", shown_passing(passing, unit),
                                    shown_passing(grading[i - 1].passing, unit))});
    } else if (i == 0 && passing != 0.0) {
      faults.push_back(
          {i, Part::passing, fmt::format("the first row must pass 0, not {}", shown_passing(passing, unit))});
    } else if (i + 1 == grading.size() && passing != 1.0) {
      faults.push_back(
          {i, Part::passing,
           fmt::format("the last row must pass {}, not {}", shown_passing(1.0, unit), shown_passing(passing, unit))});
    }
  }
  return faults;
}

GradingFile parse_grading(std::string_view text, std::string_view name) {
  text = without_mark(text);
  if (text.size() > k_largest_case_file) {
    GradingFile refused;
    refused.problems.push_back(
        fmt::format("{}:1:1: error: the file is larger than 1 MiB: this is not a grading", name));
    return refused;
  }
  const std::string plain = without_utf16(text);
  GradingFile file = GradingReader(without_mark(plain), name).run();
  if (plain.size() != text.size()) file.notes.insert(file.notes.begin(), "UTF-16 text");
  return file;
}

GradingFile read_grading_file(const std::filesystem::path& path) {
  return parse_grading(read_text_file(path), printable(path.string(), 300));
}

}  // namespace dem
