// SPDX-License-Identifier: BSD-3-Clause
// The quantities of the micro-mechanics with the names and units that a user reads: one table for micro.csv, results.h5 and
// `dem4grm micro`.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/results/table_file.hpp"

namespace dem {

/// A quantity of every set of contacts (k_set_names).
struct SetQuantity {
  const char* name;
  const char* unit;  ///< "1" for plain numbers
  const char* description;
  double SetNumbers::*value;
  double scale = 1.0;  ///< of the SI value in the unit
};
std::span<const SetQuantity> set_quantities();

/// A quantity of the state as a whole.
struct StateQuantity {
  const char* name;
  const char* unit;
  const char* description;
  double MicroNumbers::*value;
  double scale = 1.0;
};
std::span<const StateQuantity> state_quantities();

/// The value in its unit; the one "not a number" that is printed without a sign when there is none.
double value_in_unit(const SetQuantity& quantity, const SetNumbers& numbers);
double value_in_unit(const StateQuantity& quantity, const MicroNumbers& numbers);

/// "a_n", "theta_n_deg": name with its unit, and with the set ("all", "gg", "gr", "rr") between them when there is one.
std::string name_with_unit(const char* name, const char* unit, const char* set = nullptr);

/// "rigid", "intermediate", "soft" for MicroNumbers::zone.
const char* zone_name(double zone);

/// Columns of micro.csv: displacement, then the quantities of each set, then those of the state.
std::span<const ColumnInfo> micro_columns();
std::vector<double> micro_values(const MicroRow& row);

}  // namespace dem
