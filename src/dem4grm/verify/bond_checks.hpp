// SPDX-License-Identifier: BSD-3-Clause
// The checks of the parallel bond; their texts are in bond_cases.cpp.
#pragma once

#include "dem4grm/verify/cases.hpp"

namespace dem::verify {

void check_cantilever(Findings& findings);
void check_row_statics(Findings& findings);  ///< part of the former
void check_bond_energy(Findings& findings);
void check_bond_strength(Findings& findings);
void check_bond_dashpot(Findings& findings);
void check_bond_turned(Findings& findings);
void check_bond_closed_path(Findings& findings);

}  // namespace dem::verify
