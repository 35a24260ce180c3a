// SPDX-License-Identifier: BSD-3-Clause
// Reading and checking of clump shapes.
#include "dem4grm/case_file/clump_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/case_file/csv_text.hpp"
#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

using Part = ClumpFault::Part;

constexpr std::size_t k_most_rows = 1000;
constexpr std::size_t k_longest_name = 40;
constexpr double k_largest_number = 1e6;  // cubes and fifth powers of it stay far inside the range of a double
constexpr std::string_view k_header = "shape,x,y,z,radius";
constexpr std::string_view k_columns_note =
    "name of the shape, then place and radius of a pebble in one unit of length, whatever it is";

/// First and last + 1 row of pebbles of one shape that stand together.
struct Run {
  std::size_t begin = 0, end = 0;
};

std::vector<Run> runs_of(std::span<const ClumpRow> rows) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k == 0 || rows[k].shape != rows[k - 1].shape) runs.push_back({k, k});
    runs.back().end = k + 1;
  }
  return runs;
}

std::vector<Pebble> pebbles_of(std::span<const ClumpRow> rows, const Run& run) {
  std::vector<Pebble> pebbles;
  for (std::size_t k = run.begin; k < run.end; ++k) pebbles.push_back(rows[k].pebble);
  return pebbles;
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= k_longest_name && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  });
}

void check_names(std::span<const ClumpRow> rows, const std::vector<Run>& runs, std::vector<ClumpFault>& faults) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::size_t row = runs[r].begin;
    const std::string& name = rows[row].shape;
    const std::string shown = printable(name, k_longest_name);
    const bool is_again = std::any_of(runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(r),
                                      [&](const Run& earlier) { return rows[earlier.begin].shape == name; });
    if (!is_plain_name(name)) {
      faults.push_back({row, Part::name,
                        fmt::format("\"{}\" is no name for a shape: 1 to {} letters, digits, '-', '_' or '.'", shown,
                                    k_longest_name)});
    } else if (is_again) {
      faults.push_back({row, Part::name,
                        fmt::format("shape \"{}\" is there already; the pebbles of one shape stand together", shown)});
    } else if (find_clump_template(name) != nullptr) {
      faults.push_back({row, Part::name, fmt::format("\"{}\" is a shape of the program; choose another name", shown)});
    }
  }
}

/// Faults of single numbers; true when there is none in the run.
bool check_numbers(std::span<const ClumpRow> rows, const Run& run, std::vector<ClumpFault>& faults) {
  const std::size_t before = faults.size();
  for (std::size_t k = run.begin; k < run.end; ++k) {
    const auto& [position, radius] = rows[k].pebble;
    // Written so that a value that is not a number is a fault as well.
    if (!(radius > 0.0)) {
      faults.push_back({k, Part::radius, fmt::format("radius {} is not positive", radius)});
    } else if (!(radius >= 1.0 / k_largest_number && radius <= k_largest_number)) {
      faults.push_back({k, Part::radius, fmt::format("radius {} is outside [1e-6, 1e6]; take another unit", radius)});
    }
    const auto check = [&](Part part, double value) {
      if (std::abs(value) <= k_largest_number) return;
      faults.push_back({k, part, fmt::format("place {} is outside [-1e6, 1e6]; take another unit", value)});
    };
    check(Part::x, position.x);
    check(Part::y, position.y);
    check(Part::z, position.z);
  }
  return faults.size() == before;
}

/// Reads the rows and remembers where each field stands.
class ClumpReader {
 public:
  ClumpReader(std::string_view text, std::string_view name) : text_(text, name) {}

  ClumpFile run() {
    for (std::size_t i = 0; i < text_.line_count(); ++i) {
      const std::vector<CsvField> fields = text_.fields_of(i);
      if (is_blank_or_comment(fields)) continue;
      if (!has_header_) {
        take_header(i, fields);
      } else if (rows_.size() < k_most_rows) {
        take_row(i, fields);
      } else {
        problem(i, fields[0], fmt::format("more than {} pebbles", k_most_rows));
        break;
      }
    }
    // Rules between rows say nothing useful about a table with holes.
    if (result_.problems.empty()) report_faults();
    result_.shapes = clump_shapes_of(rows_);
    return std::move(result_);
  }

