// SPDX-License-Identifier: BSD-3-Clause
// --set key=value, shared by the verbs that read a case.
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
