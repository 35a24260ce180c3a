// SPDX-License-Identifier: BSD-3-Clause
// Batch scripts and the talk with Slurm's programs, which are small scripts here; the real ones are in tests/cluster.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "dem4grm/campaign/command_output.hpp"
#include "dem4grm/campaign/slurm_campaign.hpp"
#include "dem4grm/core/error.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

SlurmTask task(const std::string& name, double time, const std::string& group = {}) {
  return {name, group, 0.25 * time, time, 100e6};
}

std::vector<SlurmArray> arrays_of(const std::vector<SlurmTask>& tasks, const SlurmOptions& options = {}) {
  return slurm_arrays(tasks, options, {"/opt/dem4grm", "/home/me/runs/study", "study"});
}

bool says(const SlurmArray& array, const std::string& line) {
  return array.text.find(line + "\n") != std::string::npos;
}

TEST(SlurmScripts, TimesAreInWholeMinutesRoundedUp) {
  EXPECT_EQ(slurm_time(60.0), "00:01:00");
  EXPECT_EQ(slurm_time(61.0), "00:02:00");
  EXPECT_EQ(slurm_time(2.5 * 3600.0), "02:30:00");
  EXPECT_EQ(slurm_time(30.0 * 3600.0), "1-06:00:00");
}

TEST(SlurmScripts, TestsWithoutAGroupAreChunkedLongestFirst) {
  std::vector<SlurmTask> tasks;
  for (int k = 0; k < 25; ++k) tasks.push_back(task(fmt::format("t{}", k), 1000.0 * k));
  SlurmOptions options;
  options.largest_index = 9;
  const std::vector<SlurmArray> arrays = arrays_of(tasks, options);
  ASSERT_EQ(arrays.size(), 3U);
  EXPECT_EQ(arrays[0].names.size(), 10U);
  EXPECT_EQ(arrays[2].names.size(), 5U);
  EXPECT_EQ(arrays[0].names.front(), "t24");
  EXPECT_EQ(arrays[2].names.back(), "t0");
  EXPECT_TRUE(says(arrays[0], "#SBATCH --array=0-9"));
  EXPECT_TRUE(says(arrays[0], "#SBATCH --time=10:00:00"))
      << "one and a half times the longest in it: " << arrays[0].text;
  EXPECT_TRUE(says(arrays[2], "#SBATCH --time=01:40:00"));
  for (const SlurmArray& array : arrays) EXPECT_EQ(array.after_array, -1);
}

TEST(SlurmScripts, AGroupWaitsForItsPreparation) {
  const std::vector<SlurmArray> arrays = arrays_of({task("a30", 100, "a100"), task("a100", 200, "a100"),
                                                    task("b30", 100, "b100"), task("b100", 200, "b100"), task("c", 1)});
  ASSERT_EQ(arrays.size(), 4U);
  EXPECT_TRUE(arrays[0].prepares);
  EXPECT_EQ(arrays[0].names, (std::vector<std::string>{"a100", "b100"}));
  EXPECT_NE(arrays[0].text.find("\"${names[$SLURM_ARRAY_TASK_ID]}\" specimen\n"), std::string::npos);
  EXPECT_EQ(arrays[2].names, (std::vector<std::string>{"b100", "b30"}));
  EXPECT_EQ(arrays[2].after_array, 0);
  EXPECT_EQ(arrays[2].after_index, 1);
  EXPECT_EQ(arrays[3].names, (std::vector<std::string>{"c"}));
  EXPECT_EQ(arrays[3].after_array, -1);
}

TEST(SlurmScripts, WhatIsLeftOfAGroupSharesNothingAnyMore) {
  const std::vector<SlurmArray> one_left = arrays_of({task("a30", 100, "a100")});
  ASSERT_EQ(one_left.size(), 1U);
  EXPECT_FALSE(one_left[0].prepares);
  const std::vector<SlurmArray> leader_done = arrays_of({task("a30", 100, "a100"), task("a60", 100, "a100")});
  ASSERT_EQ(leader_done.size(), 1U);
  EXPECT_EQ(leader_done[0].names.size(), 2U);
}

