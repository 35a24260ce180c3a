// SPDX-License-Identifier: BSD-3-Clause
// The rules between the keys of the box, and what all rules work on.
#pragma once

#include <string>

#include "dem4grm/case_file/case_keys.hpp"
#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/lab/case.hpp"

namespace dem {

/// What the rules work on.
struct Rules {
  const GivenKeys& given;
  CaseProblems& problems;
};

inline std::string length_text(double value) { return format_quantity(value, Dimension::length); }

inline bool has_gravel(const SpecimenSettings& specimen) { return specimen.rubber_content < 1.0; }
inline bool has_rubber(const SpecimenSettings& specimen) { return specimen.rubber_content > 0.0; }

/// Sides against grains, halves against each other, gap, wings and ribs.
void check_box_rules(const DirectShearCase& test, Rules& rules);

}  // namespace dem
