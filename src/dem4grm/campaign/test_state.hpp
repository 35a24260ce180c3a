// SPDX-License-Identifier: BSD-3-Clause
// Where the tests of a campaign stand, judged by their folders alone: no process is asked, so it works from any machine that
// sees the folders.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem4grm/campaign/campaign_folder.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

enum class TestState {
  waiting,  ///< not begun
  running,  ///< a process is at work
  stopped,  ///< on request; goes on from its checkpoint
  lost,     ///< its process ended without a word; goes on from its last checkpoint
  failed,
  done,
};

/// "waiting", "running", ...
const char* test_state_name(TestState state);

struct TestStatus {
  std::string name;
  TestState state = TestState::waiting;
  std::string stage;  ///< of the run: "fill", ..., "shear"
  std::string cause;  ///< why it failed, stopped or was lost
  std::optional<int> exit_code;
  bool is_past_preparation = false;  ///< its specimen is made, or it ended
  double progress = -1.0;            ///< of the stage, 0 to 1; below 0 when unknown
  double displacement = 0.0;         ///< m
  double shear_stress = 0.0;         ///< Pa
  double void_ratio = 0.0;
  double inertial_number = 0.0;
  double steps_per_second = 0.0;
  std::string time;  ///< UTC, of the last sign of life
  std::string host;
  std::optional<double> seconds_left;  ///< of a running test, from its own forecast
  double rest = 0.0;       ///< s, until it is done: its own forecast, else the share that is left of the plan's
  std::string scheduler;   ///< what the scheduler of a cluster says of it; may be empty
  std::string state_hash;  ///< of a test that is done
};

/// How long, in s, a process that cannot be seen from here may be silent before it counts as lost.
inline constexpr double k_longest_silence = 900.0;

TestStatus status_of(const CampaignFolder& folder, const RecordedTest& test);
std::vector<TestStatus> status_of_all(const CampaignFolder& folder, const CampaignRecord& record);

/// True when a call need not run the test: it is done, or it failed in its physics and would fail again (unless such tests
/// are to be tried again).
bool is_settled(const TestStatus& test, bool retries_physics);

struct StateCounts {
  int waiting = 0, running = 0, stopped = 0, lost = 0, failed = 0, done = 0;

  [[nodiscard]] int all() const { return waiting + running + stopped + lost + failed + done; }
};
StateCounts count_states(const std::vector<TestStatus>& tests);

/// One object with units in its names.
JsonObject status_as_json(const CampaignRecord& record, const std::vector<TestStatus>& tests);

}  // namespace dem
