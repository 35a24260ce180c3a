// SPDX-License-Identifier: BSD-3-Clause
// What a study will take on this machine, and which of its tests share a preparation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/study.hpp"
#include "dem4grm/results/json_text.hpp"
#include "dem4grm/runs/throughput.hpp"

namespace dem {

/// How a campaign uses the machine; 0 leaves the choice to a measurement.
struct CrewWish {
  int workers = 0;
  int threads = 0;
};

/// Forecast of a test on one of the workers.
struct PlannedTest {
  std::string name;
  std::string group;                            ///< of tests that share a preparation; empty: shares nothing
  bool leads = false;                           ///< makes the preparation of its group
  double preparation_time = 0.0;                ///< s; of those that do not lead only what they add
  double test_time = 0.0;                       ///< s
  double memory = 0.0;                          ///< bytes
  double results_size = 0.0, store_size = 0.0;  ///< bytes
  std::int64_t steps = 0;
  int clumps = 0, rubber_grains = 0;
  double inertial_number = 0.0;

  [[nodiscard]] double time() const { return preparation_time + test_time; }
};

struct CampaignPlan {
  std::vector<PlannedTest> tests;  ///< in the order of the study
  Crew crew;
  double processor_time = 0.0;  ///< s, of all tests one after the other on one worker
  double time = 0.0;            ///< s, until the last is done
  double memory = 0.0;          ///< bytes, of the largest tests that run beside each other
  double disk = 0.0;            ///< bytes, when all is done
};

/// Seconds that all trials of a plan may take together.
inline constexpr double k_plan_trial = 3.0;

/// Tries the grains of the study on this machine for about so many seconds; tests with the same grains share a trial, and
/// where there are many grains the others follow from the nearest in number. `memory`: bytes that all workers may take
/// together; 0: what the machine has free.
CampaignPlan plan_campaign(const Study& study, const CrewWish& wish = {}, double memory = 0.0,
                           double trial = k_plan_trial);

/// Seconds until the last test is done when each worker takes the longest test that may begin; a test may begin when the
/// one that leads its group has its specimen.
double makespan(const std::vector<PlannedTest>& tests, int workers);

/// Bytes of memory that are free for use on this machine; 0 when it does not say.
double free_memory();

/// The plan with units in its names.
JsonObject plan_as_json(const Study& study, const CampaignPlan& plan);

}  // namespace dem
