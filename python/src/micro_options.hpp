// SPDX-License-Identifier: BSD-3-Clause
// Options of a micro-mechanical analysis in the words of the command line, and what it found as Python takes it.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>

#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/results/micro_state_file.hpp"

namespace dem {

struct MicroWords {
  int bins = 36;
  std::string level = "contact", mean = "orientations", strong = "normal", projection = "all";
  int resamples = 0;
  std::uint64_t seed = 1;
};

/// Throws std::invalid_argument for a word or a number that is none of the allowed ones.
MicroOptions options_from(const MicroWords& words);

/// Analyses with the lock of the interpreter released: (JSON text, histograms as CSV text).
pybind11::tuple analysed(const StoredMicroState& stored, const MicroOptions& options);

}  // namespace dem
