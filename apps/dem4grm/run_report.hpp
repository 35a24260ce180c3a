// SPDX-License-Identifier: BSD-3-Clause
// The last lines of a run: what came out, where it is, what to do next.
#pragma once

#include <filesystem>
#include <string>

#include "dem4grm/results/json_text.hpp"

namespace dem {

/// The main numbers of a summary as lines of text.
std::string summary_lines(const JsonObject& summary);

/// Where a branched test comes from, as in branch.json; nothing for an empty object.
std::string branch_lines(const JsonObject& origin);

/// How even a specimen is, from the fields of homogeneity_fields (results/summary.hpp), as lines of text; empty without them.
std::string homogeneity_lines(const JsonObject& fields);

/// The same with the folder, the time it took and the next command.
std::string run_report(const JsonObject& summary, const std::filesystem::path& folder, bool was_complete);

/// What the verb specimen says at its end.
std::string specimen_report(const JsonObject& summary, const std::filesystem::path& folder,
                            const std::string& case_path, bool was_complete);

}  // namespace dem
