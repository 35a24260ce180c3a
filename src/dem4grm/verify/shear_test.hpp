// SPDX-License-Identifier: BSD-3-Clause
// Cases of a whole direct shear test.
#pragma once

#include <vector>

#include "dem4grm/verify/cases.hpp"

namespace dem {

/// Appends them; part of the cases of energy.
void add_shear_test_cases(std::vector<VerificationCase>& cases);

}  // namespace dem
