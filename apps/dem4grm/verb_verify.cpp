// SPDX-License-Identifier: BSD-3-Clause
// dem4grm verify: runs the verification suite and shows expected and obtained values.
#include <omp.h>

#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/report/verification_manual.hpp"
#include "dem4grm/results/output_file.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

struct VerifyOptions {
  std::vector<std::string> names;
  bool is_quick = false, is_list = false, is_json = false, stops = false;
  int threads = 0;  ///< 0: all processors that this process may use
  std::string manual_folder;
};

std::string list_text() {
  std::string text;
  for (const VerificationCase& c : verification_cases()) {
    text += fmt::format("{:<24} {:<6} {}\n", c.name, c.extent == Extent::quick ? "quick" : "", c.title);
  }
  return text;
}

void write_manual(const std::filesystem::path& folder, const std::vector<CaseOutcome>& outcomes) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw IoError(fmt::format("{}: cannot be made: {}", folder.string(), failure.message()));
  replace_file(folder / "manual.md", verification_manual(outcomes));
  replace_file(folder / "curves.json", json_text(verification_curves(outcomes)));
}

void verify(const VerifyOptions& options) {
  if (options.is_list) {
    print_result(list_text());
    return;
  }
  const std::vector<const VerificationCase*> chosen =
      select_cases(options.names, options.is_quick ? Extent::quick : Extent::full);
  omp_set_num_threads(options.threads > 0 ? options.threads : omp_get_num_procs());
  if (!options.is_json) print_result(verification_table_head());
  std::vector<CaseOutcome> outcomes;
  int missed = 0;
  for (const VerificationCase* tested : chosen) {
    outcomes.push_back(run_case_of_suite(*tested));
    const CaseOutcome& outcome = outcomes.back();
    missed += outcome.missed();
    if (!options.is_json) print_result(verification_table_rows(outcome));
    print_note(fmt::format("{} of {}: {}, {:.1f} s", outcomes.size(), chosen.size(), tested->title, outcome.seconds));
    if (options.stops && missed > 0) break;
  }
  print_result(options.is_json ? json_text(verification_json(outcomes)) : verification_verdict(outcomes));
  if (!options.manual_folder.empty()) write_manual(options.manual_folder, outcomes);
  if (missed > 0) throw Error(ExitCode::missed, fmt::format("{} checked quantities missed their tolerance", missed));
}

}  // namespace

void add_verify(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("verify", "holds the engine against numbers of others");
  const auto options = std::make_shared<VerifyOptions>();
  verb->add_option("--only", options->names, "run this case; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  verb->add_flag("--quick", options->is_quick, "only the cases that take seconds");
  verb->add_flag("--stop", options->stops, "stop after the first case with a miss");
  verb->add_flag("--list", options->is_list, "names and titles of the cases, runs nothing");
  verb->add_flag("--json", options->is_json, "the quantities as JSON on stdout, nothing else there");
  verb->add_option("-j,--threads", options->threads, "threads, default all;\nany number gives the same results")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--manual", options->manual_folder, "also write the manual and its curves into this folder")
      ->type_name("DIR");
  verb->footer("Example:\n  dem4grm verify --only hertz-impact-spheres");
  verb->callback([options] { verify(*options); });
}

}  // namespace dem
