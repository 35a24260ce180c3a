// SPDX-License-Identifier: BSD-3-Clause
// What a test may do differently when it starts from a stored state of another one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/case_file/case_differences.hpp"
#include "dem4grm/lab/branched_state.hpp"

namespace dem {

/// One row of the table: a key, or all keys of a section ("box.*"), and from which stages on its value is embodied in the state.
struct BranchRule {
  std::string_view key;
  unsigned stages;          ///< a bit for each BranchStage in which it may still change
  std::string_view reason;  ///< why not in the others; a clause
};

/// The row of a key: the first that fits.
const BranchRule& branch_rule_of(std::string_view key);

/// Why a test of case `to` cannot start from a state of case `from`: one message that names every key; empty when it can. `origin`
/// is what the message calls the state.
std::string branch_problem(const BranchPoint& point, const DirectShearCase& from, const DirectShearCase& to,
                           const std::string& origin);

}  // namespace dem
