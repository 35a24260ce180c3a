// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/local_campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "dem4grm/campaign/child_process.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

using SteadyClock = std::chrono::steady_clock;
constexpr auto k_poll = std::chrono::milliseconds(20);
constexpr auto k_look = std::chrono::seconds(1);  // status files are written about as often
constexpr double k_memory_margin_of_run = 1.3;

/// A test and what this call does with it.
struct Task {
  const PlannedTest* plan = nullptr;
  const RecordedTest* record = nullptr;
  TestStatus status;
  std::unique_ptr<ChildProcess> process;
  bool is_over = false;  ///< done, or tried by this call

  [[nodiscard]] bool is_running() const { return process != nullptr; }
};

class LocalRun {
 public:
  LocalRun(const CampaignFolder& folder, const CampaignPlan& plan, const CampaignRecord& record,
           const LocalSettings& settings)
      : folder_(folder), settings_(settings) {
    for (std::size_t k = 0; k < plan.tests.size(); ++k) {
      Task task{&plan.tests[k], &record.tests[k], status_of(folder, record.tests[k]), nullptr, false};
      task.is_over = is_settled(task.status, settings.retries_physics);
      tasks_.push_back(std::move(task));
    }
    for (Task& task : tasks_) order_.push_back(&task);
    std::stable_sort(order_.begin(), order_.end(), [](const Task* a, const Task* b) {
      return a->plan->leads != b->plan->leads ? a->plan->leads : a->plan->time() > b->plan->time();
    });
  }

  LocalOutcome run() {
    auto next_look = SteadyClock::now();
    for (;;) {
      collect_ended();
      if (must_stop()) ask_all_for_end();
      if (settings_.save_flag != nullptr && *settings_.save_flag != 0) ask_all_for_checkpoint();
      if (!must_stop()) start_what_can();
      if (n_running() == 0 && (must_stop() || !is_anything_left())) break;
      if (SteadyClock::now() >= next_look) {
        look();
        next_look = SteadyClock::now() + k_look;
      }
      std::this_thread::sleep_for(k_poll);
    }
    LocalOutcome out;
    for (const Task& task : tasks_) out.tests.push_back(task.status);
    out.was_stopped = must_stop() && is_anything_left();
    return out;
  }

 private:
  [[nodiscard]] bool must_stop() const { return settings_.stop_flag != nullptr && *settings_.stop_flag != 0; }
  [[nodiscard]] int n_running() const {
    return static_cast<int>(std::count_if(tasks_.begin(), tasks_.end(), [](const Task& t) { return t.is_running(); }));
  }
  [[nodiscard]] bool is_anything_left() const {
    return std::any_of(tasks_.begin(), tasks_.end(), [](const Task& t) { return !t.is_over; });
  }

  void collect_ended() {
    for (Task& task : tasks_) {
      if (!task.is_running()) continue;
      const std::optional<ProcessEnd> end = task.process->poll();
      if (!end) continue;
      task.process.reset();
      task.status = status_of(folder_, *task.record);
      task.is_over = end->exit_code != static_cast<int>(ExitCode::stopped) || !must_stop();
      explain(task, *end);
      if (settings_.listener != nullptr) settings_.listener->ended(task.status);
    }
  }

  /// What the folder cannot say of a process that ended without writing to it.
  static void explain(Task& task, const ProcessEnd& end) {
    TestStatus& status = task.status;
    if (status.state == TestState::done) return;
    if (end.signal != 0) {
      // It had no time for a word, so what the folder says is of an earlier run.
      status.state = TestState::lost;
      status.exit_code = end.exit_code;
      status.cause = fmt::format("its process was ended by signal {}{}", end.signal,
                                 end.signal == SIGKILL ? ", by hand or for want of memory" : "");
    } else if (end.exit_code == static_cast<int>(ExitCode::folder_in_use)) {
      status.state = TestState::running;
      status.cause = "another process works on it";
    } else if (status.state != TestState::stopped) {
      status.state = TestState::failed;
      if (!status.exit_code) status.exit_code = end.exit_code;
      if (status.cause.empty()) status.cause = fmt::format("its process ended with code {}", end.exit_code);
    }
  }

