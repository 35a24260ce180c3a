// SPDX-License-Identifier: BSD-3-Clause
// A laboratory's own curve of a direct shear test, from a CSV file as laboratories export it.
//
// The first line that names a horizontal displacement is the header. Columns are found by their words, in any order: a
// displacement (horizontal, shear), a shear stress, a vertical displacement (dilation, settlement). Units stand in the header
// (mm, cm, um, m; kPa, Pa, MPa, N/mm2, kN/m2); without one mm and kPa are taken. Columns may be parted by commas, semicolons or
// tabs, numbers may have decimal commas where columns are not parted by commas.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/results/json_text.hpp"

namespace dem {

struct LaboratoryCurve {
  std::string name;                           ///< of the file, without folder and ending
  std::vector<double> displacement;           ///< m
  std::vector<double> shear_stress;           ///< Pa; empty without such a column; not a number in an empty field
  std::vector<double> vertical_displacement;  ///< m, dilation positive; empty without such a column
  std::string note;                           ///< what was understood, in one sentence
};

/// Throws InputError with every problem at its line and column; `name` stands for the file.
LaboratoryCurve parse_laboratory_curve(std::string_view text, std::string_view name);
/// Throws MissingFileError, IoError and InputError.
LaboratoryCurve read_laboratory_curve(const std::filesystem::path& path);

/// Interface LaboratoryCurve of web/src/data.ts; `test` is the name of the test that it belongs to, empty: all.
JsonObject laboratory_as_json(const LaboratoryCurve& curve, const std::string& test);

}  // namespace dem