TEST(SlurmScripts, ManyGroupsWaitForAllPreparationsTogether) {
  std::vector<SlurmTask> tasks;
  for (int k = 0; k < 80; ++k) {
    tasks.push_back(task(fmt::format("{}-30", k), 100, fmt::format("{}-100", k)));
    tasks.push_back(task(fmt::format("{}-100", k), 100, fmt::format("{}-100", k)));
  }
  const std::vector<SlurmArray> arrays = arrays_of(tasks);
  ASSERT_EQ(arrays.size(), 2U);
  EXPECT_EQ(arrays[0].names.size(), 80U);
  EXPECT_EQ(arrays[1].names.size(), 160U);
  EXPECT_EQ(arrays[1].after_array, 0);
  EXPECT_EQ(arrays[1].after_index, -1);
}

TEST(SlurmScripts, OptionsOfTheUserStandInTheScript) {
  SlurmOptions options;
  options.partition = "long";
  options.account = "soil";
  options.time = "3-00:00:00";
  options.threads = 8;
  options.array_limit = 5;
  options.extra = {"--constraint=avx512", "--mail-type=END"};
  const SlurmArray array = arrays_of({task("a", 100)}, options).front();
  for (const char* line : {"#SBATCH --partition=long", "#SBATCH --account=soil", "#SBATCH --time=3-00:00:00",
                           "#SBATCH --cpus-per-task=8", "#SBATCH --array=0-0%5", "#SBATCH --constraint=avx512",
                           "#SBATCH --mail-type=END", "#SBATCH --requeue", "#SBATCH --mem=278M"}) {
    EXPECT_TRUE(says(array, line)) << line << "\n" << array.text;
  }
}

TEST(SlurmScripts, AreSoundShell) {
  const test::TemporaryFolder folder;
  test::write_all(folder / "run_test.sh", slurm_test_script({"/opt/dem4grm", "/home/me/it's a \"study\"", "study"}));
  test::write_all(folder / "tests.sh", arrays_of({task("a", 100)}).front().text);
  for (const char* name : {"run_test.sh", "tests.sh"}) {
    const CommandOutput checked = output_of({"bash", "-n", (folder / name).string()});
    EXPECT_EQ(checked.exit_code, 0) << checked.err;
  }
}

TEST(SlurmScripts, PathsArriveAsTheyAre) {
  const std::string odd = "/home/me/it's a $HOME \"study\"";
  EXPECT_EQ(output_of({"bash", "-c", "printf %s " + shell_quoted(odd)}).out, odd);
}