  void ask_all_for_end() {
    for (Task& task : tasks_) {
      if (task.is_running()) task.process->ask_for_end();
    }
  }

  void ask_all_for_checkpoint() {
    *settings_.save_flag = 0;
    for (Task& task : tasks_) {
      if (task.is_running()) task.process->ask_for_checkpoint();
    }
  }

  /// A test begins when the one that leads its group has its specimen, or has given up.
  [[nodiscard]] bool may_begin(const Task& task) const {
    if (task.plan->group.empty() || task.plan->leads) return true;
    for (const Task& leader : tasks_) {
      if (!leader.plan->leads || leader.plan->group != task.plan->group) continue;
      return leader.is_over || leader.status.is_past_preparation;
    }
    return true;
  }

  [[nodiscard]] bool has_room(const Task& task) const {
    if (settings_.memory <= 0.0 || n_running() == 0) return true;
    double used = k_memory_margin_of_run * task.plan->memory;
    for (const Task& other : tasks_) used += other.is_running() ? k_memory_margin_of_run * other.plan->memory : 0.0;
    return used <= settings_.memory;
  }

  void start_what_can() {
    for (Task* task : order_) {
      if (n_running() >= settings_.crew.workers) return;
      if (task->is_over || task->is_running() || !may_begin(*task) || !has_room(*task)) continue;
      start(*task);
    }
  }

  void start(Task& task) {
    const std::string& name = task.plan->name;
    std::vector<std::string> command{settings_.program.string(),  "run", folder_.case_of(name).string(), "-o",
                                     folder_.test(name).string(), "-q"};
    if (task.plan->steps > 0 && has_specimen_stage(task)) {
      command.insert(command.end(), {"--store", folder_.store().string()});
    }
    if (!settings_.leaves_threads_free) command.insert(command.end(), {"-j", std::to_string(settings_.crew.threads)});
    const bool goes_on = task.status.state == TestState::stopped || task.status.state == TestState::lost;
    task.process = std::make_unique<ChildProcess>(command, folder_.log(name));
    // What the folder says is of the run before until the new one has its first word.
    if (task.status.state == TestState::failed) task.status.is_past_preparation = false;
    task.status.state = TestState::running;
    if (settings_.listener != nullptr) settings_.listener->started(name, goes_on);
  }

  /// A grain compression prepares nothing and takes no store.
  static bool has_specimen_stage(const Task& task) { return task.plan->preparation_time > 0.0; }

  void look() {
    std::vector<TestStatus> running;
    std::vector<TestStatus> all;
    double rest = 0.0;
    double longest = 0.0;
    for (Task& task : tasks_) {
      if (task.is_running()) {
        task.status = status_of(folder_, *task.record);
        // Before its first word, and in the moment between two files.
        if (task.status.state != TestState::done) task.status.state = TestState::running;
        running.push_back(task.status);
      }
      if (!task.is_over) rest += task.status.rest, longest = std::max(longest, task.status.rest);
      all.push_back(task.status);
    }
    const double left = std::max(longest, rest / settings_.crew.workers);
    if (settings_.listener != nullptr) settings_.listener->progress(running, count_states(all), left);
  }

  const CampaignFolder& folder_;
  const LocalSettings& settings_;
  std::vector<Task> tasks_;
  std::vector<Task*> order_;
};

}  // namespace

LocalOutcome run_locally(const CampaignFolder& folder, const CampaignPlan& plan, const CampaignRecord& record,
                         const LocalSettings& settings) {
  require(plan.tests.size() == record.tests.size(), "plan and record of a campaign are of one study");
  return LocalRun(folder, plan, record, settings).run();
}

}  // namespace dem
