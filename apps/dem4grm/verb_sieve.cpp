// SPDX-License-Identifier: BSD-3-Clause
// dem4grm sieve: simulated sieve analysis of a stored specimen.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/sieve_report.hpp"
#include "read_apart.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct SieveOptions {
  std::string path, csv;
  std::vector<std::string> sieves;
  bool is_json = false;
};

/// Openings in m. Throws Error with ExitCode::usage that names every text that is none.
std::vector<double> openings_from(const std::vector<std::string>& texts) {
  std::vector<double> openings;
  std::string problems;
  for (const std::string& text : texts) {
    const ParsedQuantity opening = parse_quantity(text, Dimension::length);
    if (opening.value && *opening.value > 0.0) {
      openings.push_back(*opening.value);
    } else {
      problems += fmt::format("\n--sieves: \"{}\" {}", text, opening.value ? "is not positive" : opening.problem);
    }
  }
  if (!problems.empty()) throw Error(ExitCode::usage, problems.substr(1));
  return openings;
}

void sieve(const SieveOptions& options) {
  const std::vector<double> openings = openings_from(options.sieves);
  const SieveReport report = sieve_report(read_stored_grains(options.path), openings);
  if (!options.csv.empty()) replace_file(options.csv, sieve_csv(report));
  print_result(options.is_json ? json_text(sieve_json(report)) : sieve_text(report));
}

}  // namespace

void add_sieve(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("sieve", "simulated sieve analysis of a stored specimen");
  const auto options = std::make_shared<SieveOptions>();
  verb->add_option("PATH", options->path, "output folder, specimen.h5 or results.h5")->required();
  verb->add_option("--sieves", options->sieves, "openings, as 2mm,4mm,5.6mm; by default those\nof the input gradings")
      ->type_name("LIST")
      ->allow_extra_args(false)
      ->delimiter(',');
  verb->add_option("--csv", options->csv, "also write the table to this file, for plots")->type_name("FILE");
  verb->add_flag("--json", options->is_json, "as one JSON object on stdout");
  verb->footer("Example:\n  dem4grm sieve runs/quick --sieves 2mm,4mm,5.6mm,8mm --csv sieve.csv");
  verb->callback([options] { read_apart(options->path, [&] { sieve(*options); }); });
}

}  // namespace dem
