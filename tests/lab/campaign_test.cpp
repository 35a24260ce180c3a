// SPDX-License-Identifier: BSD-3-Clause
// Campaigns on one machine, run as a user runs them: the same bits as single runs, nothing computed twice, nothing lost
// by a stop, a kill, a second process, an edited case or a removed folder.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "dem4grm/runs/folder_lock.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;
using test::RunningProgram;
using test::write_all;

class Campaign : public CommandLine {
 protected:
  /// Four tests of about a second; each stress pair shares its fill.
  void write_study(const std::string& set = {}) const {
    write_all(folder_ / "study.toml", fmt::format("base = \"tiny.toml\"\n[set]\n{}\n[axes]\nrubber_content = [0, 0.2]\n"
                                                  "normal_stress = [\"60 kPa\", \"100 kPa\"]\n",
                                                  set));
  }
  [[nodiscard]] std::vector<std::string> command(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"campaign", "run", "study.toml", "-o", "out"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// State hash of every test that is done, by its name.
  [[nodiscard]] std::map<std::string, std::string> hashes() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/tests")) {
      const std::filesystem::path summary = entry.path() / "summary.json";
      if (std::filesystem::exists(summary)) {
        found[entry.path().filename().string()] = text_in(read_json_file(summary), "state_hash");
      }
    }
    return found;
  }
  [[nodiscard]] JsonObject status() const {
    return parse_json(run({"campaign", "status", "out", "--json"}).out, "status");
  }
  [[nodiscard]] static std::map<std::string, std::string> states(const JsonObject& status) {
    std::map<std::string, std::string> found;
    for (const JsonValue& item : std::get<JsonList>(find_field(status, "state_of_tests")->data)) {
      const auto& test = std::get<JsonObject>(item.data);
      found[text_in(test, "name")] = text_in(test, "state");
    }
    return found;
  }
};

TEST_F(Campaign, EndsWithTheHashesOfSingleRunsAndASecondCallDoesNothing) {
  write_study();
  const ProgramResult first = run(command({"-w", "2", "-j", "1"}));
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.out.find("4 of 4 done"), std::string::npos) << first.out;
  const auto found = hashes();
  ASSERT_EQ(found.size(), 4U);
  for (const auto& [name, hash] : found) {
    const ProgramResult single =
        run({"run", "tiny.toml", "-o", "single/" + name, "-q", "--set",
             name.starts_with("vrc000") ? "specimen.rubber_content=0" : "specimen.rubber_content=0.2", "--set",
             name.ends_with("060kPa") ? "shear.normal_stress=60kPa" : "shear.normal_stress=100kPa"});
    ASSERT_EQ(single.exit_code, 0) << single.err;
    EXPECT_EQ(text_in(json("single/" + name + "/summary.json"), "state_hash"), hash) << name;
    EXPECT_EQ(read_all(folder_ / ("single/" + name + "/shear.csv")),
              read_all(folder_ / ("out/tests/" + name + "/shear.csv")));
  }
  const auto written = std::filesystem::last_write_time(folder_ / "out/tests/vrc020-060kPa/summary.json");
  const ProgramResult second = run(command());
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.err.find("begins"), std::string::npos) << second.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/tests/vrc020-060kPa/summary.json"), written);
}

TEST_F(Campaign, PreparationsThatTestsShareAreMadeOnce) {
  write_study();
  ASSERT_EQ(run(command({"-w", "2", "-j", "1"})).exit_code, 0);
  int fills = 0, tests_with_fill_stage = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "out/store")) {
    fills += entry.path().filename() == "fill.h5" ? 1 : 0;
  }
  for (const auto& [name, hash] : hashes()) {
    tests_with_fill_stage +=
        read_all(folder_ / ("out/tests/" + name + "/run.log")).find("stage fill") != std::string::npos;
  }
  EXPECT_EQ(fills, 2) << "one for each mixture";
  EXPECT_EQ(tests_with_fill_stage, 2);
}