 private:
  void take_header(std::size_t line, const std::vector<CsvField>& fields) {
    has_header_ = true;
    std::string found;
    for (const CsvField& field : fields) found += (found.empty() ? "" : ",") + std::string(field.text);
    if (found == k_header) return;
    problem(line, text_.whole(line), fmt::format("the first line must be the header \"{}\"", k_header), k_columns_note);
  }

  void take_row(std::size_t line, const std::vector<CsvField>& fields) {
    if (fields.size() != 5) {
      const bool has_semicolon = text_.whole(line).text.find(';') != std::string_view::npos;
      problem(line, text_.whole(line), fmt::format("{} instead of 5 fields", fields.size()),
              has_semicolon ? "separate the fields by a comma and write decimals with a point" : k_columns_note);
      return;
    }
    std::array<double, 4> numbers{};
    bool is_good = true;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const std::optional<double> number = parse_decimal(fields[k + 1].text);
      if (!number) problem(line, fields[k + 1], not_a_number(fields[k + 1]), k_columns_note);
      is_good = is_good && number.has_value();
      numbers[k] = number.value_or(0.0);
    }
    if (!is_good) return;
    rows_.push_back({std::string(fields[0].text), {{numbers[0], numbers[1], numbers[2]}, numbers[3]}});
    places_.push_back({line, {fields[0], fields[1], fields[2], fields[3], fields[4]}});
  }

  void report_faults() {
    for (const ClumpFault& fault : clump_faults(rows_)) {
      if (fault.part == Part::whole) {
        result_.problems.push_back(text_.problem(fault.message));
        continue;
      }
      const Place& place = places_[fault.row];
      const bool is_row = fault.part == Part::row;
      problem(place.line, is_row ? text_.whole(place.line) : place.fields[static_cast<std::size_t>(fault.part)],
              fault.message);
    }
  }

  void problem(std::size_t line, const CsvField& field, std::string_view message, std::string_view note = {}) {
    result_.problems.push_back(text_.problem(line, field, message, note));
  }

  struct Place {
    std::size_t line;
    std::array<CsvField, 5> fields;
  };

  CsvText text_;
  std::vector<ClumpRow> rows_;
  std::vector<Place> places_;
  ClumpFile result_;
  bool has_header_ = false;
};

}  // namespace

std::vector<ClumpFault> clump_faults(std::span<const ClumpRow> rows) {
  std::vector<ClumpFault> faults;
  if (rows.empty()) {
    faults.push_back({0, Part::whole, "there is no shape; write one pebble a line below the header"});
    return faults;
  }
  const std::vector<Run> runs = runs_of(rows);
  check_names(rows, runs, faults);
  for (const Run& run : runs) {
    if (!check_numbers(rows, run, faults)) continue;
    for (const PebbleFault& fault : pebble_faults(pebbles_of(rows, run))) {
      const std::size_t row = run.begin + fault.pebble;
      faults.push_back({row, Part::row, fmt::format("shape \"{}\": {}", rows[row].shape, fault.message)});
    }
  }
  std::stable_sort(faults.begin(), faults.end(),
                   [](const ClumpFault& a, const ClumpFault& b) { return a.row < b.row; });
  return faults;
}

std::vector<ClumpShape> clump_shapes_of(std::span<const ClumpRow> rows) {
  std::vector<ClumpShape> shapes;
  for (const Run& run : runs_of(rows)) shapes.push_back({rows[run.begin].shape, pebbles_of(rows, run)});
  return shapes;
}

ClumpFile parse_clumps(std::string_view text, std::string_view name) {
  text = without_mark(text);
  if (text.size() > k_largest_case_file) {
    return {{}, {fmt::format("{}:1:1: error: the file is larger than 1 MiB: this is no list of pebbles", name)}};
  }
  return ClumpReader(text, name).run();
}

ClumpFile read_clump_file(const std::filesystem::path& path) {
  return parse_clumps(read_text_file(path), printable(path.string(), 300));
}

}  // namespace dem
