// SPDX-License-Identifier: BSD-3-Clause
// dem4grm run and dem4grm specimen: a case into its output folder, to its end or until shear begins.
#include <omp.h>

#include <cstdlib>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "dem4grm/core/thread_trial.hpp"
#include "dem4grm/runs/run_case.hpp"
#include "progress_line.hpp"
#include "report_writer.hpp"
#include "run_report.hpp"
#include "signals.hpp"
#include "terminal.hpp"
#include "thread_tuner.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

constexpr int k_most_threads = 1024;

struct RunOptions {
  std::string case_path, folder, store, specimen, from;
  int threads = 0;          ///< 0: all processors that this process may use
  double most_hours = 0.0;  ///< 0: no limit
  std::vector<std::string> settings;
  bool is_json = false, is_quiet = false, is_verbose = false;
  bool is_specimen_only = false;
  bool has_no_report = false;
};

Loudness loudness_of(const RunOptions& options) {
  if (options.is_quiet) return Loudness::silent;
  return options.is_verbose ? Loudness::verbose : Loudness::normal;
}

/// Slurm keeps the number of a job, and of each element of an array, when it puts it back into the queue.
std::string batch_job() {
  const char* job = std::getenv("SLURM_JOB_ID");
  return job == nullptr ? std::string() : fmt::format("slurm {}", job);
}

/// The OpenMP runtime ends the program without a word about the run when it cannot have its threads, so they are tried before.
void check_threads(int threads, int processors, bool is_quiet) {
  if (threads > processors && !is_quiet) {
    print_warning(
        fmt::format("{} threads on {} processor{}: threads that wait for one another's turn make a run several times "
                    "slower; -j {} or none is faster, with the same results",
                    threads, processors, processors == 1 ? "" : "s", processors));
  }
  const int possible = possible_threads(threads);
  if (possible < threads) {
    throw Error(ExitCode::memory,
                fmt::format("only {} of {} threads can be started here (limits: ulimit -u, ulimit -v, the "
                            "control group); choose fewer with -j",
                            possible, threads));
  }
}

/// The state of another test that this one starts from.
std::optional<BranchSource> source_of(const RunOptions& options) {
  if (options.from.empty()) {
    if (options.case_path.empty()) throw Error(ExitCode::usage, "CASE is required, or --from\nsee dem4grm run --help");
    return std::nullopt;
  }
  if (!options.specimen.empty()) throw Error(ExitCode::usage, "--from and --specimen exclude each other");
  return read_branch_source(options.from);
}

std::filesystem::path folder_of(const RunOptions& options, const std::optional<BranchSource>& source,
                                const LoadedCase& loaded) {
  if (!options.folder.empty()) return options.folder;
  return source ? default_branch_folder(*source, loaded) : default_folder(case_name(loaded.test));
}

void run(const RunOptions& options) {
  const std::vector<Override> overrides = overrides_from(options.settings);
  std::optional<BranchSource> source = source_of(options);
  const LoadedCase loaded =
      options.case_path.empty() ? branched_case(*source, overrides) : load_case(options.case_path, overrides);
  const std::filesystem::path folder = folder_of(options, source, loaded);
  if (!options.is_quiet) {
    for (const std::string& text : loaded.warnings) print_warning(text);
  }
  const bool is_free = options.threads == 0;  // then the number may change during the run
  const int threads = is_free ? std::min(omp_get_num_procs(), k_most_threads) : options.threads;
  check_threads(threads, omp_get_num_procs(), options.is_quiet);
  omp_set_num_threads(threads);
  install_signals(options.most_hours);
  ProgressLine line(remaining_time_of(loaded.test, options.is_specimen_only), loudness_of(options));
  ThreadTuner tuner(line, threads);
  LabObserver& listener = is_free ? static_cast<LabObserver&>(tuner) : line;
  RunSettings settings;
  settings.folder = folder;
  settings.threads = threads;
  settings.specimen = options.specimen;
  settings.from = source ? &*source : nullptr;
  settings.job = batch_job();
  settings.links.listener = &listener;
  settings.links.stop_flag = &stop_requested;
  settings.links.save_flag = &save_requested;
  settings.links.store = options.store;
  settings.links.is_specimen_only = options.is_specimen_only;
  const RunOutcome outcome = run_case(loaded, settings);
  line.close_line();
  std::error_code ignored;
  if (!options.has_no_report && !(outcome.was_complete && std::filesystem::exists(folder / k_report_file, ignored))) {
    write_report_at_end(folder, options.is_quiet);
  }
  if (options.is_json) {
    JsonObject answer = outcome.summary;
    answer.push_back({"folder", folder.string()});
    answer.push_back({"was_complete", outcome.was_complete});
    print_result(json_text(answer));
  } else if (!options.is_quiet) {
    const bool has_shear = find_field(outcome.summary, "peak_shear_stress_kPa") != nullptr;
    print_result(options.is_specimen_only && !has_shear
                     ? specimen_report(outcome.summary, folder, options.case_path, outcome.was_complete)
                     : run_report(outcome.summary, folder, outcome.was_complete));
  }
}

/// What both verbs can be told.
void add_common(CLI::App& verb, RunOptions& options) {
  CLI::Option* file = verb.add_option(
      "CASE", options.case_path, options.is_specimen_only ? "case file" : "case file; may be left out with --from");
  if (options.is_specimen_only) file->required();
  verb.add_option("-o,--output", options.folder, "output folder, default runs/<name of the case>")
      ->type_name("DIR")
      ->check(not_empty());
  verb.add_option("-j,--threads", options.threads, "threads, same results; default: as many as pay off")
      ->type_name("N")
      ->check(CLI::Range(1, k_most_threads))
      ->take_last();
  add_set_option(verb, options.settings);
  verb.add_option("--store", options.store, "folder of shared preparations; default: in the output")
      ->type_name("DIR")
      ->check(not_empty());
  add_most_hours(verb, options.most_hours);
  verb.add_flag("--no-report", options.has_no_report, "do not write report.html at the end");
  verb.add_flag("--json", options.is_json, "the summary as JSON on stdout, nothing else there");
  verb.add_flag("-q,--quiet", options.is_quiet, "no progress, no report; errors only");
}

}  // namespace

void add_run(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("run", "runs a case; a finished run is only reported");
  const auto options = std::make_shared<RunOptions>();
  add_common(*verb, *options);
  verb->add_option("--specimen", options->specimen, "finished specimen to start from, or its folder")
      ->type_name("FILE")
      ->check(not_empty());
  verb->add_option("--from", options->from, "start from a state of another test (folder or file)")
      ->type_name("PATH")
      ->check(not_empty());
  verb->add_flag("-v,--verbose", options->is_verbose, "also name every stored state");
  verb->footer(
      "Example:\n"
      "  dem4grm run cases/quick.toml -j 2 --set shear.displacement=\"4 mm\"");
  verb->callback([options] { run(*options); });
}

void add_specimen(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("specimen", "prepares the specimen of a case and stops before shear");
  const auto options = std::make_shared<RunOptions>();
  options->is_specimen_only = true;
  add_common(*verb, *options);
  verb->footer(
      "Example:\n"
      "  dem4grm specimen my.toml -o runs/my --store runs/store\n"
      "  dem4grm run my.toml -o runs/my");
  verb->callback([options] { run(*options); });
}

}  // namespace dem