TEST_F(Campaign, AStopSavesAllAndTheSameCommandGoesOn) {
  write_study("shear.velocity = \"20 mm/s\"\n");
  RunningProgram campaign(words(command({"-w", "2", "-j", "1"})), folder_.path());
  // In the middle: two in shear.
  const auto count_shearing = [&] {
    int n = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out/tests")) {
      const std::string rows = read_all(entry.path() / "shear.csv");
      n += std::count(rows.begin(), rows.end(), '\n') > 3 ? 1 : 0;
    }
    return n;
  };
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/tests", 20.0));
  for (int k = 0; k < 3000 && count_shearing() < 2; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  campaign.send(SIGINT);
  const ProgramResult stopped = campaign.wait();
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("the same command goes on: dem4grm campaign run study.toml -o out"), std::string::npos);
  const JsonObject now = status();
  EXPECT_EQ(number_in(now, "running"), 0.0);
  EXPECT_GE(number_in(now, "stopped"), 1.0);
  EXPECT_LT(number_in(now, "done"), 4.0);
  ASSERT_EQ(run(command({"-w", "1", "-j", "2"})).exit_code, 0);
  const auto found = hashes();
  ASSERT_EQ(found.size(), 4U);
  for (const std::string name : {"vrc020-100kPa", "vrc000-060kPa"}) {
    const ProgramResult single = run({"run", "out/cases/" + name + ".toml", "-o", "single/" + name, "-q"});
    ASSERT_EQ(single.exit_code, 0) << single.err;
    EXPECT_EQ(text_in(json("single/" + name + "/summary.json"), "state_hash"), found.at(name));
  }
}

