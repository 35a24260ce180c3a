// SPDX-License-Identifier: BSD-3-Clause
// A table that goes to a CSV file row by row and is kept, column by column, for results.h5.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "dem4grm/lab/observer.hpp"
#include "dem4grm/results/output_file.hpp"

namespace dem {

/// What a column holds; the unit is part of the name where there is one.
struct ColumnInfo {
  std::string_view name;
  std::string_view unit;  ///< "1" for plain numbers
  std::string_view description;
};

/// The value; the one "not a number" that is printed without a sign when there is none.
double without_sign_of_nan(double value);

class TableFile {
 public:
  /// Writes the header. Throws IoError.
  TableFile(std::filesystem::path path, std::span<const ColumnInfo> columns);

  /// One value for each column; the row is in the file when this returns. Throws IoError.
  void append(std::span<const double> values);
  void sync() { file_.sync(); }

  [[nodiscard]] std::span<const ColumnInfo> columns() const { return columns_; }
  [[nodiscard]] const std::vector<double>& values_of(std::size_t column) const { return values_[column]; }
  [[nodiscard]] std::size_t rows() const { return values_.empty() ? 0 : values_.front().size(); }

 private:
  std::span<const ColumnInfo> columns_;
  AppendedFile file_;
  std::vector<std::vector<double>> values_;  ///< [column][row]
};

/// Columns of shear.csv (docs/reference/output-folder.md).
std::span<const ColumnInfo> shear_columns();
/// Values of a row in the order of the columns; the imbalance is a fraction.
std::vector<double> shear_values(const ShearRow& row, double half_force_imbalance);

/// Columns of walls.csv: the displacement, then x, y and z of the force on each wall.
std::span<const ColumnInfo> wall_columns();
std::vector<double> wall_values(const ShearRow& row);

/// Columns of grain.csv.
std::span<const ColumnInfo> compression_columns();
std::vector<double> compression_values(const CompressionRow& row);

}  // namespace dem
