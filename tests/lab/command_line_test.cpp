// SPDX-License-Identifier: BSD-3-Clause
// The program as a user meets it: exit codes, messages, output folders, and the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "dem4grm/io/folder_lock.hpp"
#include "dem4grm/io/json_text.hpp"
#include "dem4grm/version.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using test::ProgramResult;
using test::read_all;
using test::RunningProgram;
using test::TemporaryFolder;
using test::write_all;

/// 137 clumps and 23 rubber grains, sheared in about a second.
constexpr const char* k_tiny_case = R"(name = "tiny"
seed = 3
[specimen]
rubber_content = 0.2
preparation_friction = 0.3
generation_void_ratio = 0.85
gravel_grading = [["3.6 mm", 0.0], ["4.0 mm", 1.0]]
rubber_grading = [["3.6 mm", 0.0], ["3.8 mm", 1.0]]
[box]
length = "21 mm"
width  = "21 mm"
height = "21 mm"
upper_height = "40 mm"
[equilibrium]
force_ratio = 0.02
plate_speed = "5 mm/s"
stress_tolerance = 0.05
hold_steps = 200
[shear]
normal_stress = "100 kPa"
velocity      = "200 mm/s"
displacement  = "1 mm"
[recording]
frame_interval = "0.5 mm"
)";

class CommandLine : public ::testing::Test {
 protected:
  CommandLine() { write_all(folder_ / "tiny.toml", k_tiny_case); }

  [[nodiscard]] static std::vector<std::string> words(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), DEM_PROGRAM);
    return arguments;
  }
  [[nodiscard]] ProgramResult run(std::vector<std::string> arguments) const {
    return test::run_program(words(std::move(arguments)), folder_.path());
  }
  /// Runs, expects the code and that stderr says the text.
  ProgramResult expect(int code, const std::string& text, std::vector<std::string> arguments) const {
    ProgramResult result = run(std::move(arguments));
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    return result;
  }
  [[nodiscard]] JsonObject json(const std::string& name) const { return read_json_file(folder_ / name); }

  TemporaryFolder folder_;
};

TEST_F(CommandLine, VersionNamesProgramCommitAndCompiler) {
  const ProgramResult result = run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.err.empty()) << result.err;
  for (const char* part : {"dem4grm", k_version, "commit", k_compiler}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  }
}

TEST_F(CommandLine, EveryHelpFitsAScreenAndEndsWithAnExample) {
  for (const std::vector<std::string>& verb :
       std::vector<std::vector<std::string>>{{}, {"new"}, {"check"}, {"run"}, {"info"}}) {
    std::vector<std::string> arguments = verb;
    arguments.emplace_back("--help");
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 24) << result.out;
    EXPECT_LT(result.out.find("Example:"), result.out.size()) << result.out;
    std::size_t begin = 0;
    for (std::size_t end = 0; (end = result.out.find('\n', begin)) != std::string::npos; begin = end + 1) {
      EXPECT_LE(end - begin, 80U) << result.out.substr(begin, end - begin);
    }
  }
}

