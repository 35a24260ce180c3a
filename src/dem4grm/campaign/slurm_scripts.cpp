// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/slurm_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace dem {
namespace {

constexpr double k_time_margin = 1.5;    // forecasts are that good; a job that needs more goes back into the queue
constexpr double k_least_time = 1200.0;  // s
constexpr double k_slurm_memory_margin = 1.5;
constexpr double k_least_memory = 128e6;   // bytes, beside the test: the shell and the libraries
constexpr int k_signal_lead = 180;         // s before the limit; Slurm may be a minute early
constexpr std::size_t k_most_groups = 60;  // with an array of their own

using TaskList = std::vector<const SlurmTask*>;

class ArrayWriter {
 public:
  ArrayWriter(const SlurmOptions& options, const SlurmPlaces& places) : options_(options), places_(places) {}

  /// Adds the tasks as arrays, each as large as the cluster allows. Returns the place of the first.
  int add(const TaskList& tasks, bool prepares, int after_array = -1, int after_index = -1) {
    const int first = static_cast<int>(arrays_.size());
    const auto most = static_cast<std::size_t>(options_.largest_index) + 1;
    for (std::size_t begin = 0; begin < tasks.size(); begin += most) {
      const TaskList part(tasks.begin() + static_cast<std::ptrdiff_t>(begin),
                          tasks.begin() + static_cast<std::ptrdiff_t>(std::min(tasks.size(), begin + most)));
      SlurmArray array;
      array.prepares = prepares;
      array.after_array = after_array;
      array.after_index = after_index;
      for (const SlurmTask* task : part) array.names.push_back(task->name);
      int& number = prepares ? n_preparations_ : n_tests_;
      array.file = fmt::format("{}-{:03d}.sh", prepares ? "preparations" : "tests", ++number);
      array.text = text_of(array, part);
      arrays_.push_back(std::move(array));
    }
    return first;
  }

  std::vector<SlurmArray> take() { return std::move(arrays_); }

 private:
  [[nodiscard]] std::string text_of(const SlurmArray& array, const TaskList& tasks) const {
    double seconds = 0.0, memory = 0.0;
    for (const SlurmTask* task : tasks) {
      seconds = std::max(seconds, array.prepares ? task->preparation_time : task->time);
      memory = std::max(memory, task->memory);
    }
    const std::string stem = array.file.substr(0, array.file.rfind('.'));
    const std::string folder = places_.folder.string();
    std::string text = fmt::format(
        "#!/usr/bin/env bash\n"
        "# {} of {} {}, written by dem4grm campaign run. Without Slurm:\n"
        "#   for k in $(seq 0 {}); do SLURM_ARRAY_TASK_ID=$k bash {}; done\n",
        array.prepares ? "Preparations that tests share:" : "Tests:", tasks.size(), places_.study, tasks.size() - 1,
        array.file);
    const auto line = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
    line(fmt::format("--job-name={}", job_name()));
    line(fmt::format("--array=0-{}{}", tasks.size() - 1,
                     options_.array_limit > 0 ? fmt::format("%{}", options_.array_limit) : ""));
    line("--nodes=1");
    line("--ntasks=1");
    line(fmt::format("--cpus-per-task={}", options_.threads));
    line(fmt::format("--mem={:.0f}M", std::ceil((k_slurm_memory_margin * memory + k_least_memory) / 1e6)));
    line(fmt::format("--time={}", options_.time.empty() ? slurm_time(std::max(k_least_time, k_time_margin * seconds))
                                                        : options_.time));
    line(fmt::format("--signal=B:USR1@{}", k_signal_lead));
    line("--requeue");
    line("--open-mode=append");
    line(fmt::format("--output=\"{}/slurm/logs/{}-%a.out\"", folder, stem));
    if (!options_.partition.empty()) line("--partition=" + options_.partition);
    if (!options_.account.empty()) line("--account=" + options_.account);
    for (const std::string& option : options_.extra) line(option);
    text += "names=(\n";
    for (const SlurmTask* task : tasks) text += fmt::format("  {}\n", task->name);
    text += fmt::format(")\nexec bash {} \"${{names[$SLURM_ARRAY_TASK_ID]}}\" {}\n",
                        shell_quoted(folder + "/slurm/run_test.sh"), array.prepares ? "specimen" : "run");
    return text;
  }

  [[nodiscard]] std::string job_name() const {
    std::string name = places_.study;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ' ' || c == '"' || c == '\n'; }, '_');
    return name;
  }

  const SlurmOptions& options_;
  const SlurmPlaces& places_;
  std::vector<SlurmArray> arrays_;
  int n_preparations_ = 0, n_tests_ = 0;
};

void sort_longest_first(TaskList& tasks) {
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const SlurmTask* a, const SlurmTask* b) { return a->time > b->time; });
}

}  // namespace

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string slurm_time(double seconds) {
  const auto minutes = static_cast<long long>(std::ceil(seconds / 60.0 - 1e-9));
  const long long days = minutes / (24 * 60), hours = minutes / 60 % 24;
  const std::string clock = fmt::format("{:02d}:{:02d}:00", hours, minutes % 60);
  return days > 0 ? fmt::format("{}-{}", days, clock) : clock;
}

std::vector<SlurmArray> slurm_arrays(const std::vector<SlurmTask>& tasks, const SlurmOptions& options,
                                     const SlurmPlaces& places) {
  std::map<std::string, TaskList> groups;
  TaskList single, leaders;
  for (const SlurmTask& task : tasks) {
    task.group.empty() ? single.push_back(&task) : groups[task.group].push_back(&task);
  }
  // A group of which one test is left shares nothing any more.
  for (auto group = groups.begin(); group != groups.end();) {
    const auto leader = std::find_if(group->second.begin(), group->second.end(),
                                     [&](const SlurmTask* task) { return task->name == group->first; });
    const bool is_shared = group->second.size() > 1 && leader != group->second.end();
    if (is_shared) {
      leaders.push_back(*leader);
      ++group;
    } else {
      single.insert(single.end(), group->second.begin(), group->second.end());
      group = groups.erase(group);
    }
  }
  ArrayWriter writer(options, places);
  const auto most = static_cast<std::size_t>(options.largest_index) + 1;
  const int first = writer.add(leaders, true);
  if (groups.size() <= k_most_groups) {
    for (std::size_t k = 0; k < leaders.size(); ++k) {
      TaskList& members = groups.at(leaders[k]->name);
      sort_longest_first(members);
      writer.add(members, false, first + static_cast<int>(k / most), static_cast<int>(k % most));
    }
  } else {
    for (std::size_t begin = 0; begin < leaders.size(); begin += most) {
      TaskList members;
      for (std::size_t k = begin; k < std::min(leaders.size(), begin + most); ++k) {
        const TaskList& of_group = groups.at(leaders[k]->name);
        members.insert(members.end(), of_group.begin(), of_group.end());
      }
      sort_longest_first(members);
      writer.add(members, false, first + static_cast<int>(begin / most));
    }
  }
  sort_longest_first(single);
  writer.add(single, false);
  return writer.take();
}

}  // namespace dem
