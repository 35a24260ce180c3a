// SPDX-License-Identifier: BSD-3-Clause
// summary.json: the numbers of a finished test, names with units.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/grain_compression.hpp"
#include "dem4grm/micro/height_profile.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

/// What the writer of a run knows beside the result.
struct RunFacts {
  int threads = 1;
  double wall_time = 0.0;         ///< s
  double energy_closure = 0.0;    ///< per cent of the boundary work that no ledger accounts for
  std::vector<FrameInfo> frames;  ///< in the order in which they were written
  std::vector<std::string> warnings;
  std::vector<StateProfile> profiles;  ///< of the stored states
  JsonObject branch{};                 ///< where the test was branched from; empty when it started anew
};

/// Share of the boundary work, in per cent, that is neither stored nor in one of the losses. Energies in J; `start` and
/// `end` may count their works from different origins only if `start` has none. 0 when the walls did no work.
double energy_closure_per_cent(const EnergyReport& start, const EnergyReport& end);

/// How even a specimen is before shear, as fields of summary.json.
JsonObject homogeneity_fields(const Homogeneity& homogeneity);

/// All names of summary.json (docs/reference/output-folder.md) in their order.
JsonObject direct_shear_summary(const DirectShearCase& test, const DirectShearResult& result, const RunFacts& facts);
JsonObject grain_compression_summary(const GrainCompressionCase& test, const GrainCompressionResult& result,
                                     const RunFacts& facts);
/// All names of specimen.json: the part of summary.json that is known before shear.
JsonObject specimen_summary(const DirectShearCase& test, const DirectShearResult& result, const RunFacts& facts);

}  // namespace dem
