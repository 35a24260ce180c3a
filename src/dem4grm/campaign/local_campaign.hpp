// SPDX-License-Identifier: BSD-3-Clause
// A campaign on one machine: some tests at a time, each a process of its own, until all are done.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/campaign_folder.hpp"
#include "dem4grm/campaign/test_state.hpp"
#include "dem4grm/runs/throughput.hpp"

namespace dem {

/// Hears how a campaign goes on. Called from one thread.
class CampaignListener {
 public:
  virtual ~CampaignListener() = default;
  virtual void started(const std::string& /*test*/, bool /*goes_on*/) {}
  virtual void ended(const TestStatus& /*test*/) {}
  /// About once a second: the tests that run now, and s until all are done.
  virtual void progress(const std::vector<TestStatus>& /*running*/, const StateCounts& /*all*/,
                        double /*seconds_left*/) {}
};

struct LocalSettings {
  std::filesystem::path program;  ///< dem4grm
  Crew crew;
  bool leaves_threads_free = false;  ///< one test at a time chooses its threads itself
  double memory = 0.0;               ///< bytes that all tests may take together; 0: no limit
  bool retries_physics = false;      ///< also tests that failed in their physics, as they would again
  const volatile std::sig_atomic_t* stop_flag = nullptr;
  volatile std::sig_atomic_t* save_flag =
      nullptr;  ///< not zero: every running test is asked for a checkpoint; set back
  CampaignListener* listener = nullptr;
};

struct LocalOutcome {
  std::vector<TestStatus> tests;  ///< all, as they stand at the end
  bool was_stopped = false;
};

/// Runs all tests of the plan that are not done: those that make a preparation for others first, then the longest. A test
/// that fails is remembered and the others go on. The folder must have been written (write_campaign) and locked.
LocalOutcome run_locally(const CampaignFolder& folder, const CampaignPlan& plan, const CampaignRecord& record,
                         const LocalSettings& settings);

}  // namespace dem
