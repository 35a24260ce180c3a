// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/slurm_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/output_file.hpp"

namespace dem {
namespace {

std::filesystem::path jobs_file(const CampaignFolder& folder) { return folder.slurm() / "jobs.json"; }

void write_script(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  if (!file.flush()) throw_io_error(path, "cannot be written");
}

void write_scripts(const CampaignFolder& folder, const SlurmPlaces& places, const std::vector<SlurmArray>& arrays) {
  std::error_code error;
  std::filesystem::create_directories(folder.slurm() / "logs", error);
  if (error) throw IoError(fmt::format("{}: the folder cannot be made: {}", folder.slurm().string(), error.message()));
  write_script(folder.slurm() / "run_test.sh", slurm_test_script(places));
  for (const SlurmArray& array : arrays) write_script(folder.slurm() / array.file, array.text);
}

/// Script names of one call must not be those of an earlier one whose jobs are still waiting: Slurm has its own copy, but
/// a reader looks here.
void number_after(const std::vector<SlurmJob>& earlier, std::vector<SlurmArray>& arrays) {
  if (earlier.empty()) return;
  for (SlurmArray& array : arrays) {
    const std::string file = fmt::format("call{}-{}", earlier.size() + 1, array.file);
    array.text.replace(array.text.find(array.file), array.file.size(), file);
    array.file = file;
  }
}

}  // namespace

std::map<std::string, SlurmElement> slurm_states(const CampaignFolder& folder) {
  const std::vector<SlurmJob> jobs = read_jobs(jobs_file(folder));
  const std::map<std::string, SlurmElement> queue = ask_queue(jobs);
  std::map<std::string, SlurmElement> by_test;
  for (const SlurmJob& job : jobs) {
    for (std::size_t k = 0; k < job.names.size(); ++k) {
      const auto found = queue.find(fmt::format("{}_{}", job.id, k));
      if (found == queue.end()) continue;
      // A preparation says where a test stands only while nothing else does.
      if (job.prepares && by_test.contains(job.names[k])) continue;
      if (!job.prepares || found->second.state != "PENDING") by_test[job.names[k]] = found->second;
    }
  }
  return by_test;
}

SlurmSubmission run_on_slurm(const CampaignFolder& folder, const CampaignPlan& plan, const CampaignRecord& record,
                             const SlurmSettings& settings) {
  const bool asks_slurm = !settings.is_dry_run;
  const std::map<std::string, SlurmElement> known =
      asks_slurm ? slurm_states(folder) : std::map<std::string, SlurmElement>();
  SlurmSubmission out;
  std::vector<SlurmTask> tasks;
  for (std::size_t k = 0; k < plan.tests.size(); ++k) {
    const PlannedTest& test = plan.tests[k];
    if (is_settled(status_of(folder, record.tests[k]), settings.retries_physics)) {
      ++out.settled;
    } else if (known.contains(test.name)) {
      ++out.in_queue;
    } else {
      tasks.push_back({test.name, test.group, test.preparation_time, test.time(), test.memory});
    }
  }
  out.submitted = static_cast<int>(tasks.size());
  if (tasks.empty()) return out;
  SlurmOptions options = settings.options;
  if (asks_slurm) options.largest_index = largest_array_index();
  const SlurmPlaces places{settings.program, std::filesystem::absolute(folder.root()).lexically_normal(), record.study};
  out.arrays = slurm_arrays(tasks, options, places);
  std::vector<SlurmJob> jobs = read_jobs(jobs_file(folder));
  const std::size_t before = jobs.size();
  number_after(jobs, out.arrays);
  write_scripts(folder, places, out.arrays);
  if (settings.is_dry_run) return out;
  try {
    submit(out.arrays, folder.slurm(), jobs);
  } catch (...) {
    write_jobs(jobs_file(folder), jobs);  // what is in the queue must be known to the next call
    throw;
  }
  write_jobs(jobs_file(folder), jobs);
  out.jobs.assign(jobs.begin() + static_cast<std::ptrdiff_t>(before), jobs.end());
  return out;
}

void join_states(std::vector<TestStatus>& tests, const std::map<std::string, SlurmElement>& slurm) {
  for (TestStatus& test : tests) {
    const auto found = slurm.find(test.name);
    if (found == slurm.end() || test.state == TestState::done) continue;
    const SlurmElement& element = found->second;
    test.scheduler = fmt::format("job {} {}{}", element.job, element.state,
                                 element.reason.empty() ? "" : fmt::format(" ({})", element.reason));
    if (test.state != TestState::running && element.state == "PENDING") test.state = TestState::waiting;
  }
}

}  // namespace dem
