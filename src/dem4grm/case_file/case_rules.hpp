// SPDX-License-Identifier: BSD-3-Clause
// Rules between the keys of a case: what cannot be run is an error, what is unusual is a warning.
#pragma once

#include "dem4grm/case_file/case_keys.hpp"
#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

/// Checks a case whose keys have been read. A rule is left out when one of its keys has a problem of its own.
void check_rules(const DirectShearCase& test, const GivenKeys& given, CaseProblems& problems);
void check_rules(const GrainCompressionCase& test, const GivenKeys& given, CaseProblems& problems);

}  // namespace dem