TEST_F(Campaign, AKilledCampaignStopsItsTestsAndAKilledTestIsNamed) {
  write_study("shear.velocity = \"2 mm/s\"\n");
  {
    RunningProgram campaign(words(command({"-w", "2", "-j", "1"})), folder_.path());
    for (const std::string name : {"vrc000-100kPa", "vrc020-100kPa"}) {
      ASSERT_TRUE(test::wait_for_file(folder_ / ("out/tests/" + name + "/results.h5"), 30.0));
    }
    campaign.send(SIGKILL);
    EXPECT_EQ(campaign.wait().signal, SIGKILL);
  }
  // The tests notice that nobody waits for them any more.
  const auto lock_of = [&](const std::string& name) { return folder_ / ("out/tests/" + name + "/run.lock"); };
  for (const std::string name : {"vrc000-100kPa", "vrc020-100kPa"}) {
    for (int k = 0; k < 3000 && std::filesystem::exists(lock_of(name)); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_EQ(text_in(json("out/tests/" + name + "/status.json"), "state"), "stopped");
  }

  // The longest begins first.
  RunningProgram again(words(command({"-w", "1", "-j", "1"})), folder_.path());
  // Killed before its first word it would leave the last word of the run before.
  const std::filesystem::path status_file = folder_ / "out/tests/vrc020-100kPa/status.json";
  for (int k = 0; k < 3000 && read_all(status_file).find("\"stopped\"") != std::string::npos; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string lock = read_all(lock_of("vrc020-100kPa"));
  const std::size_t at = lock.find("pid=");
  ASSERT_NE(at, std::string::npos) << lock;
  ::kill(static_cast<pid_t>(std::stol(lock.substr(at + 4))), SIGKILL);
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/tests/vrc000-100kPa/run.lock", 30.0)) << "the others go on";
  again.send(SIGTERM);
  const ProgramResult ended = again.wait();
  EXPECT_NE(ended.err.find("vrc020-100kPa was lost: its process was ended by signal 9"), std::string::npos)
      << ended.err;
  EXPECT_EQ(states(status()).at("vrc020-100kPa"), "lost");
}

TEST_F(Campaign, ATestThatFailsIsReportedAndTheOthersGoOn) {
  // So few steps to rest that rubber fails and gravel does not.
  write_all(folder_ / "study.toml",
            "base = \"tiny.toml\"\n[axes]\nseed = [1]\n[[tests]]\nequilibrium.most_steps = 201\n");
  const ProgramResult result = run(command({"-w", "1"}));
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("most_steps-201 failed"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("1 of 2 tests are not done"), std::string::npos) << result.err;
  EXPECT_EQ(hashes().size(), 1U);
  const ProgramResult again = run(command());
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_EQ(again.err.find("begins"), std::string::npos) << "its physics would fail again: " << again.err;
  EXPECT_NE(run(command({"--retry"})).err.find("most_steps-201 begins"), std::string::npos);
}

TEST_F(Campaign, TwoAtOnceInOneFolderAreRefused) {
  write_study("shear.velocity = \"1 mm/s\"\n");
  RunningProgram first(words(command({"-w", "1", "-j", "1"})), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/run.lock", 30.0));
  const ProgramResult second = run(command());
  EXPECT_EQ(second.exit_code, 73) << second.err;
  EXPECT_NE(second.err.find(fmt::format("process {} on host {}", first.process(), host_name())), std::string::npos)
      << second.err;
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/campaign.json", 30.0));
  EXPECT_EQ(run({"campaign", "status", "out"}).exit_code, 0) << "status needs no lock";
  first.send(SIGTERM);
  EXPECT_EQ(first.wait().exit_code, 75);
}

TEST_F(Campaign, ATestThatAnotherProcessWorksOnIsLeftToIt) {
  write_study("shear.velocity = \"1 mm/s\"\n");
  ASSERT_EQ(run({"campaign", "plan", "study.toml"}).exit_code, 0);
  RunningProgram campaign(words(command({"-w", "1", "-j", "1"})), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/tests/vrc020-100kPa/status.json", 30.0));
  campaign.send(SIGTERM);
  ASSERT_EQ(campaign.wait().exit_code, 75);
  RunningProgram single(
      words({"run", "out/cases/vrc020-100kPa.toml", "-o", "out/tests/vrc020-100kPa", "--store", "out/store", "-q"}),
      folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/tests/vrc020-100kPa/run.lock", 30.0));
  RunningProgram again(words(command({"-w", "1", "-j", "1"})), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/tests/vrc000-100kPa/run.lock", 30.0));
  again.send(SIGTERM);
  const ProgramResult ended = again.wait();
  EXPECT_NE(ended.err.find("vrc020-100kPa is left to another process"), std::string::npos) << ended.err;
  single.send(SIGTERM);
  EXPECT_EQ(single.wait().exit_code, 75);
}

TEST_F(Campaign, AnEditedCaseIsRefusedARemovedFolderIsMadeAgain) {
  write_study();
  ASSERT_EQ(run(command({"-w", "2", "-j", "1"})).exit_code, 0);
  const auto before = hashes();
  write_study("shear.displacement = \"0.6 mm\"\n");
  const ProgramResult edited = run(command());
  EXPECT_EQ(edited.exit_code, 64) << edited.err;
  EXPECT_NE(edited.err.find("4 test(s) of the study were begun here with other values"), std::string::npos)
      << edited.err;
  EXPECT_NE(edited.err.find("the case has  shear.displacement = \"0.6 mm\""), std::string::npos) << edited.err;
  EXPECT_EQ(hashes(), before);

  write_study();
  std::filesystem::remove_all(folder_ / "out/tests/vrc020-060kPa");
  EXPECT_EQ(states(status()).at("vrc020-060kPa"), "waiting");
  const ProgramResult again = run(command());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("vrc020-060kPa begins"), std::string::npos) << again.err;
  EXPECT_EQ(again.err.find("vrc020-100kPa begins"), std::string::npos) << again.err;
  EXPECT_EQ(hashes(), before);
}

TEST_F(Campaign, ATypingErrorInAnAxisStartsNothing) {
  write_all(folder_ / "study.toml", "base = \"tiny.toml\"\n[axes]\nnormal_stres = [\"60 kPa\"]\n");
  expect(65, "study.toml:3:1: error: unknown key \"normal_stres\"; did you mean \"normal_stress\"?", command());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  expect(66, "no such file", {"campaign", "plan", "none.toml"});
  expect(66, "is no folder of a campaign", {"campaign", "status", "."});
}

TEST_F(Campaign, AThousandTestsHaveAThousandNames) {
  write_all(folder_ / "study.toml", "base = \"tiny.toml\"\n[axes]\nseed = { from = 1, to = 1000, step = 1 }\n");
  const ProgramResult planned = run({"campaign", "plan", "study.toml", "--json"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  const JsonObject plan = parse_json(planned.out, "plan");
  std::set<std::string> names;
  for (const JsonValue& item : std::get<JsonList>(find_field(plan, "tests")->data)) {
    names.insert(text_in(std::get<JsonObject>(item.data), "name"));
  }
  EXPECT_EQ(names.size(), 1000U);
  EXPECT_GT(number_in(plan, "forecast_time_s"), 10.0);
}

TEST_F(Campaign, AStudyOfGrainCompressionsRuns) {
  write_all(folder_ / "grain.toml", read_all(std::filesystem::path(DEM_SOURCE_DIR) / "cases/grain_compression.toml"));
  write_all(folder_ / "study.toml",
            "base = \"grain.toml\"\n[set]\ncompression.strain = 0.05\n[axes]\nrubber.bond.modulus = [\"15 MPa\", \"20 "
            "MPa\"]\n");
  const ProgramResult result = run(command({"-w", "2", "-j", "1"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(hashes().size(), 2U);
}

}  // namespace
}  // namespace dem
