// SPDX-License-Identifier: BSD-3-Clause
// An analysis of the micro-mechanics as table, JSON and plot data.
#pragma once

#include <string>

#include "dem4grm/results/json_text.hpp"
#include "dem4grm/results/micro_state_file.hpp"

namespace dem {

/// One line for each quantity of the sets (all, g-g, g-r, r-r), then one for each of the state.
std::string micro_table_text(const MicroAnalysis& analysis);

/// State, options, sets, quantities of the state, fabric tensors and, with resamples, bands. Names carry units.
JsonObject micro_as_json(const StoredMicroState& stored, const MicroAnalysis& analysis);

/// Polar histograms over the full circle with the values of the fitted curves at the middle of each bin, as CSV with one
/// header line. Directions without a contact have no mean force: the field is empty.
std::string histogram_csv(const MicroAnalysis& analysis);

/// "contacts, bins of 10 deg, f0 over orientations, strong above the mean normal force".
std::string options_text(const MicroOptions& options);

}  // namespace dem
