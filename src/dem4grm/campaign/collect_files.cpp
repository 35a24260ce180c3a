// SPDX-License-Identifier: BSD-3-Clause
// Writing of the files of a collection.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dem4grm/campaign/collect.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double k_degrees_of_radian = 180.0 / std::numbers::pi;

/// A cell of a CSV file; quotes only where they are needed.
void append_cell(std::string& line, std::string_view text) {
  if (text.find_first_of(",\"\n") == std::string_view::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) line += c == '"' ? "\"\"" : std::string(1, c);
  line += '"';
}

/// The text of a value without the quotes of TOML.
std::string_view bare_text(std::string_view text) {
  return text.size() >= 2 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

const StudyValue* value_in(const CollectedTest& test, const std::string& column) {
  for (const StudyValue& value : test.values) {
    if (value.column == column) return &value;
  }
  return nullptr;
}

void append_value(std::string& line, const StudyValue* value) {
  line += ',';
  if (value == nullptr) return;
  if (value->number) append_number(line, *value->number);
  if (!value->number) append_cell(line, bare_text(value->text));
}

/// "name,value of the study,...": what every row of a test begins with.
std::string beginning_of_rows(const Collection& c, const CollectedTest& test) {
  std::string line;
  append_cell(line, test.name);
  for (const std::string& column : c.columns) append_value(line, value_in(test, column));
  return line;
}

std::string header_of(const Collection& c) {
  std::string line = "test";
  for (const std::string& column : c.columns) line += "," + column;
  return line;
}

void append_json(std::string& line, const JsonValue& value) {
  if (const auto* number = std::get_if<double>(&value.data)) append_number(line, *number);
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) line += fmt::format("{}", *whole);
  if (const auto* flag = std::get_if<bool>(&value.data)) line += *flag ? "1" : "0";
  if (const auto* text = std::get_if<std::string>(&value.data)) append_cell(line, *text);
}

std::vector<std::string> summary_names(const Collection& c) {
  std::vector<std::string> names;
  for (const JsonObject& summary : c.summaries) {
    for (const JsonField& field : summary) {
      if (std::find(names.begin(), names.end(), field.name) == names.end()) names.push_back(field.name);
    }
  }
  return names;
}

std::string tests_csv(const Collection& c) {
  const std::vector<std::string> names = summary_names(c);
  std::string text = header_of(c);
  // The kind of test stands under a name of its own, since `test` is the name of the test here.
  for (const std::string& name : names) text += "," + (name == "test" ? "kind_of_test" : name);
  text += '\n';
  for (std::size_t k = 0; k < c.tests.size(); ++k) {
    text += beginning_of_rows(c, c.tests[k]);
    for (const std::string& name : names) {
      text += ',';
      if (const JsonValue* value = find_field(c.summaries[k], name)) append_json(text, *value);
    }
    text += '\n';
  }
  return text;
}

/// "kPa" of "peak_shear_stress_kPa"; "1" when the name has none.
std::string_view unit_of_name(std::string_view name) {
  constexpr std::string_view k_units[] = {"mm_per_s", "kg_per_m3", "N_per_mm", "kPa_per_mm", "per_cent", "kPa", "deg",
                                          "mm",       "us",        "N",        "J",          "MB",       "s"};
  for (const std::string_view unit : k_units) {
    if (name.size() > unit.size() + 1 && name.ends_with(unit) && name[name.size() - unit.size() - 1] == '_')
      return unit;
  }
  return "1";
}

void append_curves(std::string& text, const std::vector<std::string>& beginnings, const char* name,
                   const CollectedTable& table) {
  if (table.columns.empty()) return;
  // The first column is what the others are drawn against.
  const CollectedTable::Column& along = table.columns.front();
  for (std::size_t row = 0; row < table.test.size(); ++row) {
    std::string beginning = beginnings[static_cast<std::size_t>(table.test[row])];
    beginning += fmt::format(",{},", name);
    append_number(beginning, along.values[row]);
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
      const double value = table.columns[c].values[row];
      if (!std::isfinite(value)) continue;
      text += beginning;
      text += ',';
      text += table.columns[c].name;
      text += ',';
      text += table.columns[c].unit;
      text += ',';
      append_number(text, value);
      text += '\n';
    }
  }
}

std::string collected_csv(const Collection& c) {
  const bool has_strain = !c.compression.columns.empty();
  std::string text = header_of(c) + ",table," + (has_strain ? "displacement_mm_or_strain" : "displacement_mm") +
                     ",quantity,unit,value\n";
  std::vector<std::string> beginnings;
  for (const CollectedTest& test : c.tests) beginnings.push_back(beginning_of_rows(c, test));
  for (std::size_t k = 0; k < c.tests.size(); ++k) {
    for (const JsonField& field : c.summaries[k]) {
      const bool is_number = std::holds_alternative<double>(field.value.data) ||
                             std::holds_alternative<std::int64_t>(field.value.data) ||
                             std::holds_alternative<bool>(field.value.data);
      if (!is_number) continue;
      text += beginnings[k] + ",summary,," + field.name + ",";
      text += unit_of_name(field.name);
      text += ',';
      append_json(text, field.value);
      text += '\n';
    }
  }
  append_curves(text, beginnings, "shear", c.shear);
  append_curves(text, beginnings, "micro", c.micro);
  append_curves(text, beginnings, "compression", c.compression);
  return text;
}

