// SPDX-License-Identifier: BSD-3-Clause
// The folder of a campaign: one complete case and one output folder for each test, and the record of the plan.
//
//     study.toml         the study as it was read
//     campaign.json      the plan: tests with their values, what shares a preparation, forecasts
//     cases/NAME.toml    the complete case of a test; `dem4grm run` takes it anywhere
//     tests/NAME/        the output folder of a test, as `dem4grm run` makes it
//     store/             preparations that tests share; may be removed
//     logs/NAME.log      what the program said of a test
//     slurm/             batch scripts and what they said
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/campaign_plan.hpp"

namespace dem {

class CampaignFolder {
 public:
  explicit CampaignFolder(std::filesystem::path root) : root_(std::move(root)) {}

  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  [[nodiscard]] std::filesystem::path study() const { return root_ / "study.toml"; }
  [[nodiscard]] std::filesystem::path record() const { return root_ / "campaign.json"; }
  [[nodiscard]] std::filesystem::path case_of(const std::string& test) const {
    return root_ / "cases" / (test + ".toml");
  }
  [[nodiscard]] std::filesystem::path test(const std::string& test) const { return root_ / "tests" / test; }
  [[nodiscard]] std::filesystem::path log(const std::string& test) const { return root_ / "logs" / (test + ".log"); }
  [[nodiscard]] std::filesystem::path store() const { return root_ / "store"; }
  [[nodiscard]] std::filesystem::path slurm() const { return root_ / "slurm"; }

 private:
  std::filesystem::path root_;
};

/// A test as campaign.json has it.
struct RecordedTest {
  std::string name;
  std::vector<StudyValue> values;
  std::string group;              ///< of tests that share a preparation; empty: shares nothing
  double preparation_time = 0.0;  ///< s, forecast
  double test_time = 0.0;         ///< s, forecast
  double memory = 0.0;            ///< bytes
};

struct CampaignRecord {
  std::string study;  ///< its name
  std::vector<RecordedTest> tests;
};

/// Makes the folder, or adds to it, and returns what there is to tell about it: a test that left the study, say. The caller
/// holds the lock. Throws Error with ExitCode::usage, before anything is written, when a test that was begun has another case
/// now: every such test is named with what differs. Throws IoError.
std::vector<std::string> write_campaign(const CampaignFolder& folder, const Study& study, const CampaignPlan& plan);

/// Throws MissingFileError when the folder is none of a campaign, IoError when its record is damaged.
CampaignRecord read_campaign(const CampaignFolder& folder);

}  // namespace dem
