// SPDX-License-Identifier: BSD-3-Clause
// How the folder of a test is judged, and what a folder of a campaign refuses.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fmt/format.h>

#include "dem4grm/campaign/test_state.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/runs/folder_lock.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

class FolderOfATest : public ::testing::Test {
 protected:
  FolderOfATest() { std::filesystem::create_directories(folder_ / "logs"); }

  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories(folder_ / "tests/a");
    test::write_all(folder_ / ("tests/a/" + name), text);
  }
  void write_status(const std::string& state, const std::string& more = {}, double age = 0.0) const {
    write("status.json",
          fmt::format("{{\"state\": \"{}\", \"stage\": \"shear\", \"displacement_mm\": 7, \"progress\": 0.5, "
                      "\"time\": \"{}\"{}}}",
                      state, utc_text(utc_now() - age), more));
  }
  void write_lock(const std::string& host, long pid) const {
    write("run.lock", fmt::format("host={}\npid={}\nstart=x\n", host, pid));
  }
  [[nodiscard]] TestStatus status() const {
    return status_of(CampaignFolder(folder_.path()), {"a", {}, {}, 100.0, 1000.0, 0.0});
  }
  test::TemporaryFolder folder_;
};

TEST_F(FolderOfATest, NothingIsWaiting) {
  EXPECT_EQ(status().state, TestState::waiting);
  EXPECT_EQ(status().rest, 1100.0);
}

TEST_F(FolderOfATest, ItsProductsSayThatItIsDone) {
  write("summary.json", "{\"state_hash\": \"0123\"}");
  EXPECT_EQ(status().state, TestState::waiting) << "without its results it is not done";
  write("results.h5", "x");
  EXPECT_EQ(status().state, TestState::done);
  EXPECT_EQ(status().state_hash, "0123");
  EXPECT_EQ(status().rest, 0.0);
  write("summary.json", "{\"state_hash\": ");
  EXPECT_NE(status().state, TestState::done) << "half a summary is none";
}

TEST_F(FolderOfATest, ALiveProcessIsRunningAndADeadOneIsLost) {
  write_status("running");
  write_lock(host_name(), ::getpid());
  EXPECT_EQ(status().state, TestState::running);
  EXPECT_TRUE(status().is_past_preparation);
  write_lock(host_name(), 4194305);  // beyond the largest process number
  EXPECT_EQ(status().state, TestState::lost);
  EXPECT_NE(status().cause.find("without a word"), std::string::npos);
  EXPECT_EQ(status().rest, 500.0) << "half of the shear is done";
}

TEST_F(FolderOfATest, LastWordsOfAProcessThatCouldNotWriteAreItsCause) {
  write_status("running");
  test::write_all(folder_ / "logs/a.log", "error: results.h5: No space left on device\n");
  EXPECT_EQ(status().state, TestState::failed);
  EXPECT_EQ(status().cause, "error: results.h5: No space left on device");
}

TEST_F(FolderOfATest, OfAnotherMachineTheLastSignOfLifeCounts) {
  write_lock("elsewhere", 1);
  write_status("running", {}, 60.0);
  EXPECT_EQ(status().state, TestState::running);
  write_status("running", {}, 2.0 * k_longest_silence);
  EXPECT_EQ(status().state, TestState::lost);
}

TEST_F(FolderOfATest, AFailureKeepsItsCauseAndCode) {
  write_status("failed", R"(, "cause": "no space left", "exit_code": 74)");
  EXPECT_EQ(status().state, TestState::failed);
  EXPECT_EQ(status().cause, "no space left");
  EXPECT_EQ(status().exit_code, 74);
  EXPECT_FALSE(is_settled(status(), false)) << "another try may find room";
  write_status("failed", R"(, "cause": "lost grain", "exit_code": 76)");
  EXPECT_TRUE(is_settled(status(), false)) << "the same physics fails again";
  EXPECT_FALSE(is_settled(status(), true));
}

