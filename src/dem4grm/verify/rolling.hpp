// SPDX-License-Identifier: BSD-3-Clause
// Cases of bodies that slide and roll on a plane under gravity.
#pragma once

#include <vector>

#include "dem4grm/verify/cases.hpp"

namespace dem {

/// Appends them; part of the cases of bodies.
void add_rolling_cases(std::vector<VerificationCase>& cases);

}  // namespace dem
