// SPDX-License-Identifier: BSD-3-Clause
// Options that several verbs share.
#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "verbs.hpp"

namespace dem {

void add_set_option(CLI::App& verb, std::vector<std::string>& settings) {
  // One value each time, so that a case named after it is not swallowed.
  verb.add_option("--set", settings, "value for a key instead of the case; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->delimiter('\0');
}

void add_most_hours(CLI::App& verb, double& hours) {
  verb.add_option("--max-hours", hours, "save and end after so many hours (exit code 75);\nthe same command goes on")
      ->type_name("H")
      ->check(CLI::PositiveNumber)
      ->take_last();
}

CLI::Validator not_empty() {
  return {[](std::string& text) { return text.empty() ? std::string("the name is empty") : std::string(); }, ""};
}

std::vector<Override> overrides_from(const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  for (const std::string& text : settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(ExitCode::usage,
                  fmt::format("--set {}: must be key=value, as in --set shear.velocity=\"20 mm/s\"", text));
    }
    overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return overrides;
}

}  // namespace dem
