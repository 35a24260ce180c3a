// SPDX-License-Identifier: BSD-3-Clause
// From the stored state of one test to that from which another one starts.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/lab/case.hpp"
#include "dem4grm/lab/observer.hpp"

namespace dem {

/// The stage of a test in which a state was saved.
enum class BranchStage { fill, search, compression, final_friction, specimen, shear };

/// "the fill", "the search for the density", ...
std::string stage_words(BranchStage stage);

/// Where a stored state stands.
struct BranchPoint {
  BranchStage stage = BranchStage::fill;
  double displacement = 0.0;        ///< m
  double halves_velocity = 0.0;     ///< m/s, of the halves against each other at that moment
  double shear_velocity = 0.0;      ///< m/s, that they are meant to have
  std::string state_hash;           ///< empty during the fill, whose grains are not those of the specimen yet
  std::vector<FrameInfo> frames{};  ///< stored states of shear so far
};

/// Builds the specimen of the case with that state in it. Throws IoError when the state is none of a direct shear test, or does not
/// fit the case.
BranchPoint branch_point_of(StateArchive& state, const DirectShearCase& test);

/// The state from which `to` starts, when it goes on from a state of `from` and only keys differ that may
/// (runs/branch_rules.hpp). With the same stress, velocity and record it is the same state.
///   before shear   the stages that are left follow `to`
///   specimen       under another normal stress it comes to rest once more, with its final friction
///   shear          under another normal stress the halves stand still until the specimen has come to rest; another velocity is
///                  taken up as at the start of shear, from the one that the halves have
StateArchive branched_state(const StateArchive& state, const BranchPoint& point, const DirectShearCase& from,
                            const DirectShearCase& to);

}  // namespace dem
