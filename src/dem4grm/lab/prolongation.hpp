// SPDX-License-Identifier: BSD-3-Clause
// May a test go on beyond the displacement at which it ended?
#pragma once

#include <string>

#include "dem4grm/lab/case.hpp"

namespace dem {

/// Empty when a test that ended as `shorter` says can go on as `longer`, which differs from it in shear.displacement alone, and ends
/// with the bits of a test that was longer from the beginning. Else the reason in one sentence: the end of the shorter one must fall
/// on a row, a stored state and a micro-mechanical record that the longer one has too.
std::string prolongation_problem(const DirectShearCase& shorter, const DirectShearCase& longer);

}  // namespace dem
