// SPDX-License-Identifier: BSD-3-Clause
// The stress path of a branch (one trial preparation with one friction), and what it is called in files, in the progress and
// in notes.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/specimen/specimen.hpp"

namespace dem {

/// Stresses under which a specimen comes to rest, Pa: the load steps below the normal stress, then that; all of them times
/// the ratio.
std::vector<double> rest_stresses(const SpecimenOrder& order, double ratio);

/// Name of the state at rest under path[station]. The stresses before are part of it: a specimen that rested on its way is
/// another one.
std::string branch_state_name(double friction, const std::vector<double>& path, std::size_t station);

/// "e_min (friction 0)", "e_max (friction 2)", "trial 1 (friction 0.09)" for the branch of that number.
std::string branch_label(std::size_t number, double friction);

/// What the last branch of the report gave.
std::string branch_note(const SpecimenReport& report, bool is_fetched);

}  // namespace dem
