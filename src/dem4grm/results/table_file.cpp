// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/table_file.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr std::array<ColumnInfo, 24> k_shear_columns{{
    {"displacement_mm", "mm", "displacement of the halves against each other at the end of the interval"},
    {"shear_stress_kPa", "kPa", "net x-force on the walls of the lower half over the nominal area"},
    {"shear_stress_corrected_kPa", "kPa", "the same over the area that is left"},
    {"normal_stress_kPa", "kPa", "force on the top plate over the nominal area, compression positive"},
    {"vertical_displacement_mm", "mm", "rise of the top plate since shear began, dilation positive"},
    {"void_ratio", "1", "from the height of the top plate"},
    {"inertial_number", "1", "shear velocity over initial height times mean size times sqrt(density / normal stress)"},
    {"unbalanced_ratio", "1", "mean net force on a body over mean contact force, at the end of the interval"},
    {"half_force_imbalance", "1", "difference of the shear stresses of both halves over the largest one so far"},
    {"plate_shear_stress_kPa", "kPa", "share of the shear stress that the bottom plate carries"},
    {"normal_stress_worst_kPa", "kPa", "the single step farthest from the target"},
    {"time_step_us", "us", "time step at the end of the interval"},
    {"normal_stress_corrected_kPa", "kPa", "force on the top plate over the area that is left"},
    {"shear_ratio", "1", "shear over normal stress, both over the last 0.5 mm"},
    {"dilation_rate", "1", "rise of the plate over displacement, slope of the last 0.5 mm"},
    {"taylor_friction", "1", "shear_ratio without dilation_rate: what friction alone carries"},
    {"kinetic_J", "J", "kinetic energy"},
    {"contact_strain_J", "J", "elastic energy of the contacts"},
    {"bond_strain_J", "J", "elastic energy of the bonds"},
    {"boundary_work_J", "J", "work of the walls since shear began"},
    {"slip_J", "J", "work lost in slip since shear began"},
    {"dashpot_J", "J", "work lost in dashpots since shear began"},
    {"local_damping_J", "J", "work lost in local damping since shear began"},
    {"breakage_J", "J", "elastic energy lost with broken bonds since shear began"},
}};

constexpr std::array<ColumnInfo, 13> k_compression_columns{{
    {"strain", "1", "approach of the plates over the outer height of the grain"},
    {"displacement_mm", "mm", "approach of the plates"},
    {"load_N", "N", "mean force on both plates"},
    {"poisson_ratio", "1", "of the inner cube of eight balls, secant"},
    {"closed_second_neighbours", "1", "number of second neighbours that touch"},
    {"kinetic_J", "J", "kinetic energy"},
    {"contact_strain_J", "J", "elastic energy of the contacts"},
    {"bond_strain_J", "J", "elastic energy of the bonds"},
    {"boundary_work_J", "J", "work of the plates"},
    {"slip_J", "J", "work lost in slip"},
    {"dashpot_J", "J", "work lost in dashpots"},
    {"local_damping_J", "J", "work lost in local damping"},
    {"breakage_J", "J", "elastic energy lost with broken bonds"},
}};

/// Words for the walls in the order of ShearBox.
constexpr std::array<const char*, ShearBox::k_walls> k_wall_words{
    "bottom_plate", "lower_xmin", "lower_xmax", "lower_ymin", "lower_ymax", "lower_wing",
    "top_plate",    "upper_xmin", "upper_xmax", "upper_ymin", "upper_ymax", "upper_wing"};

/// What the views of ColumnInfo look at.
struct WallColumns {
  std::vector<std::string> names;
  std::vector<ColumnInfo> columns;

  WallColumns() {
    names.reserve(3 * k_wall_words.size());  // so that no view is left behind when the list grows
    columns.push_back(k_shear_columns.front());
    for (const char* wall : k_wall_words) {
      for (const char* axis : {"x", "y", "z"}) {
        names.push_back(std::string(wall) + "_f" + axis + "_N");
        columns.push_back({names.back(), "N", "mean force of the grains on that wall over the interval"});
      }
    }
  }
};

void append_energies(std::vector<double>& values, const EnergyReport& e) {
  for (const double v :
       {e.kinetic, e.contact_strain, e.bond_strain, e.boundary_work, e.slip, e.dashpot, e.local_damping, e.breakage}) {
    values.push_back(v);
  }
}

}  // namespace

double without_sign_of_nan(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value;
}

TableFile::TableFile(std::filesystem::path path, std::span<const ColumnInfo> columns)
    : columns_(columns), file_(std::move(path)), values_(columns.size()) {
  std::string header;
  for (const ColumnInfo& column : columns) {
    if (!header.empty()) header += ',';
    header += column.name;
  }
  file_.append(header + "\n");
}

void TableFile::append(std::span<const double> values) {
  require(values.size() == columns_.size(), "a row of a table has one value for each column");
  std::string line;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (c > 0) line += ',';
    append_number(line, values[c]);
    values_[c].push_back(values[c]);
  }
  file_.append(line + "\n");
}

std::span<const ColumnInfo> shear_columns() { return k_shear_columns; }

std::vector<double> shear_values(const ShearRow& row, double half_force_imbalance) {
  std::vector<double> values{row.displacement * 1e3,
                             row.shear_stress / 1e3,
                             row.shear_stress_corrected / 1e3,
                             row.normal_stress / 1e3,
                             row.vertical_displacement * 1e3,
                             row.void_ratio,
                             row.inertial_number,
                             row.unbalanced_ratio,
                             half_force_imbalance,
                             row.plate_shear_stress / 1e3,
                             row.normal_stress_worst / 1e3,
                             row.time_step * 1e6,
                             row.normal_stress_corrected / 1e3,
                             without_sign_of_nan(row.dilatancy.shear_ratio),
                             without_sign_of_nan(row.dilatancy.rate),
                             without_sign_of_nan(row.dilatancy.friction)};
  append_energies(values, row.energy);
  return values;
}

std::span<const ColumnInfo> wall_columns() {
  static const WallColumns k_columns;
  return k_columns.columns;
}

std::vector<double> wall_values(const ShearRow& row) {
  std::vector<double> values{row.displacement * 1e3};
  for (const Vec3& force : row.wall_force) values.insert(values.end(), {force.x, force.y, force.z});
  return values;
}

std::span<const ColumnInfo> compression_columns() { return k_compression_columns; }

std::vector<double> compression_values(const CompressionRow& row) {
  std::vector<double> values{row.strain, row.displacement * 1e3, row.load, row.poisson_ratio,
                             static_cast<double>(row.closed_second_neighbours)};
  append_energies(values, row.energy);
  return values;
}

}  // namespace dem
