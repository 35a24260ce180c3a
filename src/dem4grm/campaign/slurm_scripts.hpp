// SPDX-License-Identifier: BSD-3-Clause
// Batch scripts for Slurm, readable and complete: a person may submit them by hand, or run them with bash under any other
// scheduler.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dem {

/// What the user of a cluster says of its jobs.
struct SlurmOptions {
  std::string partition, account;
  std::string time;                ///< limit of a job in the words of Slurm; empty: from the forecast
  std::vector<std::string> extra;  ///< further options of sbatch, one each; they win over all others
  int threads = 1;                 ///< of a test
  int array_limit = 0;             ///< elements of an array that may run at a time; 0: no limit
  int largest_index = 1000;        ///< of an array: MaxArraySize of the cluster less one
};

/// A test that is to be run.
struct SlurmTask {
  std::string name;
  std::string group;              ///< of tests that share a preparation: the name of the one that makes it; empty: none
  double preparation_time = 0.0;  ///< s, forecast on one worker
  double time = 0.0;              ///< s, of the whole test
  double memory = 0.0;            ///< bytes
};

/// A job array: one script and the names of its elements.
struct SlurmArray {
  std::string file;                ///< "tests-001.sh"
  std::string text;                ///< of the script
  std::vector<std::string> names;  ///< of the tests, by the index of their element
  bool prepares = false;           ///< makes preparations for others and is no test by itself
  int after_array = -1;            ///< array that must have ended before, by its place in the list; -1: none
  int after_index = -1;            ///< element of that array; -1: all of it
};

/// Where the scripts lie and what they run.
struct SlurmPlaces {
  std::filesystem::path program;  ///< dem4grm
  std::filesystem::path folder;   ///< of the campaign, absolute
  std::string study;              ///< its name
};

/// One array for the preparations that tests share, one for the tests of each such group (of many groups together: of all
/// groups), and the other tests, longest first, in arrays as large as the cluster allows.
std::vector<SlurmArray> slurm_arrays(const std::vector<SlurmTask>& tasks, const SlurmOptions& options,
                                     const SlurmPlaces& places);

/// run_test.sh: one test from its case to its end, however often the scheduler interrupts it.
std::string slurm_test_script(const SlurmPlaces& places);

/// In single quotes, safe from the shell whatever it holds.
std::string shell_quoted(const std::string& text);

/// "02:30:00", "1-06:00:00": whole minutes, rounded up.
std::string slurm_time(double seconds);

}  // namespace dem
