// SPDX-License-Identifier: BSD-3-Clause
// Reading and checking of gradings.
#include "dem4grm/case_file/grading_file.hpp"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "dem4grm/case_file/csv_text.hpp"
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
      const std::vector<CsvField> fields = text_.fields_of(i);
      if (is_blank_or_comment(fields)) continue;
      if (!has_header_) {
        take_header(i, fields);
      } else if (result_.points.size() < k_most_grading_rows) {
        take_row(i, fields);
      } else {
        problem(i, fields[0], fmt::format("more than {} rows", k_most_grading_rows), "");
        break;
      }
    }
    // Rules between rows say nothing useful about a table with holes.
    if (result_.problems.empty()) report_faults();
    return std::move(result_);
  }

 private:
  void take_header(std::size_t line, const std::vector<CsvField>& fields) {
    has_header_ = true;
    const bool is_right =
        fields.size() == 2 && fmt::format("{},{}", fields[0].text, fields[1].text) == k_grading_header;
    if (!is_right) {
      problem(line, text_.whole(line), fmt::format("the first line must be the header \"{}\"", k_grading_header),
              "a table of sieve size in mm and per cent passing by mass");
    }
  }

  void take_row(std::size_t line, const std::vector<CsvField>& fields) {
    if (fields.size() != 2) {
      const bool has_semicolon = text_.whole(line).text.find(';') != std::string_view::npos;
      problem(line, text_.whole(line), fmt::format("{} instead of 2 numbers", fields.size()),
              has_semicolon ? "separate the numbers by a comma and write decimals with a point"
                            : "sieve size in mm, per cent passing by mass");
      return;
    }
    const std::optional<double> size = parse_decimal(fields[0].text, -3);
    const std::optional<double> passing = parse_decimal(fields[1].text, -2);
    if (!size) problem(line, fields[0], not_a_number(fields[0]), "sieve size in mm");
    if (!passing) problem(line, fields[1], not_a_number(fields[1]), "per cent passing by mass");
    if (!size || !passing) return;
    result_.points.push_back({*size, *passing});
    rows_.push_back({line, {fields[0], fields[1]}});
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
    return {{}, {fmt::format("{}:1:1: error: the file is larger than 1 MiB: this is not a grading", name)}};
  }
  return GradingReader(text, name).run();
}

GradingFile read_grading_file(const std::filesystem::path& path) {
  return parse_grading(read_text_file(path), printable(path.string(), 300));
}

}  // namespace dem
