// SPDX-License-Identifier: BSD-3-Clause
// What follows from a case before anything is computed: numbers of grains, time step, inertial number, memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

/// What one clump shape contributes to the gravel.
struct ShapeFacts {
  std::string name;
  int pebbles = 0;     ///< of one grain
  int grains = 0;      ///< of that shape
  double share = 0.0;  ///< of the volume of the gravel
};

/// Derived values, SI units. Of a grain compression only the first group is filled.
struct CaseFacts {
  std::string test, name;
  int balls = 0, clumps = 0, rubber_grains = 0, bonds = 0;
  double time_step = 0.0;  ///< s, of the preparation; in shear it follows the contacts that there are
  std::string time_step_limited_by;
  std::int64_t steps = 0;  ///< of the shear stage, or of the whole compression
  int rows = 0;            ///< of the record
  double memory = 0.0;     ///< bytes, estimated

  std::vector<ShapeFacts> shapes;  ///< of the gravel
  double rubber_content = 0.0;     ///< that whole grains give
  double shear_velocity = 0.0;     ///< m/s, as given, or chosen for the nominal height
  double inertial_number = 0.0;    ///< of the shear stage
  bool is_velocity_chosen = false;
  double mean_size = 0.0;     ///< m, volume-weighted
  double mean_density = 0.0;  ///< kg/m3, volume-weighted, of the solids
  double expected_void_ratio = 0.0;
  double generation_void_ratio = 0.0;
};

/// Cheap: draws the grains and finds their stability limits, fills no box. Throws InputError for grains that cannot be
/// drawn.
CaseFacts derive_facts(const TestCase& test);

/// The facts with units in their names.
JsonObject facts_as_json(const CaseFacts& facts);

}  // namespace dem
