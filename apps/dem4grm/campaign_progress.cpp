// SPDX-License-Identifier: BSD-3-Clause
#include "campaign_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "campaign_report.hpp"
#include "terminal.hpp"

namespace dem {
namespace {

constexpr auto k_interval_of_plain_lines = std::chrono::seconds(10);
constexpr std::size_t k_most_tests_on_screen = 20;

}  // namespace

CampaignProgress::CampaignProgress(bool is_quiet) : is_quiet_(is_quiet), is_terminal_(is_error_stream_a_terminal()) {}

void CampaignProgress::clear() {
  for (; open_lines_ > 0; --open_lines_) std::cerr << "\033[A\033[2K";
}

void CampaignProgress::started(const std::string& test, bool goes_on) {
  if (is_quiet_) return;
  clear();
  print_note(fmt::format("{} {}", test, goes_on ? "goes on" : "begins"));
}

void CampaignProgress::ended(const TestStatus& test) {
  const bool is_well = test.state == TestState::done || test.state == TestState::stopped;
  if (is_quiet_ && is_well) return;
  clear();
  if (test.state == TestState::done) {
    print_note(fmt::format("{} is done, hash {}", test.name, test.state_hash));
  } else if (is_well) {
    print_note(fmt::format("{} is stopped and can go on", test.name));
  } else if (test.state == TestState::running) {
    print_warning(fmt::format("{} is left to another process, which works on it", test.name));
  } else {
    print_warning(
        fmt::format("{} {}: {}", test.name, test.state == TestState::lost ? "was lost" : "failed", test.cause));
  }
}

void CampaignProgress::progress(const std::vector<TestStatus>& running, const StateCounts& all, double seconds_left) {
  if (is_quiet_) return;
  const auto now = std::chrono::steady_clock::now();
  if (!is_terminal_ && now - shown_at_ < k_interval_of_plain_lines) return;
  shown_at_ = now;
  clear();
  std::size_t width = 0;
  for (const TestStatus& test : running) width = std::max(width, test.name.size());
  std::vector<std::string> lines;
  for (const TestStatus& test : running) {
    if (lines.size() < k_most_tests_on_screen) lines.push_back(running_text(test, width));
  }
  lines.push_back(
      fmt::format("{}; all done {} ({})", counts_text(all), finish_text(seconds_left), duration_text(seconds_left)));
  const auto columns = static_cast<std::size_t>(std::max(terminal_width() - 1, 20));
  for (std::string& line : lines) {
    if (is_terminal_) line.resize(std::min(line.size(), columns));  // a line that wraps could not be written over
    std::cerr << line << '\n';
  }
  std::cerr << std::flush;
  if (is_terminal_) open_lines_ = static_cast<int>(lines.size());
}

}  // namespace dem
