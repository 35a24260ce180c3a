// SPDX-License-Identifier: BSD-3-Clause
// Talks to Slurm through its own programs: sbatch, squeue, scontrol.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dem4grm/campaign/slurm_scripts.hpp"

namespace dem {

/// What Slurm says of an element of a job array.
struct SlurmElement {
  std::string job;     ///< "1234_5"
  std::string state;   ///< "PENDING", "RUNNING", ...
  std::string reason;  ///< why it is pending: "Dependency", "Resources", ...
};

/// An array that was submitted.
struct SlurmJob {
  std::string id;
  std::string file;
  std::vector<std::string> names;
  bool prepares = false;
};

/// The largest index that an array of this cluster may have. Throws IoError when Slurm does not answer.
int largest_array_index();

/// Submits the scripts of a folder in their order, each after what it needs. Throws IoError with the words of Slurm; `jobs`
/// then holds those that were submitted before.
void submit(const std::vector<SlurmArray>& arrays, const std::filesystem::path& folder, std::vector<SlurmJob>& jobs);

/// The elements of these jobs that Slurm still knows, by "JOB_INDEX"; ended ones are not among them. Throws IoError when
/// Slurm does not answer.
std::map<std::string, SlurmElement> ask_queue(const std::vector<SlurmJob>& jobs);

/// jobs.json of a campaign: what was submitted, oldest first. Empty when nothing was.
std::vector<SlurmJob> read_jobs(const std::filesystem::path& path);
void write_jobs(const std::filesystem::path& path, const std::vector<SlurmJob>& jobs);

}  // namespace dem
