// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/campaign/test_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/runs/live_folder.hpp"

namespace dem {
namespace {

bool is_file_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

/// Seconds since 1970 of "2031-05-06T07:08:09Z"; 0 when it is none.
double seconds_of(const std::string& utc) {
  std::tm parts{};
  return ::strptime(utc.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parts) == nullptr ? 0.0 : static_cast<double>(::timegm(&parts));
}

std::string log_text(const CampaignFolder& folder, const std::string& test) {
  constexpr std::size_t k_most = 2000;
  std::ifstream file(folder.log(test), std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text.size() > k_most ? "..." + text.substr(text.size() - k_most) : text;
}

/// A test is done when its product files say so.
bool take_summary(const CampaignFolder& folder, TestStatus& status) {
  const std::filesystem::path path = folder.test(status.name) / file_name::k_summary;
  if (!is_file_there(path) || !is_file_there(folder.test(status.name) / file_name::k_results)) return false;
  try {
    status.state_hash = text_in(read_json_file(path), "state_hash");
  } catch (const Error&) {
    return false;  // damaged: the run says more about it
  }
  if (status.state_hash.empty()) return false;
  status.state = TestState::done;
  status.is_past_preparation = true;
  return true;
}

/// True while a process is at work in the folder, as far as can be seen from here.
bool is_at_work(const CampaignFolder& folder, const TestStatus& status) {
  const std::optional<bool> is_locked = is_folder_locked(folder.test(status.name));
  if (is_locked) return *is_locked;
  return std::fabs(utc_now() - seconds_of(status.time)) < k_longest_silence;
}

void take_numbers(const JsonObject& json, TestStatus& status) {
  status.stage = text_in(json, "stage");
  status.time = text_in(json, "time");
  status.host = text_in(json, "host");
  status.progress = number_in(json, "progress", -1.0);
  status.displacement = number_in(json, "displacement_mm") * 1e-3;
  status.shear_stress = number_in(json, "shear_stress_kPa") * 1e3;
  status.void_ratio = number_in(json, "void_ratio");
  status.inertial_number = number_in(json, "inertial_number");
  status.steps_per_second = number_in(json, "steps_per_second");
  status.cause = text_in(json, "cause");
  const double code = number_in(json, "exit_code", -1.0);
  if (code >= 0.0) status.exit_code = static_cast<int>(code);
  const std::string eta = text_in(json, "eta");
  if (!eta.empty()) status.seconds_left = std::max(0.0, seconds_of(eta) - utc_now());
}

void judge(const CampaignFolder& folder, const std::string& run_state, TestStatus& status) {
  const bool has_shear = status.stage == "shear" && status.displacement > 0.0;
  status.is_past_preparation = run_state == "running" || run_state == "specimen ready" || has_shear;
  if (run_state == "failed") {
    status.state = TestState::failed;
    status.is_past_preparation = true;
  } else if (run_state == "stopped" || run_state == "specimen ready") {
    status.state = TestState::stopped;
    if (run_state == "specimen ready") status.cause = "its specimen is ready";
  } else {
    status.state = TestState::running;
  }
  if (is_at_work(folder, status)) {
    status.state = TestState::running;
  } else if (status.state == TestState::running) {
    // With a full disk it could not write its state, but what it said went elsewhere.
    const std::string last_words = log_text(folder, status.name);
    status.state = last_words.empty() ? TestState::lost : TestState::failed;
    status.cause = last_words.empty() ? fmt::format(
                                            "its process ended without a word after {}: killed, or the machine "
                                            "went down",
                                            status.time)
                                      : last_words;
  }
}

double rest_of(const RecordedTest& test, const TestStatus& status) {
  const double all = test.preparation_time + test.test_time;
  if (status.state == TestState::done) return 0.0;
  if (status.state == TestState::running && status.seconds_left) return *status.seconds_left;
  if (status.stage == "shear" && status.progress >= 0.0) return test.test_time * (1.0 - status.progress);
  return status.is_past_preparation && status.state != TestState::failed ? test.test_time : all;
}

}  // namespace

const char* test_state_name(TestState state) {
  constexpr std::array<const char*, 6> k_names{"waiting", "running", "stopped", "lost", "failed", "done"};
  return k_names[static_cast<std::size_t>(state)];
}

TestStatus status_of(const CampaignFolder& folder, const RecordedTest& test) {
  TestStatus status;
  status.name = test.name;
  if (take_summary(folder, status)) return status;
  const std::filesystem::path path = folder.test(test.name) / file_name::k_status;
  if (is_file_there(path)) {
    try {
      const JsonObject json = read_json_file(path);
      take_numbers(json, status);
      judge(folder, text_in(json, "state"), status);
    } catch (const Error& error) {
      status.state = TestState::failed;
      status.cause = error.what();
    }
  } else if (const std::string text = log_text(folder, test.name); !text.empty()) {
    // It ended before it had a folder.
    status.state = TestState::failed;
    status.cause = text;
    status.is_past_preparation = true;
  }
  status.rest = rest_of(test, status);
  return status;
}

std::vector<TestStatus> status_of_all(const CampaignFolder& folder, const CampaignRecord& record) {
  std::vector<TestStatus> all;
  all.reserve(record.tests.size());
  for (const RecordedTest& test : record.tests) all.push_back(status_of(folder, test));
  return all;
}

bool is_settled(const TestStatus& test, bool retries_physics) {
  const bool fails_again =
      test.state == TestState::failed && test.exit_code == static_cast<int>(ExitCode::physics) && !retries_physics;
  return test.state == TestState::done || fails_again;
}

StateCounts count_states(const std::vector<TestStatus>& tests) {
  StateCounts n;
  for (const TestStatus& test : tests) {
    switch (test.state) {
      case TestState::waiting:
        ++n.waiting;
        break;
      case TestState::running:
        ++n.running;
        break;
      case TestState::stopped:
        ++n.stopped;
        break;
      case TestState::lost:
        ++n.lost;
        break;
      case TestState::failed:
        ++n.failed;
        break;
      case TestState::done:
        ++n.done;
        break;
    }
  }
  return n;
}

JsonObject status_as_json(const CampaignRecord& record, const std::vector<TestStatus>& tests) {
  const StateCounts n = count_states(tests);
  JsonList list;
  double rest = 0.0;
  for (const TestStatus& t : tests) {
    rest += t.rest;
    list.emplace_back(JsonObject{{"name", t.name},
                                 {"state", test_state_name(t.state)},
                                 {"stage", t.stage},
                                 {"progress", t.progress >= 0.0 ? JsonValue(t.progress) : JsonValue()},
                                 {"displacement_mm", t.displacement * 1e3},
                                 {"shear_stress_kPa", t.shear_stress / 1e3},
                                 {"void_ratio", t.void_ratio},
                                 {"inertial_number", t.inertial_number},
                                 {"last_sign_of_life", t.time},
                                 {"host", t.host},
                                 {"remaining_s", t.rest},
                                 {"scheduler", t.scheduler.empty() ? JsonValue() : JsonValue(t.scheduler)},
                                 {"exit_code", t.exit_code ? JsonValue(*t.exit_code) : JsonValue()},
                                 {"cause", t.cause.empty() ? JsonValue() : JsonValue(t.cause)},
                                 {"state_hash", t.state_hash.empty() ? JsonValue() : JsonValue(t.state_hash)}});
  }
  return {{"study", record.study},
          {"tests", static_cast<std::int64_t>(tests.size())},
          {"done", n.done},
          {"running", n.running},
          {"waiting", n.waiting},
          {"stopped", n.stopped},
          {"lost", n.lost},
          {"failed", n.failed},
          {"remaining_worker_time_s", rest},
          {"state_of_tests", list}};
}

}  // namespace dem
