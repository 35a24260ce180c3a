// SPDX-License-Identifier: BSD-3-Clause
// What tests of a campaign have in common, as the page takes it (interface Campaign of web/src/data.ts).
#pragma once

#include "dem4grm/campaign/campaign_folder.hpp"
#include "dem4grm/campaign/collect.hpp"
#include "dem4grm/campaign/test_state.hpp"
#include "dem4grm/results/json_text.hpp"

namespace dem {

/// Tests with their values and states, and the strength envelope of each mixture with the points that it was fitted to. `tests`:
/// the states, in the order of the record.
JsonObject campaign_data(const CampaignRecord& record, const std::vector<TestStatus>& tests,
                         const Collection& collection);

}  // namespace dem
