// SPDX-License-Identifier: BSD-3-Clause
#include "campaign_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/runs/folder_lock.hpp"
#include "terminal.hpp"

namespace dem {
namespace {

template <class Test>
std::size_t width_of_names(const std::vector<Test>& tests) {
  std::size_t width = 4;
  for (const Test& test : tests) width = std::max(width, test.name.size());
  return width;
}

std::string size_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string grains_text_of(const PlannedTest& test) {
  if (test.clumps == 0) return fmt::format("{} rubber", test.rubber_grains);
  return test.rubber_grains == 0 ? fmt::format("{} gravel", test.clumps)
                                 : fmt::format("{} + {}", test.clumps, test.rubber_grains);
}

std::string sharing_text(const CampaignPlan& plan, const PlannedTest& test) {
  if (test.group.empty()) return "-";
  if (!test.leads) return "with " + test.group;
  const auto others = std::count_if(plan.tests.begin(), plan.tests.end(),
                                    [&](const PlannedTest& other) { return other.group == test.group; }) -
                      1;
  return fmt::format("made here for {} more", others);
}

/// The first line of a text, shortened.
std::string first_line(const std::string& text) {
  constexpr std::size_t k_most = 160;
  std::string line = text.substr(0, text.find('\n'));
  return line.size() > k_most ? line.substr(0, k_most) + "..." : line;
}

}  // namespace

std::string finish_text(double seconds_ahead) { return clock_text(utc_now(), seconds_ahead); }

std::string plan_text(const Study& study, const CampaignPlan& plan) {
  const std::size_t width = width_of_names(plan.tests);
  std::string text =
      fmt::format("study {}: {} test{}\n", study.name, plan.tests.size(), plan.tests.size() == 1 ? "" : "s");
  text += fmt::format("  {:<{}}  {:<14} {:>9} {:>9} {:>8} {:>8}  {:<8}  {}\n", "test", width, "gravel + rubber",
                      "specimen", "shear", "memory", "disk", "I", "preparation");
  for (std::size_t k = 0; k < std::min(plan.tests.size(), k_most_rows_shown); ++k) {
    const PlannedTest& t = plan.tests[k];
    text += fmt::format("  {:<{}}  {:<15} {:>9} {:>9} {:>8} {:>8}  {:<8}  {}\n", t.name, width, grains_text_of(t),
                        duration_text(t.preparation_time), duration_text(t.test_time), size_text(t.memory),
                        size_text(t.results_size), fmt::format("{:.1e}", t.inertial_number), sharing_text(plan, t));
  }
  if (plan.tests.size() > k_most_rows_shown) {
    text += fmt::format("  and {} more; --json lists all\n", plan.tests.size() - k_most_rows_shown);
  }
  text +=
      fmt::format("  about {}: {} at a time with {} thread{} each; done {} if begun now\n", duration_text(plan.time),
                  plan.crew.workers, plan.crew.threads, plan.crew.threads == 1 ? "" : "s", finish_text(plan.time));
  text += fmt::format("  memory {}, disk {} when all is done, shared preparations included\n", size_text(plan.memory),
                      size_text(plan.disk));
  return text;
}

std::string counts_text(const StateCounts& n) {
  std::string text = fmt::format("{} of {} done", n.done, n.all());
  const auto add = [&](int number, const char* what) {
    if (number > 0) text += fmt::format(", {} {}", number, what);
  };
  add(n.running, "running");
  add(n.waiting, "waiting");
  add(n.stopped, "stopped");
  add(n.lost, "lost");
  add(n.failed, "failed");
  return text;
}

std::string running_text(const TestStatus& t, std::size_t width) {
  std::string text = fmt::format("{:<{}}  {}", t.name, width, t.stage.empty() ? "begins" : t.stage);
  if (t.progress >= 0.0) text += fmt::format(" {:.1f} %", 100.0 * t.progress);
  if (t.seconds_left)
    text += fmt::format("  done {} ({})", finish_text(*t.seconds_left), duration_text(*t.seconds_left));
  if (t.displacement > 0.0)
    text += fmt::format("  {:.3f} mm  tau {:.1f} kPa", 1e3 * t.displacement, t.shear_stress / 1e3);
  if (t.void_ratio > 0.0) text += fmt::format("  e {:.3f}", t.void_ratio);
  if (t.inertial_number > 0.0) text += fmt::format("  I {:.1e}", t.inertial_number);
  if (t.steps_per_second > 0.0) text += fmt::format("  {:.0f} steps/s", t.steps_per_second);
  return text;
}

std::string status_text(const CampaignRecord& record, const std::vector<TestStatus>& tests,
                        const std::filesystem::path& folder) {
  const std::size_t width = width_of_names(tests);
  const StateCounts n = count_states(tests);
  std::string text = fmt::format("study {} in {}: {}\n", record.study, folder.string(), counts_text(n));
  std::size_t shown = 0;
  double rest = 0.0;
  for (const TestStatus& t : tests) {
    rest += t.rest;
    if ((t.state == TestState::waiting && t.scheduler.empty()) || shown++ >= k_most_rows_shown) continue;
    if (t.state == TestState::running) {
      text += fmt::format("  running  {}{}\n", running_text(t, width), t.scheduler.empty() ? "" : "  " + t.scheduler);
    } else if (t.state == TestState::done) {
      text += fmt::format("  done     {:<{}}  hash {}\n", t.name, width, t.state_hash);
    } else {
      text += fmt::format("  {:<7}  {:<{}}  {}\n", test_state_name(t.state), t.name, width,
                          t.cause.empty() ? t.scheduler : first_line(t.cause));
    }
  }
  if (shown > k_most_rows_shown) text += fmt::format("  and {} more; --json lists all\n", shown - k_most_rows_shown);
  if (rest > 0.0) text += fmt::format("  left: about {} of one worker\n", duration_text(rest));
  return text;
}

}  // namespace dem
