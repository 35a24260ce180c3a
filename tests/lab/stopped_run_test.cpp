// SPDX-License-Identifier: BSD-3-Clause
// Runs of the program that are stopped, killed or kept out: what they leave, and that the next one ends with the same
// results. Not tested here: every point of every stage (resume_test.cpp), a kill at a given moment
// (killed_run_test.cpp).
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/runs/folder_lock.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;
using test::RunningProgram;
using test::write_all;

/// A run that would take minutes, seen to be on its way.
class LongRun : public CommandLine {
 protected:
  [[nodiscard]] std::vector<std::string> long_run(const std::string& folder) const {
    return words({"run", "tiny.toml", "-o", folder, "-j", "1", "--set", "shear.velocity=1 mm/s"});
  }
  /// Waits until rows are written.
  [[nodiscard]] bool is_shearing(const std::string& folder) const {
    for (int k = 0; k < 3000; ++k) {
      const std::string rows = read_all(folder_ / (folder + "/shear.csv"));
      if (std::count(rows.begin(), rows.end(), '\n') > 3) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
};

TEST_F(LongRun, SecondProcessIsRefusedAndSignalsStopCleanly) {
  RunningProgram first(long_run("out"), folder_.path());
  ASSERT_TRUE(is_shearing("out"));
  const std::string holder = fmt::format("process {} on host {}", first.process(), host_name());
  const ProgramResult second = test::run_program(long_run("out"), folder_.path());
  EXPECT_EQ(second.exit_code, 73) << second.err;
  EXPECT_NE(second.err.find(holder), std::string::npos) << second.err;
  EXPECT_NE(run({"info", "out"}).out.find("in stage"), std::string::npos);

  first.send(SIGINT);
  const ProgramResult stopped = first.wait();
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("goes on from the checkpoint"), std::string::npos) << stopped.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint.h5"));
  EXPECT_EQ(text_in(json("out/status.json"), "state"), "stopped");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/run.lock"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/summary.json"));
  EXPECT_TRUE(read_all(folder_ / "out/shear.csv").ends_with('\n'));
  const ProgramResult info = run({"info", "out"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("stopped"), std::string::npos) << info.out;

  RunningProgram third(long_run("out"), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/run.lock", 10.0));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  third.send(SIGTERM);
  const ProgramResult further = third.wait();
  EXPECT_EQ(further.exit_code, 75) << further.err;
  EXPECT_NE(further.err.find("goes on from the checkpoint"), std::string::npos) << further.err;
}

TEST_F(LongRun, TwoSignalsAtOnceAreOneRequest) {
  RunningProgram job(long_run("out"), folder_.path());
  ASSERT_TRUE(is_shearing("out"));
  // As a scheduler does: to every process of the job, and once more from its script. Two kinds, since two equal signals that
  // wait may arrive as one.
  job.send(SIGTERM);
  job.send(SIGINT);
  EXPECT_EQ(job.wait().exit_code, 75);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint.h5"));
}

TEST_F(LongRun, AskedForACheckpointItSavesAndGoesOn) {
  RunningProgram job(long_run("out"), folder_.path());
  ASSERT_TRUE(is_shearing("out"));
  std::filesystem::remove(folder_ / "out/checkpoint.h5");
  job.send(SIGUSR1);
  EXPECT_TRUE(test::wait_for_file(folder_ / "out/checkpoint.h5", 20.0));
  const auto saved = std::filesystem::last_write_time(folder_ / "out/checkpoint.h5");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/checkpoint.h5"), saved) << "one request, one checkpoint";
  EXPECT_EQ(text_in(json("out/status.json"), "state"), "running");
  job.send(SIGHUP);
  const ProgramResult stopped = job.wait();
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_NE(stopped.err.find("goes on from the checkpoint"), std::string::npos) << stopped.err;
}

TEST_F(LongRun, LimitsOfTimeEndItWithACheckpoint) {
  std::vector<std::string> words = long_run("out");
  words.insert(words.end(), {"--max-hours", "0.0005"});
  const ProgramResult at_time = test::run_program(words, folder_.path());
  EXPECT_EQ(at_time.exit_code, 75) << at_time.err;
  EXPECT_NE(at_time.err.find("stopped after the hours that --max-hours allows"), std::string::npos) << at_time.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/checkpoint.h5"));
  EXPECT_EQ(text_in(json("out/status.json"), "cause").find("stopped after the hours"), 0U);
  RunningProgram job(long_run("other"), folder_.path());
  ASSERT_TRUE(is_shearing("other"));
  job.send(SIGXCPU);
  job.send(SIGXCPU);  // as the kernel does, every second
  const ProgramResult at_processor_limit = job.wait();
  EXPECT_EQ(at_processor_limit.exit_code, 75) << at_processor_limit.err;
  EXPECT_NE(at_processor_limit.err.find("processor time"), std::string::npos) << at_processor_limit.err;
}

TEST_F(LongRun, SignalsThatTheCallerIgnoresStayIgnored) {
  // As nohup does, and a shell that puts a job into the background.
  RunningProgram job(
      {"/bin/sh", "-c",
       fmt::format("trap '' INT HUP; exec {} run tiny.toml -o out -j 1 --set 'shear.velocity=1 mm/s'", DEM_PROGRAM)},
      folder_.path());
  ASSERT_TRUE(is_shearing("out"));
  job.send(SIGINT);
  job.send(SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(text_in(json("out/status.json"), "state"), "running");
  job.send(SIGTERM);
  EXPECT_EQ(job.wait().exit_code, 75);
}

TEST_F(LongRun, KilledRunLeavesAFolderThatTheNextOneTakesOver) {
  {
    RunningProgram killed(long_run("out"), folder_.path());
    ASSERT_TRUE(is_shearing("out"));
    killed.send(SIGKILL);
    EXPECT_EQ(killed.wait().signal, SIGKILL);
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/run.lock"));
  EXPECT_EQ(run({"info", "out"}).exit_code, 0) << "frames written before the kill can be read";
  std::filesystem::remove(folder_ / "out/shear.csv");  // so that the rows below are those of the next run
  RunningProgram next(long_run("out"), folder_.path());
  ASSERT_TRUE(is_shearing("out"));
  next.send(SIGTERM);
  const ProgramResult result = next.wait();
  EXPECT_EQ(result.exit_code, 75);
  EXPECT_NE(result.err.find("took over the lock"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("goes on from the checkpoint"), std::string::npos) << result.err;
}

TEST_F(CommandLine, StoppedFiveTimesEndsWithTheSameFiles) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "straight", "-j", "1"}).exit_code, 0);
  int stops = 0, milliseconds = 37;
  for (int part = 0;; ++part) {
    ASSERT_LT(part, 60) << "a run that is stopped again and again must get somewhere";
    const std::vector<std::string> words{
        DEM_PROGRAM, "run", "tiny.toml", "-o", "stopped", "-j", std::to_string(1 + part % 2)};
    RunningProgram program(words, folder_.path());
    if (stops < 5) {
      // A part that has little left to do may be over before its lock is seen.
      for (int k = 0; k < 1000 && !std::filesystem::exists(folder_ / "stopped/run.lock") &&
                      !std::filesystem::exists(folder_ / "stopped/summary.json");
           ++k) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      milliseconds = (milliseconds * 2731 + 13) % 900;  // at no particular moments
      program.send(part % 2 == 0 ? SIGTERM : SIGINT);
    }
    const ProgramResult result = program.wait();
    if (result.exit_code == 0) break;
    ASSERT_EQ(result.exit_code, 75) << result.err;
    ++stops;
  }
  EXPECT_GT(stops, 1);
  for (const char* name : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "results.h5", "specimen.h5"}) {
    EXPECT_TRUE(read_all(folder_ / "stopped" / name) == read_all(folder_ / "straight" / name)) << name;
  }
  EXPECT_EQ(text_in(json("stopped/summary.json"), "state_hash"), text_in(json("straight/summary.json"), "state_hash"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "stopped/checkpoint.h5"));
}

TEST_F(CommandLine, DamagedCheckpointIsNamedAndNothingIsLost) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "out", "-j", "1"}).exit_code, 0);
  std::filesystem::remove(folder_ / "out/summary.json");
  write_all(folder_ / "out/checkpoint.h5", "no HDF5");
  const std::string rows = read_all(folder_ / "out/shear.csv");
  const ProgramResult result = run({"run", "tiny.toml", "-o", "out", "-j", "1"});
  EXPECT_EQ(result.exit_code, 74) << result.err;
  EXPECT_NE(result.err.find("checkpoint.h5"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("to start the run anew"), std::string::npos) << result.err;
  EXPECT_EQ(read_all(folder_ / "out/shear.csv"), rows);
}

}  // namespace
}  // namespace dem
