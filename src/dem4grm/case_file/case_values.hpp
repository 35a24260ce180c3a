// SPDX-License-Identifier: BSD-3-Clause
// Reads one value of a case file into its place, with every check that needs no other key.
#pragma once

#include <filesystem>
#include <string>

#include "dem4grm/case_file/case_problems.hpp"
#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/case_file/toml_guard.hpp"

namespace dem {

/// Reads kind, unit and range of `node` and stores the value in the slot of `key`. Grading files are looked for in
/// `folder`. Returns false, with the reason in `problems`, when the value is wrong; the slot may then hold anything.
bool read_value(const Key& key, const TomlNode& node, const std::filesystem::path& folder, CaseProblems& problems);

/// The value as a message shows it: text in quotes, long text shortened.
std::string shown_value(const TomlNode& node);

/// Gives the untyped text of a --set option the kind that its key asks for: quotes around text and brackets around
/// lists may be left out. Every place inside becomes that of the option.
TomlNode typed_option(const Key& key, const TomlNode& node);

}  // namespace dem
