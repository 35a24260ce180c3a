// SPDX-License-Identifier: BSD-3-Clause
// Shows on stderr how a campaign goes on: one line for each running test and one for all, written over on a terminal.
#pragma once

#include <chrono>

#include "dem4grm/campaign/local_campaign.hpp"

namespace dem {

class CampaignProgress : public CampaignListener {
 public:
  explicit CampaignProgress(bool is_quiet);

  void started(const std::string& test, bool goes_on) override;
  void ended(const TestStatus& test) override;
  void progress(const std::vector<TestStatus>& running, const StateCounts& all, double seconds_left) override;

 private:
  void clear();

  bool is_quiet_, is_terminal_;
  int open_lines_ = 0;  ///< on a terminal, to be written over
  std::chrono::steady_clock::time_point shown_at_{};
};

}  // namespace dem