/// A column of the table of envelopes.
struct EnvelopeColumn {
  const char* name;
  const char* unit;
  const char* description;
  double (*value)(const MixtureEnvelope&);
};

double scaled(const std::optional<Estimate>& e, double scale) { return e ? scale * e->value : k_unknown; }
double low_of(const std::optional<Estimate>& e, double scale) { return e && e->low ? scale * *e->low : k_unknown; }
double high_of(const std::optional<Estimate>& e, double scale) { return e && e->high ? scale * *e->high : k_unknown; }

using E = MixtureEnvelope;
constexpr double k_kilo = 1e-3;
const EnvelopeColumn k_envelope_columns[] = {
    {"tests", "1", "tests of the mixture", [](const E& e) { return static_cast<double>(e.fit.points); }},
    {"normal_stresses", "1", "different normal stresses",
     [](const E& e) { return static_cast<double>(e.fit.stresses); }},
    {"hardening", "1", "tests whose stress still rose at the end",
     [](const E& e) { return static_cast<double>(e.hardening); }},
    {"friction_angle_deg", "deg", "friction angle",
     [](const E& e) { return scaled(e.fit.friction_angle, k_degrees_of_radian); }},
    {"friction_angle_low_deg", "deg", "lower 95 % bound of the friction angle",
     [](const E& e) { return low_of(e.fit.friction_angle, k_degrees_of_radian); }},
    {"friction_angle_high_deg", "deg", "upper 95 % bound of the friction angle",
     [](const E& e) { return high_of(e.fit.friction_angle, k_degrees_of_radian); }},
    {"cohesion_kPa", "kPa", "cohesion (intercept)", [](const E& e) { return scaled(e.fit.cohesion, k_kilo); }},
    {"cohesion_low_kPa", "kPa", "lower 95 % bound of the cohesion",
     [](const E& e) { return low_of(e.fit.cohesion, k_kilo); }},
    {"cohesion_high_kPa", "kPa", "upper 95 % bound of the cohesion",
     [](const E& e) { return high_of(e.fit.cohesion, k_kilo); }},
    {"origin_friction_angle_deg", "deg", "friction angle of the line through the origin",
     [](const E& e) { return scaled(e.fit.angle_through_origin, k_degrees_of_radian); }},
    {"origin_friction_angle_low_deg", "deg", "its lower 95 % bound",
     [](const E& e) { return low_of(e.fit.angle_through_origin, k_degrees_of_radian); }},
    {"origin_friction_angle_high_deg", "deg", "its upper 95 % bound",
     [](const E& e) { return high_of(e.fit.angle_through_origin, k_degrees_of_radian); }},
    {"residual_deviation_kPa", "kPa", "standard deviation of the tests off the line",
     [](const E& e) { return e.fit.residual_deviation ? k_kilo * *e.fit.residual_deviation : k_unknown; }},
    {"r2", "1", "coefficient of determination", [](const E& e) { return e.fit.determination.value_or(k_unknown); }},
};

const StudyValue* value_in(const MixtureEnvelope& e, const std::string& column) {
  for (const StudyValue& value : e.values) {
    if (value.column == column) return &value;
  }
  return nullptr;
}

/// Columns of the study that tell mixtures apart.
std::vector<std::string> mixture_columns(const Collection& c) {
  std::vector<std::string> columns;
  for (const std::string& column : c.columns) {
    const bool is_used = std::any_of(c.envelopes.begin(), c.envelopes.end(),
                                     [&](const MixtureEnvelope& e) { return value_in(e, column) != nullptr; });
    if (is_used) columns.push_back(column);
  }
  return columns;
}

std::string envelopes_csv(const Collection& c) {
  std::string text;
  const std::vector<std::string> columns = mixture_columns(c);
  for (const std::string& column : columns) text += column + ",";
  text += "quantity";
  for (const EnvelopeColumn& column : k_envelope_columns) text += fmt::format(",{}", column.name);
  text += '\n';
  for (const MixtureEnvelope& e : c.envelopes) {
    std::string line;
    for (const std::string& column : columns) append_value(line, value_in(e, column));
    line += "," + e.quantity;
    text += line.substr(1);
    for (const EnvelopeColumn& column : k_envelope_columns) {
      text += ',';
      const double value = column.value(e);
      if (std::isfinite(value)) append_number(text, value);
    }
    text += '\n';
  }
  return text;
}

// ---- HDF5

