// SPDX-License-Identifier: BSD-3-Clause
// Is a test what it was meant to be? Each line holds a number of its summary against a limit and says why that limit.
#pragma once

#include "dem4grm/results/json_text.hpp"

namespace dem {

/// A list of {name, value, unit, limit, verdict}; verdict is good, warning, bad or unknown (the number is not there). `summary` is
/// summary.json or specimen.json, `status` is status.json. Warnings of the summary and a run that did not finish are lines, too.
JsonList quality_panel(const JsonObject& summary, const JsonObject& status);

}  // namespace dem
