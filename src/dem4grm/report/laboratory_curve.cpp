// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/laboratory_curve.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dem4grm/case_file/csv_text.hpp"
#include "dem4grm/case_file/grading_dialect.hpp"
#include "dem4grm/case_file/text_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"

namespace dem {
namespace {

constexpr std::size_t k_most_curve_rows = 100'000;
constexpr std::size_t k_most_problems = 20;

std::string small_letters(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool names_one_of(const std::string& text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](auto word) { return text.find(word) != std::string::npos; });
}

/// A column with the power of ten of its unit.
struct CurveColumn {
  std::size_t place = 0;
  int exponent = 0;
  std::string unit;
  bool is_downward = false;  ///< settlement: positive is compression
};

std::optional<CurveColumn> as_stress(const std::string& name, std::size_t place) {
  if (!names_one_of(name, {"stress", "tau"}) || names_one_of(name, {"normal", "vertical", "sigma"}))
    return std::nullopt;
  if (names_one_of(name, {"mpa", "n/mm"})) return CurveColumn{place, 6, "MPa"};
  if (names_one_of(name, {"kpa", "kn/m"})) return CurveColumn{place, 3, "kPa"};
  if (names_one_of(name, {"pa)", "pa]", "_pa", " pa"})) return CurveColumn{place, 0, "Pa"};
  return CurveColumn{place, 3, "kPa (no unit is named)"};
}

std::optional<CurveColumn> as_displacement(const std::string& name, std::size_t place) {
  if (!names_one_of(name, {"displ", "dilat", "settle", "movement", "travel", "delta"})) return std::nullopt;
  if (names_one_of(name, {"mm"})) return CurveColumn{place, -3, "mm"};
  if (names_one_of(name, {"um", "\xc2\xb5m", "\xce\xbcm", "micro"})) return CurveColumn{place, -6, "um"};
  if (names_one_of(name, {"cm"})) return CurveColumn{place, -2, "cm"};
  if (names_one_of(name, {"(m)", "[m]", "_m"})) return CurveColumn{place, 0, "m"};
  return CurveColumn{place, -3, "mm (no unit is named)"};
}

bool is_vertical(const std::string& name) { return names_one_of(name, {"vert", "dilat", "settle", "normal displ"}); }

struct CurveColumns {
  char separator = ',';
  std::optional<CurveColumn> displacement, stress, vertical;

  [[nodiscard]] std::string note() const {
    std::vector<std::string> words;
    words.push_back(fmt::format("displacement in {}", displacement->unit));
    if (stress) words.push_back(fmt::format("shear stress in {}", stress->unit));
    if (vertical) {
      words.push_back(
          fmt::format("vertical displacement in {}{}", vertical->unit,
                      vertical->is_downward ? ", settlement positive, turned round" : ", upwards positive"));
    }
    if (separator != ',')
      words.emplace_back(separator == ';' ? "columns parted by semicolons" : "columns parted by tabs");
    return fmt::format("read as {}", fmt::join(words, ", "));
  }
};

/// The columns that a header names; nothing when there is no horizontal displacement or nothing to draw against it.
std::optional<CurveColumns> columns_named_in(std::string_view header) {
  CurveColumns out;
  for (const char separator : {';', '\t'}) {
    if (out.separator == ',' && header.find(separator) != std::string_view::npos) out.separator = separator;
  }
  const std::vector<CsvField> names = fields_of_line(header, out.separator);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::string name = small_letters(names[k].text);
    if (const auto stress = as_stress(name, k)) {
      if (!out.stress) out.stress = stress;
    } else if (auto displacement = as_displacement(name, k)) {
      displacement->is_downward = names_one_of(name, {"settle"});
      std::optional<CurveColumn>& place = is_vertical(name) ? out.vertical : out.displacement;
      if (!place) place = displacement;
    }
  }
  if (!out.displacement || (!out.stress && !out.vertical)) return std::nullopt;
  return out;
}

class CurveReader {
 public:
  CurveReader(std::string_view text, std::string_view name) : text_(text, name) {}

