// SPDX-License-Identifier: BSD-3-Clause
// A simulated sieve analysis of a stored specimen as text, JSON and plot data.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/stored_grains.hpp"
#include "dem4grm/specimen/sieve_analysis.hpp"

namespace dem {

struct SieveReport {
  StoredGrains stored;
  MeasuredGrains grains;
  SieveInput input;
  SieveTable table;
};

/// Measures the grains of a stored state. Openings in m; none: the sieves of the input gradings.
SieveReport sieve_report(StoredGrains stored, std::vector<double> openings);

/// Lines for a terminal: one line a sieve, key figures below.
std::string sieve_text(const SieveReport& report);

/// One object; sizes in mm, shares in per cent, differences in points of per cent.
JsonObject sieve_json(const SieveReport& report);

/// CSV with a header: sieve_mm and three columns for each material that is there (and for both together).
std::string sieve_csv(const SieveReport& report);

}  // namespace dem
