// SPDX-License-Identifier: BSD-3-Clause
// What the verbs of dem4grm campaign do; verb_campaign.cpp has the words of the command line.
#pragma once

#include <string>

#include "dem4grm/campaign/campaign_plan.hpp"
#include "dem4grm/campaign/slurm_scripts.hpp"

namespace dem {

struct CampaignOptions {
  std::string study, folder, output;
  CrewWish crew;
  double memory_gigabytes = 0.0;
  double most_hours = 0.0;  ///< 0: no limit
  bool is_json = false, is_quiet = false, is_watch = false, retries = false, has_no_report = false;
  std::string scheduler;  ///< "slurm", or empty: this machine
  SlurmOptions slurm;
  bool is_dry_run = false;
};

/// Lists the tests of a study and what they take.
void plan_study(const CampaignOptions& options);
/// Runs what is left of a study on this machine. Throws Error with ExitCode::stopped after a stop on request, with
/// ExitCode::missed when tests failed.
void run_study_here(const CampaignOptions& options);
/// Hands what is left of a study to Slurm.
void run_study_on_cluster(const CampaignOptions& options);
void show_campaign_status(const CampaignOptions& options);
void collect_campaign(const CampaignOptions& options);

}  // namespace dem
