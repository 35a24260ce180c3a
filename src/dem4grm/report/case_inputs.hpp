// SPDX-License-Identifier: BSD-3-Clause
// The keys of a resolved case as rows for people: section, key, value as written, meaning.
#pragma once

#include <string_view>

#include "dem4grm/results/json_text.hpp"

namespace dem {

/// A list of {section, rows: [{key, value, comment}]} in the order of the file. Reads what resolved_toml() writes (case_file.hpp):
/// one key a line with its meaning as a comment, lists over some lines with the comment before them, keys that are not set as
/// comments. Anything else is passed over.
JsonList case_inputs(std::string_view resolved_toml);

}  // namespace dem
