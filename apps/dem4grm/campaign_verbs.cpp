// SPDX-License-Identifier: BSD-3-Clause
// What the verbs of dem4grm campaign do.
#include "campaign_verbs.hpp"

#include <chrono>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "campaign_progress.hpp"
#include "campaign_report.hpp"
#include "dem4grm/campaign/collect.hpp"
#include "dem4grm/campaign/local_campaign.hpp"
#include "dem4grm/campaign/slurm_campaign.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "dem4grm/runs/stop_cause.hpp"
#include "report_writer.hpp"
#include "signals.hpp"
#include "terminal.hpp"

namespace dem {
namespace {

/// Of a test on a node of a cluster: a large one takes a day on one thread, and many threads wait for each other.
constexpr int k_threads_on_slurm = 4;

double memory_of(const CampaignOptions& options) {
  return options.memory_gigabytes > 0.0 ? 1e9 * options.memory_gigabytes : free_memory();
}

Study read_study(const CampaignOptions& options) {
  Study study = load_study(options.study);
  if (!options.is_quiet) {
    for (const std::string& text : study.warnings) print_warning(text);
  }
  return study;
}

}  // namespace

void plan_study(const CampaignOptions& options) {
  const Study study = read_study(options);
  const CampaignPlan planned = plan_campaign(study, options.crew, memory_of(options));
  print_result(options.is_json
                   ? json_text(plan_as_json(study, planned))
                   : plan_text(study, planned) + fmt::format("  next: dem4grm campaign run {}\n", options.study));
}

namespace {

/// The program that runs the tests: this one.
std::filesystem::path own_program() {
  std::error_code error;
  std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw IoError(fmt::format("/proc/self/exe: {}", error.message()));
  return program;
}

std::filesystem::path folder_for(const CampaignOptions& options, const Study& study) {
  return options.folder.empty() ? default_folder(study.name) : std::filesystem::path(options.folder);
}

void make_root(const std::filesystem::path& root) {
  std::error_code error;
  std::filesystem::create_directories(root, error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", root.string(), error.message()));
}

void report(const CampaignOptions& options, const CampaignFolder& folder, const CampaignRecord& record,
            const std::vector<TestStatus>& tests) {
  if (options.is_json) {
    print_result(json_text(status_as_json(record, tests)));
  } else if (!options.is_quiet) {
    print_result(status_text(record, tests, folder.root()));
  }
}

/// Tests that a call has to run. With one of them there is nothing to measure: it takes all processors as far as they pay
/// off; with none there is nothing to do.
int count_left(const CampaignFolder& folder, const Study& study, bool retries) {
  int left = 0;
  for (const StudyTest& test : study.tests) {
    left += is_settled(status_of(folder, {test.name, {}, {}, 0.0, 0.0, 0.0}), retries) ? 0 : 1;
  }
  return left;
}

/// The scripts for people: the first as a whole, of the others where they lie.
std::string scripts_text(const SlurmSubmission& submission, const CampaignFolder& folder) {
  std::string text;
  if (!submission.arrays.empty()) text += submission.arrays.front().text + "\n";
  for (const SlurmArray& array : submission.arrays) {
    text += fmt::format(
        "  {}: {} element(s){}\n", (folder.slurm() / array.file).string(), array.names.size(),
        array.after_array < 0
            ? ""
            : fmt::format(", after {}{}", submission.arrays[static_cast<std::size_t>(array.after_array)].file,
                          array.after_index < 0 ? "" : fmt::format(" [{}]", array.after_index)));
  }
  return text;
}

}  // namespace

void run_study_on_cluster(const CampaignOptions& options) {
  if (options.crew.workers > 0) {
    throw Error(ExitCode::usage, "-w is for this machine; on Slurm --array-limit says how many tests run at a time");
  }
  const Study study = read_study(options);
  const CampaignFolder folder(folder_for(options, study));
  make_root(folder.root());
  const FolderLock lock(folder.root());
  SlurmSettings settings;
  settings.program = own_program();
  settings.options = options.slurm;
  settings.options.threads = options.crew.threads > 0 ? options.crew.threads : k_threads_on_slurm;
  settings.retries_physics = options.retries;
  settings.is_dry_run = options.is_dry_run;
  const CampaignPlan planned = plan_campaign(study, {1, settings.options.threads}, memory_of(options));
  for (const std::string& text : write_campaign(folder, study, planned)) print_note(text);
  const SlurmSubmission submission = run_on_slurm(folder, planned, read_campaign(folder), settings);
  if (options.is_quiet) return;
  std::string text = options.is_dry_run ? scripts_text(submission, folder) : "";
  for (const SlurmJob& job : submission.jobs) {
    text += fmt::format("  job {}: {}, {} element(s)\n", job.id, job.file, job.names.size());
  }
  text +=
      fmt::format("{} test(s) {}, {} in the queue already, {} done or not to be tried again\n", submission.submitted,
                  options.is_dry_run ? "would be submitted" : "submitted", submission.in_queue, submission.settled);
  print_result(text + fmt::format("  next: dem4grm campaign status {}\n", folder.root().string()));
}

void run_study_here(const CampaignOptions& options) {
  install_signals(options.most_hours);
  const Study study = read_study(options);
  const CampaignFolder folder(folder_for(options, study));
  make_root(folder.root());
  const FolderLock lock(folder.root());
  if (!lock.note().empty() && !options.is_quiet) print_note(lock.note());
  const int left = count_left(folder, study, options.retries);
  const bool is_free = left <= 1 && options.crew.workers == 0 && options.crew.threads == 0;
  const double memory = memory_of(options);
  const CampaignPlan planned = plan_campaign(study, is_free ? CrewWish{1, 0} : options.crew, memory,
                                             left == 0 ? 0.0
                                             : is_free ? 0.1
                                                       : k_plan_trial);
  for (const std::string& text : write_campaign(folder, study, planned)) print_note(text);
  const CampaignRecord record = read_campaign(folder);

  CampaignProgress progress(options.is_quiet);
  LocalSettings settings;
  settings.program = own_program();
  settings.crew = planned.crew;
  settings.leaves_threads_free = is_free;
  settings.memory = memory;
  settings.retries_physics = options.retries;
  settings.stop_flag = &stop_requested;
  settings.save_flag = &save_requested;
  settings.listener = &progress;
  if (!options.is_quiet && !is_free) {
    print_note(fmt::format("{} tests, {} at a time with {} thread(s) each, about {}", study.tests.size(),
                           planned.crew.workers, planned.crew.threads, duration_text(planned.time)));
  }
  const LocalOutcome outcome = run_locally(folder, planned, record, settings);
  const StateCounts n = count_states(outcome.tests);
  if (n.done > 0 && !options.has_no_report) write_report_at_end(folder.root(), options.is_quiet);
  report(options, folder, record, outcome.tests);
  if (outcome.was_stopped) {
    throw Error(ExitCode::stopped, fmt::format("stopped {}; the same command goes on: dem4grm campaign run {} -o {}",
                                               stop_words(stop_requested), options.study, folder.root().string()));
  }
  if (n.done < n.all()) {
    throw Error(
        ExitCode::missed,
        fmt::format("{} of {} tests are not done; their causes stand above. The same command tries them again{}",
                    n.all() - n.done, n.all(),
                    options.retries ? "" : ", but those that failed in their physics only with --retry"));
  }
}

namespace {

/// What Slurm says, where something was submitted; a machine that cannot ask says what the folders say.
void join_scheduler(const CampaignFolder& folder, std::vector<TestStatus>& tests) {
  try {
    join_states(tests, slurm_states(folder));
  } catch (const IoError& error) {
    print_warning(fmt::format("Slurm cannot be asked from here, so only the folders speak: {}", error.what()));
  }
}

}  // namespace

void show_campaign_status(const CampaignOptions& options) {
  const CampaignFolder folder(options.folder);
  install_signals();
  for (;;) {
    const CampaignRecord record = read_campaign(folder);
    std::vector<TestStatus> tests = status_of_all(folder, record);
    join_scheduler(folder, tests);
    report(options, folder, record, tests);
    const StateCounts n = count_states(tests);
    if (!options.is_watch || stop_requested != 0 || n.done + n.failed == n.all()) return;
    print_result("\n");
    for (int k = 0; k < 50 && stop_requested == 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (stop_requested != 0) return;
  }
}

void collect_campaign(const CampaignOptions& options) {
  const CampaignFolder folder(options.folder);
  const CampaignRecord record = read_campaign(folder);
  std::vector<CollectedTest> finished;
  for (const RecordedTest& test : record.tests) {
    if (status_of(folder, test).state == TestState::done)
      finished.push_back({test.name, test.values, folder.test(test.name)});
  }
  if (finished.empty()) {
    throw Error(ExitCode::missing_file, fmt::format("{}: no test of the study is done yet", folder.root().string()));
  }
  const Collection collection = read_collection(finished);
  for (const std::string& text : collection.warnings) print_warning(text);
  const std::filesystem::path place =
      options.output.empty() ? folder.root() / "collected" : std::filesystem::path(options.output);
  make_root(place);
  write_collection(collection, place);
  print_result(fmt::format("study {}: {} of {} tests collected in {}\n{}  next: tools/plot_campaign.py {}\n",
                           record.study, collection.tests.size(), record.tests.size(), place.string(),
                           envelopes_text(collection), place.string()));
}

}  // namespace dem
