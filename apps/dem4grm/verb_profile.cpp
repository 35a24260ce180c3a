// SPDX-License-Identifier: BSD-3-Clause
// dem4grm profile: displacement, rotation, density and load over the height of a sheared specimen.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/profile_file.hpp"
#include "dem4grm/results/results_file.hpp"
#include "read_apart.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct ProfileVerbOptions {
  std::string path, at, csv;
  int layers = 0;
  bool is_json = false;
};

const StateProfile& chosen_state(const std::vector<StateProfile>& states, const std::string& at) {
  if (at.empty()) return states.back();
  const ParsedQuantity wanted = parse_quantity(at, Dimension::length);
  if (!wanted.value) throw Error(ExitCode::usage, fmt::format("--at {} {}", at, wanted.problem));
  return *std::min_element(states.begin(), states.end(), [&](const StateProfile& a, const StateProfile& b) {
    return std::fabs(a.displacement - *wanted.value) < std::fabs(b.displacement - *wanted.value);
  });
}

void show_profile(const ProfileVerbOptions& given) {
  const std::filesystem::path results = results_in(given.path);
  const std::vector<StateProfile> states = read_profiles(results, given.layers);
  const StateProfile& state = chosen_state(states, given.at);
  if (!given.csv.empty()) {
    TableFile table(given.csv, profile_columns());
    append_profiles(table, states);
  }
  if (given.is_json) {
    print_result(json_text(profiles_as_json(states)));
    return;
  }
  print_result(fmt::format("{}: state at {:.3f} mm\n", results.string(), state.displacement * 1e3) +
               profile_text(state));
}

}  // namespace

void add_profile(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("profile", "movement, density and load over the height");
  const auto options = std::make_shared<ProfileVerbOptions>();
  verb->add_option("DIR", options->path, "output folder, or its results.h5")->required();
  verb->add_option("--at", options->at, "nearest stored state, as 8mm; default the last")->type_name("LENGTH");
  verb->add_option("--layers", options->layers, "default: one for each mean grain size")
      ->type_name("N")
      ->check(CLI::Range(1, k_most_profile_layers).description(""));
  verb->add_option("--csv", options->csv, "writes all states and layers there, as profiles.csv")->type_name("FILE");
  verb->add_flag("--json", options->is_json, "all states as one JSON object on stdout");
  verb->footer("Example:\n  dem4grm profile runs/quick --at 8mm");
  verb->callback([options] { read_apart(options->path, [&] { show_profile(*options); }); });
}

}  // namespace dem
