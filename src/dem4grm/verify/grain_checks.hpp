// SPDX-License-Identifier: BSD-3-Clause
// The checks of the rubber grain as a whole; their texts are in grain_cases.cpp.
#pragma once

#include "dem4grm/verify/cases.hpp"

namespace dem::verify {

void check_free_grain(Findings& findings);
void check_grain_stiffness(Findings& findings);
void check_grain_lattice(Findings& findings);
void check_grain_platens(Findings& findings);
void check_grain_compression(Findings& findings);
void check_grain_contacts(Findings& findings);
void check_grain_scaling(Findings& findings);

}  // namespace dem::verify
