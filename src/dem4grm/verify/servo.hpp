// SPDX-License-Identifier: BSD-3-Clause
// Cases of the servo of the loading plate.
#pragma once

#include <vector>

#include "dem4grm/verify/cases.hpp"

namespace dem {

/// Appends them; part of the cases of damping.
void add_servo_cases(std::vector<VerificationCase>& cases);

}  // namespace dem