/// A column of values of the study: numbers where all are, else text.
void write_values(const hdf5::Handle& group, const std::string& column, const std::vector<const StudyValue*>& values) {
  const bool are_numbers =
      std::all_of(values.begin(), values.end(), [](const StudyValue* v) { return v == nullptr || v->number; });
  const std::string unit(unit_of_name(column));
  if (are_numbers) {
    std::vector<double> numbers;
    numbers.reserve(values.size());
    for (const StudyValue* v : values) numbers.push_back(v == nullptr ? k_unknown : *v->number);
    hdf5::write_dataset(group, {column, unit, "value of the study"}, numbers);
  } else {
    std::vector<std::string> texts;
    texts.reserve(values.size());
    for (const StudyValue* v : values) texts.emplace_back(v == nullptr ? "" : bare_text(v->text));
    hdf5::write_dataset(group, {column, "1", "value of the study, as a case file has it"}, texts);
  }
}

void write_tests(const hdf5::Handle& file, const Collection& c) {
  const hdf5::Handle group = hdf5::create_group(file, "tests");
  std::vector<std::string> names;
  for (const CollectedTest& test : c.tests) names.push_back(test.name);
  hdf5::write_dataset(group, {"name", "1", "name of the test and of its folder"}, names);
  for (const std::string& column : c.columns) {
    std::vector<const StudyValue*> values;
    for (const CollectedTest& test : c.tests) values.push_back(value_in(test, column));
    write_values(group, "study_" + column, values);
  }
  for (const std::string& name : summary_names(c)) {
    bool is_text = false;
    for (const JsonObject& summary : c.summaries) {
      const JsonValue* value = find_field(summary, name);
      is_text = is_text || (value != nullptr && std::holds_alternative<std::string>(value->data));
    }
    std::vector<std::string> texts;
    std::vector<double> numbers;
    for (const JsonObject& summary : c.summaries) {
      if (is_text) texts.push_back(text_in(summary, name));
      if (!is_text) numbers.push_back(is_set_in(summary, name) ? 1.0 : number_in(summary, name, k_unknown));
    }
    const hdf5::Label label{name == "test" ? "kind_of_test" : name, std::string(unit_of_name(name)), "of summary.json"};
    if (is_text) hdf5::write_dataset(group, label, texts);
    if (!is_text) hdf5::write_dataset(group, label, numbers);
  }
}

void write_curves(const hdf5::Handle& file, const char* name, const CollectedTable& table) {
  if (table.columns.empty()) return;
  const hdf5::Handle group = hdf5::create_group(file, name);
  hdf5::write_dataset(group, {"test", "1", "row of /tests that this row belongs to"}, table.test);
  for (const CollectedTable::Column& column : table.columns) {
    hdf5::write_dataset(group, {column.name, column.unit, column.description}, column.values);
  }
}

void write_envelopes(const hdf5::Handle& file, const Collection& c) {
  const hdf5::Handle group = hdf5::create_group(file, "envelopes");
  std::vector<std::string> quantities;
  for (const MixtureEnvelope& e : c.envelopes) quantities.push_back(e.quantity);
  if (quantities.empty()) return;
  hdf5::write_dataset(group, {"quantity", "1", "peak or residual shear stress"}, quantities);
  for (const std::string& column : mixture_columns(c)) {
    std::vector<const StudyValue*> values;
    for (const MixtureEnvelope& e : c.envelopes) values.push_back(value_in(e, column));
    write_values(group, "study_" + column, values);
  }
  for (const EnvelopeColumn& column : k_envelope_columns) {
    std::vector<double> values;
    for (const MixtureEnvelope& e : c.envelopes) values.push_back(column.value(e));
    hdf5::write_dataset(group, {column.name, column.unit, column.description}, values);
  }
}

void write_hdf5(const Collection& c, const std::filesystem::path& path) {
  std::filesystem::path draft = path;
  draft += ".tmp";
  hdf5::Handle file = hdf5::create_file(draft);
  const hdf5::Handle meta = hdf5::create_group(file, "meta");
  hdf5::write_attribute(meta, "program", std::string("dem4grm"));
  hdf5::write_attribute(meta, "version", std::string(k_version));
  write_tests(file, c);
  write_curves(file, "shear", c.shear);
  write_curves(file, "walls", c.walls);
  write_curves(file, "micro", c.micro);
  write_curves(file, "profiles", c.profiles);
  write_curves(file, "compression", c.compression);
  write_envelopes(file, c);
  file.close(draft.string() + ": cannot be written");
  publish_file(draft, path);
}

}  // namespace

void write_collection(const Collection& collection, const std::filesystem::path& folder) {
  replace_file(folder / "tests.csv", tests_csv(collection));
  replace_file(folder / "collected.csv", collected_csv(collection));
  replace_file(folder / "envelopes.csv", envelopes_csv(collection));
  write_hdf5(collection, folder / "collected.h5");
}

}  // namespace dem
