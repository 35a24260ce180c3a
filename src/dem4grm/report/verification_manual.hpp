// SPDX-License-Identifier: BSD-3-Clause
// The verification suite's results as a table, as JSON and as the verification manual.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/results/json_text.hpp"
#include "dem4grm/verify/runner.hpp"

namespace dem {

/// Heading of the table on a terminal, and the lines of one case.
std::string verification_table_head();
std::string verification_table_rows(const CaseOutcome& outcome);
/// "214 quantities in 25 cases, 0 missed".
std::string verification_verdict(const std::vector<CaseOutcome>& outcomes);

/// One object for each checked quantity: case, quantity, unit, expected, obtained, error, tolerance, comparison,
/// passed, source.
JsonList verification_json(const std::vector<CaseOutcome>& outcomes);

/// The manual in Markdown: a list of contents, then a section for each case. Holds no time and no name of a machine, so
/// equal results give equal bytes. Pictures are expected as pictures/NAME.png beside it.
std::string verification_manual(const std::vector<CaseOutcome>& outcomes);

/// What the pictures show: a list of name, title, x_label, y_label and series of label, is_reference, x, y.
JsonList verification_curves(const std::vector<CaseOutcome>& outcomes);

}  // namespace dem
