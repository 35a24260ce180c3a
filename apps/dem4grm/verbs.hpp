// SPDX-License-Identifier: BSD-3-Clause
// The verbs of the command line. Each adds itself to the parser and runs when it is chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"

namespace dem {

void add_new(CLI::App& app);
void add_check(CLI::App& app);
void add_specimen(CLI::App& app);
void add_run(CLI::App& app);
void add_info(CLI::App& app);
void add_sieve(CLI::App& app);
void add_profile(CLI::App& app);
void add_micro(CLI::App& app);
void add_report(CLI::App& app);
void add_watch(CLI::App& app);
void add_export(CLI::App& app);
void add_verify(CLI::App& app);
void add_campaign(CLI::App& app);

/// Adds --set key=value, which may be given many times.
void add_set_option(CLI::App& verb, std::vector<std::string>& settings);

/// Adds --max-hours, after which a run saves and ends.
void add_most_hours(CLI::App& verb, double& hours);

/// For names of files and folders: an empty text, as of a variable that is not set, must not mean the default.
CLI::Validator not_empty();

/// Splits "key=value" texts. Throws Error with ExitCode::usage.
std::vector<Override> overrides_from(const std::vector<std::string>& settings);

}  // namespace dem