TEST_F(CommandLine, WrongWordsAreUsageErrors) {
  expect(64, "--help", {});
  expect(64, "--help", {"frobnicate"});
  expect(64, "CASE", {"run"});
  expect(64, "run --help", {"run", "tiny.toml", "--no-such-option"});
  expect(64, "1024", {"run", "tiny.toml", "-j", "0"});
  expect(64, "1024", {"run", "tiny.toml", "-j", "1025"});
  expect(64, "--threads", {"run", "tiny.toml", "-j", "two"});
  expect(64, "key=value", {"run", "tiny.toml", "--set", "shear.velocity"});
  expect(64, "key=value", {"run", "tiny.toml", "--set", "=3"});
  expect(64, "--keys", {"check"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
}

TEST_F(CommandLine, BadCasesAreRefusedAndNothingIsWritten) {
  write_all(folder_ / "empty.toml", "");
  expect(65, "[specimen]", {"run", "empty.toml", "-o", "out"});
  expect(65, "rubber_content", {"run", "tiny.toml", "-o", "out", "--set", "specimen.rubber_content=1.5"});
  const ProgramResult twice = run({"check", "tiny.toml", "--set", "seed=-1", "--set", "shear.velocity=2 furlongs"});
  EXPECT_EQ(twice.exit_code, 65);
  EXPECT_NE(twice.err.find("seed"), std::string::npos) << twice.err;
  EXPECT_NE(twice.err.find("velocity"), std::string::npos) << twice.err;
  expect(65, "friction", {"run", "tiny.toml", "-o", "out", "--set", "gravel.frictoin=0.5"});
  expect(66, "no such file", {"run", "missing.toml", "-o", "out"});
  expect(66, "is a folder", {"run", ".", "-o", "out"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(CommandLine, FolderThatCannotBeMadeIsAnIoError) {
  write_all(folder_ / "file", "x");
  expect(74, "file/below: the folder cannot be made: Not a directory", {"run", "tiny.toml", "-o", "file/below"});
  expect(74, "file: is no folder", {"run", "tiny.toml", "-o", "file"});
  expect(74, "/proc/dem4grm", {"run", "tiny.toml", "-o", "/proc/dem4grm"});
}

TEST_F(CommandLine, NewWritesACaseThatIsValidAndNeverWritesOverOne) {
  for (const char* kind : {"direct_shear", "grain_compression"}) {
    const ProgramResult shown = run({"new", kind});
    EXPECT_EQ(shown.exit_code, 0) << shown.err;
    const std::string file = std::string(kind) + ".toml";
    EXPECT_EQ(run({"new", kind, "-o", file}).exit_code, 0);
    EXPECT_EQ(read_all(folder_ / file), shown.out);
    const ProgramResult check = run({"check", file});
    EXPECT_EQ(check.exit_code, 0) << check.err;
    expect(64, "is there already", {"new", kind, "-o", file});
  }
  const ProgramResult soft = run({"new", "direct_shear", "--vrc", "40", "--stress", "30kPa"});
  EXPECT_EQ(soft.exit_code, 0) << soft.err;
  EXPECT_NE(soft.out.find("0.4"), std::string::npos);
  EXPECT_NE(soft.out.find("30 kPa"), std::string::npos);
  EXPECT_NE(run({"new", "direct_shear", "--vrc", "140"}).exit_code, 0);
  EXPECT_NE(run({"new", "triaxial"}).exit_code, 0);
  EXPECT_NE(run({"new", "direct_shear", "--stress", "60 furlongs"}).exit_code, 0);
}

TEST_F(CommandLine, CheckShowsWhatFollowsFromACase) {
  const ProgramResult text = run({"check", "tiny.toml"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  for (const char* part : {"137 gravel clumps, 23 rubber grains", "1249, with 1472 bonds", "limited by",
                           "too fast to be quasi-static", "MB"}) {
    EXPECT_NE(text.out.find(part), std::string::npos) << text.out;
  }
  const ProgramResult result = run({"check", "tiny.toml", "--json", "--set", "shear.velocity=2 mm/s"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const JsonObject facts = parse_json(result.out, "check");
  EXPECT_EQ(number_in(facts, "clumps"), 137.0);
  EXPECT_GT(number_in(facts, "time_step_s"), 1e-7);
  EXPECT_TRUE(is_set_in(facts, "is_quasi_static"));
  EXPECT_TRUE(result.err.empty()) << result.err;
  const ProgramResult keys = run({"check", "--keys"});
  EXPECT_EQ(keys.exit_code, 0);
  EXPECT_NE(keys.out.find("rubber_content"), std::string::npos);
}

TEST_F(CommandLine, SameBytesForAnyNumberOfThreads) {
  const ProgramResult one = run({"run", "tiny.toml", "-o", "one", "-j", "1"});
  const ProgramResult two = run({"run", "tiny.toml", "-o", "two", "-j", "2"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  ASSERT_EQ(two.exit_code, 0) << two.err;
  for (const char* file : {"shear.csv", "results.h5", "specimen.h5", "case.toml", "resolved.toml"}) {
    const std::string bytes = read_all(folder_ / "one" / file);
    EXPECT_FALSE(bytes.empty()) << file;
    EXPECT_TRUE(bytes == read_all(folder_ / "two" / file)) << file;
  }
  const JsonObject a = json("one/summary.json"), b = json("two/summary.json");
  EXPECT_EQ(number_in(b, "threads"), 2.0);
  const auto& hashes = std::get<JsonList>(find_field(a, "state_hashes")->data);
  const auto& others = std::get<JsonList>(find_field(b, "state_hashes")->data);
  ASSERT_EQ(hashes.size(), 4U);
  ASSERT_EQ(others.size(), 4U);
  for (std::size_t k = 0; k < hashes.size(); ++k) {
    const auto& frame = std::get<JsonObject>(hashes[k].data);
    EXPECT_EQ(text_in(frame, "state_hash"), text_in(std::get<JsonObject>(others[k].data), "state_hash"));
  }
}

TEST_F(CommandLine, ARunTellsItsStoryAndIsNotRepeated) {
  const ProgramResult first = run({"run", "tiny.toml", "-j", "1"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  for (const char* part : {"peak shear stress", "residual", "dilation angle", "void ratio", "normal stress",
                           "inertial number", "lost: 0", "wall time", "runs/tiny", "next"}) {
    EXPECT_NE(first.out.find(part), std::string::npos) << first.out;
  }
  // Not a terminal: whole lines without control characters, one at least for each stage.
  for (const char* stage : {"fill ", "compression ", "final friction ", "shear "}) {
    EXPECT_NE(first.err.find("\n" + std::string(stage)), std::string::npos) << first.err;
  }
  EXPECT_EQ(first.err.find_first_of("\r\033"), std::string::npos);
  EXPECT_EQ(text_in(json("runs/tiny/status.json"), "state"), "finished");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs/tiny/run.lock"));
  EXPECT_NE(read_all(folder_ / "runs/tiny/run.log").find("finished after"), std::string::npos);
  EXPECT_EQ(number_in(json("runs/tiny/summary.json"), "lost_grains", -1.0), 0.0);

  const auto written = std::filesystem::last_write_time(folder_ / "runs/tiny/summary.json");
  const ProgramResult second = run({"run", "tiny.toml", "--json"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  const JsonObject answer = parse_json(second.out, "run --json");
  EXPECT_TRUE(is_set_in(answer, "was_complete"));
  EXPECT_EQ(text_in(answer, "state_hash"), text_in(json("runs/tiny/summary.json"), "state_hash"));
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "runs/tiny/summary.json"), written);
  EXPECT_NE(run({"run", "tiny.toml"}).out.find("is complete"), std::string::npos);
  expect(64, "another case", {"run", "tiny.toml", "-o", "runs/tiny", "--set", "seed=4"});

  const ProgramResult info = run({"info", "runs/tiny"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("whole"), std::string::npos) << info.out;
  EXPECT_NE(run({"info", "runs/tiny/specimen.h5"}).out.find("state 0000"), std::string::npos);
  expect(66, "no output folder", {"info", "."});
  expect(66, "no such file", {"info", "missing.h5"});
  expect(74, "tiny.toml", {"info", "tiny.toml"});
  std::filesystem::copy_file(folder_ / "runs/tiny/specimen.h5", folder_ / "runs/tiny/results.h5",
                             std::filesystem::copy_options::overwrite_existing);
  expect(74, "not of one run", {"info", "runs/tiny"});
}

TEST_F(CommandLine, QuietRunSaysNothingAndJsonRunOnlyJson) {
  const std::string grain = std::string(DEM_SOURCE_DIR) + "/cases/grain_compression.toml";
  const std::vector<std::string> short_run{"run", grain, "--set", "compression.strain=0.01", "-o"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), short_run.begin(), short_run.end());
    return run(more);
  };
  const ProgramResult quiet = with({"quiet", "-q", "-j", "1"});
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  const ProgramResult spoken = with({"json", "--json"});  // on all processors
  EXPECT_EQ(spoken.exit_code, 0) << spoken.err;
  EXPECT_EQ(text_in(parse_json(spoken.out, "run --json"), "test"), "grain_compression");
  EXPECT_EQ(read_all(folder_ / "json/grain.csv"), read_all(folder_ / "quiet/grain.csv"));
  EXPECT_EQ(read_all(folder_ / "json/results.h5"), read_all(folder_ / "quiet/results.h5"));
}

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
  for (const char* name : {"shear.csv", "results.h5", "specimen.h5"}) {
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
  EXPECT_NE(result.err.find("remove the file"), std::string::npos) << result.err;
  EXPECT_EQ(read_all(folder_ / "out/shear.csv"), rows);
}

TEST_F(CommandLine, FullDiskIsAnIoErrorAndMarksTheRun) {
  // A limit of the file size stands for a full disk: the first state needs more than 100 kB.
  const std::string command =
      fmt::format("ulimit -f 100; exec {} run tiny.toml -o out -j 1 --set shear.displacement='0.1 mm'", DEM_PROGRAM);
  const ProgramResult result = test::run_program({"/bin/bash", "-c", command}, folder_.path());
  EXPECT_EQ(result.exit_code, 74) << result.err;
  EXPECT_NE(result.err.find(".h5"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("File too large"), std::string::npos) << result.err;
  EXPECT_EQ(text_in(json("out/status.json"), "state"), "failed");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/run.lock"));
}

TEST_F(CommandLine, FailedPhysicsHasItsOwnCodeAndCause) {
  const ProgramResult result = run({"run", "tiny.toml", "-o", "out", "-j", "1", "--set", "equilibrium.most_steps=300",
                                    "--set", "equilibrium.force_ratio=1e-9"});
  EXPECT_EQ(result.exit_code, 76) << result.err;
  const JsonObject status = json("out/status.json");
  EXPECT_EQ(text_in(status, "state"), "failed");
  EXPECT_FALSE(text_in(status, "cause").empty());
}

TEST_F(CommandLine, TooLittleMemoryHasItsOwnCode) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve more address space than the limit";
#endif
  // 0.7 million grains in 600 MB of address space.
  const std::string command = fmt::format(
      "ulimit -v 600000; exec {} run tiny.toml -o out -j 1 -q --set box.length='300 mm' --set box.width='300 mm' "
      "--set box.height='300 mm' --set box.upper_height='600 mm'",
      DEM_PROGRAM);
  const ProgramResult result = test::run_program({"/bin/bash", "-c", command}, folder_.path());
  EXPECT_EQ(result.exit_code, 71) << result.err;
  EXPECT_NE(result.err.find("out of memory"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace dem
