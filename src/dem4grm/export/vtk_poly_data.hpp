// SPDX-License-Identifier: BSD-3-Clause
// Points with cells and named arrays, and their text as a .vtp file: what VTK calls PolyData.
//
// The form is that of "VTK File Formats", XML part: binary data stand behind the XML as they are ("appended", "raw"),
// little-endian, in blocks that zlib compressed, each array behind a head of 64-bit numbers. Real numbers have 32 bits,
// which is what a graphics card takes; results.h5 has all digits. Equal content gives equal bytes.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "dem4grm/core/vec3.hpp"

namespace dem {

/// A named column; the unit is part of the name where there is one.
struct VtkArray {
  using Reals = std::vector<float>;
  using Wholes = std::vector<std::int32_t>;
  using Flags = std::vector<std::uint8_t>;
  using Texts = std::vector<std::string>;

  std::string name;
  std::variant<Reals, Wholes, Flags, Texts> values;  ///< [n_rows * components]
  std::size_t components = 1;

  [[nodiscard]] std::size_t rows() const;
};

enum class VtkCells { vertices, lines, polygons };

/// Cells of one kind over points. Every array has one row for each point, each cell, or as many as it likes.
struct VtkPolyData {
  VtkArray::Reals points;  ///< [3 * n_points] mm
  VtkCells kind = VtkCells::vertices;
  VtkArray::Wholes connectivity;  ///< point numbers of the cells, one cell after the other
  VtkArray::Wholes offsets;       ///< [n_cells] end of each cell in `connectivity`
  std::vector<VtkArray> point_data, cell_data, field_data;

  [[nodiscard]] std::size_t n_points() const { return points.size() / 3; }
  [[nodiscard]] std::size_t n_cells() const { return offsets.size(); }

  /// Adds a point given in m and returns its number.
  std::int32_t add_point(const Vec3& metres);
  /// Adds a cell over points that are there.
  void add_cell(std::initializer_list<std::int32_t> corners);
};

/// The content of a .vtp file. Throws InternalError when an array does not fit its points or cells.
std::string vtp_text(const VtkPolyData& data);

}  // namespace dem
