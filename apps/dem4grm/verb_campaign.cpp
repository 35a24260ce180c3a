// SPDX-License-Identifier: BSD-3-Clause
// dem4grm campaign: all tests of a study, planned, run, watched and collected.
#include <memory>

#include "campaign_verbs.hpp"
#include "verbs.hpp"

namespace dem {
namespace {

constexpr int k_most_workers = 1024;

void add_crew(CLI::App& verb, CampaignOptions& options) {
  verb.add_option("-w,--workers", options.crew.workers, "tests at a time; default: measured on this machine")
      ->type_name("N")
      ->check(CLI::Range(1, k_most_workers));
  verb.add_option("-j,--threads", options.crew.threads, "threads of each; any number gives the same results")
      ->type_name("N")
      ->check(CLI::Range(1, k_most_workers));
  verb.add_option("--memory", options.memory_gigabytes, "GB that all tests may take together; default: what is free")
      ->type_name("GB")
      ->check(CLI::PositiveNumber);
}

void add_slurm(CLI::App& verb, CampaignOptions& options) {
  CLI::Option* on = verb.add_option("--on", options.scheduler, "hand the tests to a scheduler: slurm")
                        ->type_name("SCHEDULER")
                        ->check(CLI::IsMember({"slurm"}));
  verb.add_option("--partition", options.slurm.partition, "partition of the jobs")->type_name("NAME")->needs(on);
  verb.add_option("--account", options.slurm.account, "account of the jobs")->type_name("NAME")->needs(on);
  verb.add_option("--time", options.slurm.time, "time limit of a job in the words of Slurm; default: by the forecast")
      ->type_name("TIME")
      ->needs(on);
  verb.add_option("--array-limit", options.slurm.array_limit, "elements of an array that may run at a time")
      ->type_name("N")
      ->check(CLI::PositiveNumber)
      ->needs(on);
  verb.add_option("--extra", options.slurm.extra,
                  "further option of sbatch, as --extra=--constraint=avx512; may be repeated")
      ->type_name("OPTION")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->delimiter('\0')
      ->needs(on);
  verb.add_flag("--dry-run", options.is_dry_run, "write and show the scripts, submit nothing")->needs(on);
}

void add_plan(CLI::App& campaign, const std::shared_ptr<CampaignOptions>& options) {
  CLI::App* verb = campaign.add_subcommand("plan", "lists the tests of a study and what they take; writes nothing");
  verb->add_option("STUDY", options->study, "study file")->required();
  add_crew(*verb, *options);
  verb->add_flag("--json", options->is_json, "one JSON object on stdout");
  verb->footer("Example:\n  dem4grm campaign plan cases/paper/campaign.toml");
  verb->callback([options] { plan_study(*options); });
}

void add_run_verb(CLI::App& campaign, const std::shared_ptr<CampaignOptions>& options) {
  CLI::App* verb = campaign.add_subcommand("run", "runs all tests of a study that are not done");
  verb->add_option("STUDY", options->study, "study file")->required();
  verb->add_option("-o,--output", options->folder, "folder of the campaign, default runs/<name of the study>")
      ->type_name("DIR")
      ->check(not_empty());
  add_crew(*verb, *options);
  add_most_hours(*verb, options->most_hours);
  verb->add_flag("--retry", options->retries, "also tests that failed in their physics");
  verb->add_flag("--no-report", options->has_no_report, "do not write report.html at the end");
  verb->add_flag("--json", options->is_json, "at the end the state of all tests as JSON on stdout");
  verb->add_flag("-q,--quiet", options->is_quiet, "no progress, no report; errors only");
  verb->footer("Example:\n  dem4grm campaign run cases/studies/quick.toml -o runs/quick-study");
  add_slurm(*verb, *options);
  verb->callback([options] { options->scheduler.empty() ? run_study_here(*options) : run_study_on_cluster(*options); });
}

void add_status(CLI::App& campaign, const std::shared_ptr<CampaignOptions>& options) {
  CLI::App* verb = campaign.add_subcommand("status", "where the tests stand, from their folders alone");
  verb->add_option("DIR", options->folder, "folder of the campaign")->required();
  verb->add_flag("--watch", options->is_watch, "again every 5 s until nothing is left to do");
  verb->add_flag("--json", options->is_json, "one JSON object on stdout");
  verb->footer("Example:\n  dem4grm campaign status runs/quick-study");
  verb->callback([options] { show_campaign_status(*options); });
}

void add_collect(CLI::App& campaign, const std::shared_ptr<CampaignOptions>& options) {
  CLI::App* verb = campaign.add_subcommand("collect", "gathers what is done: tables, envelopes, HDF5");
  verb->add_option("DIR", options->folder, "folder of the campaign")->required();
  verb->add_option("-o,--output", options->output, "folder for the files, default DIR/collected")->type_name("DIR");
  verb->footer("Example:\n  dem4grm campaign collect runs/quick-study");
  verb->callback([options] { collect_campaign(*options); });
}

}  // namespace

void add_campaign(CLI::App& app) {
  CLI::App* campaign = app.add_subcommand("campaign", "all tests of a study: plan, run, status, collect");
  campaign->require_subcommand(1);
  const auto options = std::make_shared<CampaignOptions>();
  add_plan(*campaign, options);
  add_run_verb(*campaign, options);
  add_status(*campaign, options);
  add_collect(*campaign, options);
  campaign->footer(
      "Example:\n"
      "  dem4grm campaign plan cases/studies/quick.toml\n"
      "  dem4grm campaign run cases/studies/quick.toml -o runs/quick-study");
}

}  // namespace dem
