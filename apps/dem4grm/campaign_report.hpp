// SPDX-License-Identifier: BSD-3-Clause
// Tables of a campaign for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem4grm/campaign/campaign_plan.hpp"
#include "dem4grm/campaign/test_state.hpp"

namespace dem {

/// The longest table that is shown; --json lists everything.
inline constexpr std::size_t k_most_rows_shown = 60;

std::string plan_text(const Study& study, const CampaignPlan& plan);

/// "12 done, 2 running, 4 waiting"
std::string counts_text(const StateCounts& counts);

/// Every test that is not simply waiting, and the sum.
std::string status_text(const CampaignRecord& record, const std::vector<TestStatus>& tests,
                        const std::filesystem::path& folder);

/// "vrc025-060kPa  shear 41.2 %  5.768 mm  tau 48.1 kPa  e 0.612  I 5.0e-05  12 min"
std::string running_text(const TestStatus& test, std::size_t width);

/// Local clock time so many seconds from now; with the day when it is far.
std::string finish_text(double seconds_ahead);

}  // namespace dem
