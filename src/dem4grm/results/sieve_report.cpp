// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/sieve_report.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/specimen/grading.hpp"

namespace dem {
namespace {

struct NamedColumn {
  const char* name;
  const SieveColumn* column;
};

/// The columns that are there, in the order of all outputs.
std::vector<NamedColumn> columns_of(const SieveTable& table) {
  std::vector<NamedColumn> columns{{"gravel", &table.gravel}, {"rubber", &table.rubber}, {"together", &table.together}};
  std::erase_if(columns, [](const NamedColumn& c) { return !c.column->is_there(); });
  return columns;
}

double mm(double length) { return length * 1e3; }

/// D10, D50 and D60 of a material, m.
struct KeySizes {
  double d10 = 0.0, d50 = 0.0, d60 = 0.0;
  [[nodiscard]] double uniformity() const { return d60 / d10; }
};

KeySizes measured_sizes(std::span<const MeasuredGrain> grains) {
  return {opening_for_share(grains, 0.1), opening_for_share(grains, 0.5), opening_for_share(grains, 0.6)};
}

KeySizes asked_sizes(const Grading& grading) { return {d10(grading), d50(grading), d60(grading)}; }

struct SievedMaterial {
  const char* name;
  const std::vector<MeasuredGrain>* grains;
  const Grading* asked;
  const SieveColumn* column;
};

std::vector<SievedMaterial> materials_of(const SieveReport& r) {
  std::vector<SievedMaterial> materials{{"gravel", &r.grains.gravel, &r.input.gravel, &r.table.gravel},
                                        {"rubber", &r.grains.rubber, &r.input.rubber, &r.table.rubber}};
  std::erase_if(materials, [](const SievedMaterial& m) { return m.grains->empty(); });
  return materials;
}

std::string material_line(const SievedMaterial& m) {
  const KeySizes found = measured_sizes(*m.grains), asked = asked_sizes(*m.asked);
  return fmt::format(
      "  {:<8} {:>5} grains, D50 {:.2f} mm (input {:.2f}), Cu {:.2f} (input {:.2f}), largest difference "
      "{:.2f} points\n",
      m.name, m.grains->size(), mm(found.d50), mm(asked.d50), found.uniformity(), asked.uniformity(),
      100.0 * m.column->largest_difference());
}

}  // namespace

SieveReport sieve_report(StoredGrains stored, std::vector<double> openings) {
  const DirectShearCase& test = stored.test;
  SieveReport report;
  report.grains = measure_grains(stored.packing, test.rubber.density, test.rubber_solid_density);
  report.input = {test.specimen.gravel_grading, test.specimen.rubber_grading,
                  test.gravel.density,          test.rubber_solid_density,
                  test.specimen.rubber_content, !test.specimen.gravel_clumps && !test.specimen.rubber_grains};
  if (openings.empty()) openings = usual_sieves(report.grains, report.input);
  report.table = sieve_table(report.grains, report.input, std::move(openings));
  report.stored = std::move(stored);
  return report;
}

std::string sieve_text(const SieveReport& r) {
  const std::vector<NamedColumn> columns = columns_of(r.table);
  std::string text = fmt::format("{}, state {}: per cent passing by mass, difference in points\n",
                                 r.stored.file.string(), r.stored.state);
  std::string names = "     sieve", heads = "        mm";
  for (const NamedColumn& c : columns) {
    names += fmt::format("  | {:^26}", c.name);
    heads += "  | specimen   input    differ";
  }
  text += names + "\n" + heads + "\n";
  for (std::size_t k = 0; k < r.table.openings.size(); ++k) {
    text += fmt::format("{:>10}", fmt::format("{:.3f}", mm(r.table.openings[k])));
    for (const NamedColumn& c : columns) {
      const double found = 100.0 * c.column->measured[k], asked = 100.0 * c.column->asked[k];
      text += fmt::format("  | {:8.2f}{:8.2f}{:+10.2f}", found, asked, found - asked + 0.0);
    }
    text += "\n";
  }
  for (const SievedMaterial& m : materials_of(r)) text += material_line(m);
  return text;
}

JsonObject sieve_json(const SieveReport& r) {
  JsonObject out{{"file", r.stored.file.string()}, {"state", r.stored.state}};
  for (const SievedMaterial& m : materials_of(r)) {
    const KeySizes found = measured_sizes(*m.grains), asked = asked_sizes(*m.asked);
    out.push_back({m.name, JsonObject{{"grains", static_cast<std::int64_t>(m.grains->size())},
                                      {"D10_mm", mm(found.d10)},
                                      {"D50_mm", mm(found.d50)},
                                      {"D60_mm", mm(found.d60)},
                                      {"uniformity", found.uniformity()},
                                      {"input_D50_mm", mm(asked.d50)},
                                      {"input_uniformity", asked.uniformity()},
                                      {"largest_difference_points", 100.0 * m.column->largest_difference()}}});
  }
  JsonList sieves;
  for (std::size_t k = 0; k < r.table.openings.size(); ++k) {
    JsonObject row{{"sieve_mm", mm(r.table.openings[k])}};
    for (const NamedColumn& c : columns_of(r.table)) {
      const double found = 100.0 * c.column->measured[k], asked = 100.0 * c.column->asked[k];
      row.push_back({fmt::format("{}_passing_percent", c.name), found});
      row.push_back({fmt::format("{}_input_percent", c.name), asked});
      row.push_back({fmt::format("{}_difference_points", c.name), found - asked});
    }
    sieves.emplace_back(std::move(row));
  }
  out.push_back({"sieves", std::move(sieves)});
  return out;
}

std::string sieve_csv(const SieveReport& r) {
  const std::vector<NamedColumn> columns = columns_of(r.table);
  std::string text = "sieve_mm";
  for (const NamedColumn& c : columns) {
    text += fmt::format(",{0}_passing_percent,{0}_input_percent,{0}_difference_points", c.name);
  }
  for (std::size_t k = 0; k < r.table.openings.size(); ++k) {
    text += "\n" + format_decimal(r.table.openings[k], -3);
    for (const NamedColumn& c : columns) {
      const double found = 100.0 * c.column->measured[k], asked = 100.0 * c.column->asked[k];
      for (const double value : {found, asked, found - asked}) {
        text += ',';
        append_number(text, value);
      }
    }
  }
  return text + "\n";
}

}  // namespace dem
