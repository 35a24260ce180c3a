// SPDX-License-Identifier: BSD-3-Clause
// dem4grm run: a case into its output folder.
#include <omp.h>

#include <memory>

#include <fmt/format.h>

#include "dem4grm/io/run_case.hpp"
#include "progress_line.hpp"
#include "run_report.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "thread_tuner.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

constexpr int k_most_threads = 1024;

struct RunOptions {
  std::string case_path, folder;
  int threads = 0;  ///< 0: all processors that this process may use
  std::vector<std::string> settings;
  bool is_json = false, is_quiet = false, is_verbose = false;
};

Loudness loudness_of(const RunOptions& options) {
  if (options.is_quiet) return Loudness::silent;
  return options.is_verbose ? Loudness::verbose : Loudness::normal;
}

void run(const RunOptions& options) {
  const std::vector<Override> overrides = overrides_from(options.settings);
  const LoadedCase loaded = load_case(options.case_path, overrides);
  const std::filesystem::path folder =
      options.folder.empty() ? default_folder(case_name(loaded.test)) : std::filesystem::path(options.folder);
  if (!options.is_quiet) {
    for (const std::string& text : loaded.warnings) print_warning(text);
  }
  const bool is_free = options.threads == 0;  // then the number may change during the run
  const int threads = is_free ? std::min(omp_get_num_procs(), k_most_threads) : options.threads;
  omp_set_num_threads(threads);
  install_stop_signals();
  ProgressLine line(remaining_time_of(loaded.test), loudness_of(options));
  ThreadTuner tuner(line, threads);
  LabObserver& listener = is_free ? static_cast<LabObserver&>(tuner) : line;
  const RunOutcome outcome = run_case(loaded, {folder, threads, {&listener, &stop_requested}});
  line.close_line();
  if (options.is_json) {
    JsonObject answer = outcome.summary;
    answer.push_back({"folder", folder.string()});
    answer.push_back({"was_complete", outcome.was_complete});
    print_result(json_text(answer));
  } else if (!options.is_quiet) {
    print_result(run_report(outcome.summary, folder, outcome.was_complete));
  }
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("run", "runs a case; a finished run is only reported");
  const auto options = std::make_shared<RunOptions>();
  verb->add_option("CASE", options->case_path, "case file")->required();
  verb->add_option("-o,--output", options->folder, "output folder, default runs/<name of the case>")->type_name("DIR");
  verb->add_option("-j,--threads", options->threads,
                   "threads; by default as many processors as pay off,\nany number gives the same results")
      ->type_name("N")
      ->check(CLI::Range(1, k_most_threads));
  add_set_option(*verb, options->settings);
  verb->add_flag("--json", options->is_json, "the summary as JSON on stdout, nothing else there");
  verb->add_flag("-q,--quiet", options->is_quiet, "no progress, no report; errors only");
  verb->add_flag("-v,--verbose", options->is_verbose, "also name every stored state");
  verb->footer(
      "Example:\n"
      "  dem4grm run cases/quick.toml -j 2 --set shear.displacement=\"4 mm\"");
  verb->callback([options] { run(*options); });
}

}  // namespace dem