TEST(CommandOutput, BothStreamsCodeAndSignals) {
  const CommandOutput result = output_of({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.out, "out\n");
  EXPECT_EQ(result.err, "err\n");
  EXPECT_EQ(output_of({"sh", "-c", "kill -9 $$"}).exit_code, 137);
  EXPECT_EQ(output_of({"sh", "-c", "head -c 300000 /dev/zero; head -c 300000 /dev/zero >&2"}).err.size(), 300000U)
      << "more than a pipe holds, on both at once";
  EXPECT_THROW(output_of({"/no/such/program"}), IoError);
}

/// Slurm's programs as scripts that remember what they were told.
class FakeSlurm : public ::testing::Test {
 protected:
  FakeSlurm() {
    program("scontrol", "echo 'MaxArraySize            = 1001'");
    program("sbatch",
            "n=$(cat \"$0.n\" 2>/dev/null || echo 100); echo $((n + 1)) >\"$0.n\"; echo \"$@\" >>\"$0.log\"; echo "
            "\"$n;cluster\"");
    program("squeue", "cat \"$0.answer\" 2>/dev/null || true");
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
    std::filesystem::create_directories(folder_ / "out/slurm");
  }
  ~FakeSlurm() override { ::setenv("PATH", path_.c_str(), 1); }

  void program(const std::string& name, const std::string& body) const {
    test::write_all(folder_ / name, "#!/bin/sh\n" + body + "\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::string told(const std::string& name) const { return test::read_all(folder_ / (name + ".log")); }

  std::string path_ = std::getenv("PATH");
  test::TemporaryFolder folder_;
};

TEST_F(FakeSlurm, LargestIndexIsOneLessThanTheSize) {
  EXPECT_EQ(largest_array_index(), 1000);
  program("scontrol", "echo nothing");
  EXPECT_THROW(largest_array_index(), IoError);
}

TEST_F(FakeSlurm, ArraysAreSubmittedInOrderWithTheirDependencies) {
  std::vector<SlurmJob> jobs{{"99", "older.sh", {"x"}, false}};
  submit(arrays_of({task("a30", 100, "a100"), task("a100", 200, "a100"), task("c", 1)}), folder_ / "scripts", jobs);
  ASSERT_EQ(jobs.size(), 4U);
  EXPECT_EQ(jobs[1].id, "100") << "without the name of the cluster";
  EXPECT_EQ(told("sbatch"), fmt::format("--parsable {0}/preparations-001.sh\n--parsable --dependency=afterany:100_0 "
                                        "{0}/tests-001.sh\n--parsable {0}/tests-002.sh\n",
                                        (folder_ / "scripts").string()));
}

TEST_F(FakeSlurm, ARefusalIsToldInItsOwnWordsAndWhatWasSubmittedIsKnown) {
  program("sbatch",
          "[ -e \"$0.once\" ] && { echo 'sbatch: error: invalid partition' >&2; exit 1; }; touch \"$0.once\"; echo 7");
  std::vector<SlurmJob> jobs;
  try {
    submit(arrays_of({task("a30", 100, "a100"), task("a100", 200, "a100")}), folder_.path(), jobs);
    ADD_FAILURE() << "accepted";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("failed with code 1: sbatch: error: invalid partition"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(jobs.size(), 1U);
}

TEST_F(FakeSlurm, TheQueueIsAskedForTheJobsOfTheCampaignOnly) {
  test::write_all(folder_ / "squeue.answer", "100|0|RUNNING|None\n100|1|PENDING|Dependency\n55|0|RUNNING|None\n");
  const auto found = ask_queue({{"100", "tests-001.sh", {"a", "b"}, false}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found.at("100_0").state, "RUNNING");
  EXPECT_EQ(found.at("100_0").reason, "");
  EXPECT_EQ(found.at("100_1").reason, "Dependency");
}

TEST_F(FakeSlurm, JobsAreRememberedInTheFolder) {
  const std::filesystem::path file = folder_ / "jobs.json";
  EXPECT_TRUE(read_jobs(file).empty());
  write_jobs(file, {{"100", "preparations-001.sh", {"a"}, true}, {"101", "tests-001.sh", {"a", "b"}, false}});
  const std::vector<SlurmJob> jobs = read_jobs(file);
  ASSERT_EQ(jobs.size(), 2U);
  EXPECT_TRUE(jobs[0].prepares);
  EXPECT_EQ(jobs[1].names, (std::vector<std::string>{"a", "b"}));
  test::write_all(file, "{}");
  EXPECT_THROW(read_jobs(file), IoError);
}

TEST_F(FakeSlurm, StatesOfTestsJoinQueueAndFolders) {
  const CampaignFolder folder(folder_ / "out");
  write_jobs(folder.slurm() / "jobs.json", {{"100", "p.sh", {"a"}, true}, {"101", "t.sh", {"a", "b"}, false}});
  test::write_all(folder_ / "squeue.answer", "100|0|RUNNING|None\n101|0|PENDING|Dependency\n101|1|RUNNING|None\n");
  std::vector<TestStatus> tests(3);
  tests[0].name = "a";
  tests[0].state = TestState::stopped;  // its preparation, which was put back into the queue
  tests[1].name = "b";
  tests[1].state = TestState::running;
  tests[2].name = "c";
  tests[2].state = TestState::failed;
  join_states(tests, slurm_states(folder));
  EXPECT_NE(tests[0].scheduler, "");
  EXPECT_EQ(tests[1].scheduler, "job 101_1 RUNNING");
  EXPECT_EQ(tests[1].state, TestState::running);
  EXPECT_EQ(tests[2].scheduler, "");
  EXPECT_EQ(tests[2].state, TestState::failed);
}

}  // namespace
}  // namespace dem