  LaboratoryCurve run() {
    std::size_t line = find_header();
    for (; columns_ && line < text_.line_count() && problems_.size() < k_most_problems; ++line) take_line(line);
    if (columns_ && problems_.empty() && curve_.displacement.size() < 2) {
      problems_.push_back(text_.problem("fewer than two rows of numbers follow the header"));
    }
    if (!problems_.empty()) throw InputError(fmt::format("{}", fmt::join(problems_, "\n")));
    curve_.note = columns_->note();
    return std::move(curve_);
  }

 private:
  /// Laboratories put a few lines about the test before the table. Returns the line after the header.
  std::size_t find_header() {
    for (std::size_t line = 0; line < text_.line_count(); ++line) {
      columns_ = columns_named_in(text_.whole(line).text);
      if (columns_) return line + 1;
    }
    problems_.push_back(
        text_.problem("no line names the columns: one with a horizontal displacement and a shear stress or a vertical "
                      "displacement, as \"displacement_mm,shear_stress_kPa,vertical_displacement_mm\""));
    return text_.line_count();
  }

  void take_line(std::size_t line) {
    const std::vector<CsvField> fields = text_.fields_of(line, columns_->separator);
    const bool is_empty = std::all_of(fields.begin(), fields.end(), [](const CsvField& f) { return f.text.empty(); });
    if (is_empty || is_blank_or_comment(fields)) return;
    if (curve_.displacement.size() >= k_most_curve_rows) {
      problems_.push_back(text_.problem(line, text_.whole(line), fmt::format("more than {} rows", k_most_curve_rows)));
      return;
    }
    const std::optional<double> displacement = number(line, fields, *columns_->displacement, false);
    if (!displacement) return;
    curve_.displacement.push_back(*displacement);
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    if (columns_->stress)
      curve_.shear_stress.push_back(number(line, fields, *columns_->stress, true).value_or(nothing));
    if (columns_->vertical) {
      const double sign = columns_->vertical->is_downward ? -1.0 : 1.0;
      curve_.vertical_displacement.push_back(sign * number(line, fields, *columns_->vertical, true).value_or(nothing));
    }
  }

  std::optional<double> number(std::size_t line, const std::vector<CsvField>& fields, const CurveColumn& column,
                               bool may_be_empty) {
    if (column.place >= fields.size()) {
      problems_.push_back(text_.problem(line, text_.whole(line), "a column is missing"));
      return std::nullopt;
    }
    std::string text(fields[column.place].text);
    if (text.empty() && may_be_empty) return std::nullopt;
    if (columns_->separator != ',' && std::count(text.begin(), text.end(), ',') == 1) {
      std::replace(text.begin(), text.end(), ',', '.');
    }
    const std::optional<double> value = parse_decimal(text, column.exponent);
    if (!value) problems_.push_back(text_.problem(line, fields[column.place], not_a_number(fields[column.place])));
    return value;
  }

  CsvText text_;
  std::optional<CurveColumns> columns_;
  LaboratoryCurve curve_;
  std::vector<std::string> problems_;
};

JsonValue scaled_list(const std::vector<double>& values, double scale) {
  if (values.empty()) return {};
  JsonList out;
  for (const double value : values) out.emplace_back(value * scale);
  return out;
}

}  // namespace

LaboratoryCurve parse_laboratory_curve(std::string_view text, std::string_view name) {
  if (text.size() > k_largest_case_file) {
    throw InputError(
        fmt::format("{}:1:1: error: the file is larger than 1 MiB: this is not the curve of a test", name));
  }
  const std::string plain = without_utf16(text);
  return CurveReader(without_mark(plain), name).run();
}

LaboratoryCurve read_laboratory_curve(const std::filesystem::path& path) {
  LaboratoryCurve curve = parse_laboratory_curve(read_text_file(path), path.string());
  curve.name = path.stem().string();
  return curve;
}

JsonObject laboratory_as_json(const LaboratoryCurve& curve, const std::string& test) {
  return {{"name", curve.name},
          {"test", test.empty() ? JsonValue() : JsonValue(test)},
          {"displacement_mm", scaled_list(curve.displacement, 1e3)},
          {"shear_stress_kPa", scaled_list(curve.shear_stress, 1e-3)},
          {"vertical_displacement_mm", scaled_list(curve.vertical_displacement, 1e3)},
          {"note", curve.note}};
}

}  // namespace dem
