// SPDX-License-Identifier: BSD-3-Clause
// A campaign on a cluster: what is left of it is written as batch scripts and handed to Slurm; what Slurm says is joined
// with what the folders say.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/campaign/campaign_folder.hpp"
#include "dem4grm/campaign/slurm_client.hpp"
#include "dem4grm/campaign/test_state.hpp"

namespace dem {

struct SlurmSettings {
  std::filesystem::path program;  ///< dem4grm, as the nodes see it
  SlurmOptions options;
  bool retries_physics = false;
  bool is_dry_run = false;  ///< the scripts are written, nothing is submitted
};

struct SlurmSubmission {
  std::vector<SlurmArray> arrays;
  std::vector<SlurmJob> jobs;  ///< those of this call; none in a dry run
  int submitted = 0;           ///< tests
  int in_queue = 0;            ///< tests that an earlier call has submitted and Slurm still knows
  int settled = 0;             ///< tests that are done, or would fail again
};

/// Writes the scripts for all tests that are neither settled nor in the queue already, and submits them. The folder must
/// have been written and locked. Throws IoError with the words of Slurm.
SlurmSubmission run_on_slurm(const CampaignFolder& folder, const CampaignPlan& plan, const CampaignRecord& record,
                             const SlurmSettings& settings);

/// Of each test, by its name, what Slurm says of the newest of its jobs that it still knows. Empty when nothing of the campaign
/// was ever submitted. Throws IoError when Slurm does not answer.
std::map<std::string, SlurmElement> slurm_states(const CampaignFolder& folder);

/// Puts the words of Slurm beside what the folders say: a waiting test may be queued, a lost one requeued.
void join_states(std::vector<TestStatus>& tests, const std::map<std::string, SlurmElement>& slurm);

}  // namespace dem