TEST_F(FolderOfATest, StoppedAndReadySpecimensGoOn) {
  write_status("stopped");
  EXPECT_EQ(status().state, TestState::stopped);
  write_status("specimen ready");
  EXPECT_EQ(status().state, TestState::stopped);
  EXPECT_TRUE(status().is_past_preparation);
}

TEST_F(FolderOfATest, AMessageWithoutAFolderIsAFailure) {
  test::write_all(folder_ / "logs/a.log", "error: something\n");
  EXPECT_EQ(status().state, TestState::failed);
  EXPECT_EQ(status().cause, "error: something");
}

class FolderOfACampaign : public ::testing::Test {
 protected:
  FolderOfACampaign() { test::write_all(folder_ / "tiny.toml", test::k_tiny_case); }
  std::vector<std::string> write(const std::string& study_text) {
    test::write_all(folder_ / "study.toml", "base = \"tiny.toml\"\n" + study_text);
    const Study study = load_study(folder_ / "study.toml");
    return write_campaign(campaign_, study, plan_campaign(study, {1, 1}, 1e12, 0.0));
  }
  test::TemporaryFolder folder_;
  CampaignFolder campaign_{folder_ / "out"};
};

TEST_F(FolderOfACampaign, TheRecordReadsAsThePlan) {
  write("[axes]\nseed = [1, 2]\nvelocity = [\"quasi-static\"]\n");
  const CampaignRecord record = read_campaign(campaign_);
  ASSERT_EQ(record.tests.size(), 2U);
  EXPECT_EQ(record.tests[1].name, "seed2-velocity-quasi-static");
  EXPECT_EQ(record.tests[1].values[0].number, 2.0);
  EXPECT_EQ(record.tests[1].values[1].text, "\"quasi-static\"");
  EXPECT_EQ(record.tests[1].values[1].number, std::nullopt);
  EXPECT_EQ(load_case(campaign_.case_of("seed2-velocity-quasi-static")).resolved_toml,
            test::read_all(campaign_.case_of("seed2-velocity-quasi-static")));
}

TEST_F(FolderOfACampaign, AnotherCaseOfABegunTestIsRefusedWithWhatDiffers) {
  write("[axes]\nseed = [1, 2]\n");
  std::filesystem::create_directories(campaign_.test("seed1"));
  test::write_all(campaign_.test("seed1") / "resolved.toml", test::read_all(campaign_.case_of("seed1")));
  EXPECT_NO_THROW(write("[axes]\nseed = [1, 2, 3]\n"));
  const std::string before = test::read_all(campaign_.case_of("seed1"));
  try {
    write("[set]\ndisplacement = \"0.9 mm\"\n[axes]\nseed = [1, 2]\n");
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    const std::string said = error.what();
    EXPECT_NE(said.find("seed1:"), std::string::npos) << said;
    EXPECT_NE(said.find("the case has  shear.displacement = \"0.9 mm\""), std::string::npos) << said;
    EXPECT_EQ(said.find("seed2:"), std::string::npos) << "a test that was not begun may change";
  }
  EXPECT_EQ(test::read_all(campaign_.case_of("seed1")), before);
}

TEST_F(FolderOfACampaign, TestsThatLeftTheStudyAreMentioned) {
  write("[axes]\nseed = [1, 2]\n");
  const std::vector<std::string> notes = write("[axes]\nseed = [2]\n");
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].find("1 test(s) of an earlier call"), std::string::npos);
}

TEST_F(FolderOfACampaign, TheFolderOfASingleTestIsRefused) {
  std::filesystem::create_directories(folder_ / "out");
  test::write_all(folder_ / "out/resolved.toml", "x");
  EXPECT_THROW(write("[axes]\nseed = [1]\n"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/cases"));
}

TEST_F(FolderOfACampaign, OtherFoldersAndDamagedRecordsAreRefused) {
  EXPECT_THROW(read_campaign(CampaignFolder(folder_.path())), MissingFileError);
  write("[axes]\nseed = [1]\n");
  test::write_all(campaign_.record(), "{}");
  EXPECT_THROW(read_campaign(campaign_), IoError);
}

}  // namespace
}  // namespace dem
