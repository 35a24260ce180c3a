// SPDX-License-Identifier: BSD-3-Clause
// The program as a user meets it: exit codes, messages, output folders, and the same bytes for any number of threads.
// Not tested here: runs that are stopped or killed (stopped_run_test.cpp), `verify` (verify_command_test.cpp).
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "dem4grm/version.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;
using test::write_all;

TEST_F(CommandLine, VersionNamesProgramCommitAndCompiler) {
  const ProgramResult result = run({"--version"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.err.empty()) << result.err;
  for (const char* part : {"dem4grm", k_version, "commit", k_compiler}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << result.out;
  }
}

TEST_F(CommandLine, EveryHelpFitsAScreenAndEndsWithAnExample) {
  for (const std::vector<std::string>& verb : std::vector<std::vector<std::string>>{{},
                                                                                    {"new"},
                                                                                    {"check"},
                                                                                    {"specimen"},
                                                                                    {"run"},
                                                                                    {"info"},
                                                                                    {"sieve"},
                                                                                    {"micro"},
                                                                                    {"profile"},
                                                                                    {"export"},
                                                                                    {"report"},
                                                                                    {"watch"},
                                                                                    {"verify"}}) {
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

TEST_F(CommandLine, StoreThatCannotBeWrittenCostsAWarningNotTheRun) {
  write_all(folder_ / "file", "");
  const ProgramResult result = run({"run", "tiny.toml", "-j", "1", "--store", "file"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("the run goes on, but later ones will not find its preparation"), std::string::npos);
  const std::size_t warned = result.err.find("file/"), filled = result.err.find("\nfill ");
  EXPECT_LT(warned, filled) << "found at the start: " << result.err;
}

TEST_F(CommandLine, ThreadsThatCannotBeStartedAreAnError) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const std::string command = fmt::format("ulimit -v 1500000; exec {} run tiny.toml -j 1000", DEM_PROGRAM);
  const ProgramResult result = test::run_program({"/bin/sh", "-c", command}, folder_.path());
  EXPECT_EQ(result.exit_code, 71) << result.err;
  EXPECT_NE(result.err.find("of 1000 threads can be started here"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
#endif
}

TEST_F(CommandLine, NumbersOfGrainsThatFillTooLittleAreRefused) {
  for (const char* verb : {"check", "run"}) {
    expect(65, "1 gravel and 0 rubber grains fill",
           {verb, "tiny.toml", "--set", "specimen.gravel_clumps=1", "--set", "specimen.rubber_content=0"});
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs"));
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
  expect(64, "the name is empty", {"run", "tiny.toml", "-o", ""});
  expect(64, "--max-hours", {"run", "tiny.toml", "--max-hours", "0"});
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
  EXPECT_GT(number_in(facts, "forecast_time_s"), 1.0);
  EXPECT_GT(number_in(facts, "forecast_steps"), number_in(facts, "steps"));
  const ProgramResult brief = run({"check", "tiny.toml", "--brief", "--json"});
  EXPECT_EQ(brief.exit_code, 0) << brief.err;
  EXPECT_EQ(brief.out.find("forecast"), std::string::npos) << brief.out;
  const ProgramResult keys = run({"check", "--keys"});
  EXPECT_EQ(keys.exit_code, 0);
  EXPECT_NE(keys.out.find("rubber_content"), std::string::npos);
}

TEST_F(CommandLine, SameBytesForAnyNumberOfThreads) {
  const ProgramResult one = run({"run", "tiny.toml", "-o", "one", "-j", "1"});
  const ProgramResult two = run({"run", "tiny.toml", "-o", "two", "-j", "2"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  ASSERT_EQ(two.exit_code, 0) << two.err;
  for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "results.h5", "specimen.h5",
                           "case.toml", "resolved.toml"}) {
    const std::string bytes = read_all(folder_ / "one" / file);
    EXPECT_FALSE(bytes.empty()) << file;
    EXPECT_TRUE(bytes == read_all(folder_ / "two" / file)) << file;
  }
  double size = 0.0;
  for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "results.h5", "specimen.h5"}) {
    size += static_cast<double>(std::filesystem::file_size(folder_ / "one" / file));
  }
  const JsonObject forecast = parse_json(run({"check", "tiny.toml", "--json"}).out, "check");
  EXPECT_NEAR(1e6 * number_in(forecast, "forecast_results_MB"), size, 0.3 * size);
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
  const std::string other = run({"run", "tiny.toml", "-o", "runs/tiny", "--set", "seed=4"}).err;
  EXPECT_NE(other.find("\n  the case has  seed = 4\n"), std::string::npos) << other;
  EXPECT_EQ(other.find("--specimen"), std::string::npos) << other;
  expect(64, "Its specimen would do for this case: -o NEW_FOLDER --specimen runs/tiny",
         {"run", "tiny.toml", "-o", "runs/tiny", "--set", "shear.displacement=\"0.7 mm\""});

  const ProgramResult info = run({"info", "runs/tiny"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("whole"), std::string::npos) << info.out;
  EXPECT_NE(run({"info", "runs/tiny/specimen.h5"}).out.find("state 0000"), std::string::npos);
  // The stored specimen gives the numbers that the run found on the live one.
  const std::size_t scatter = info.out.find("  scatter over cells"), end = info.out.find("runs/tiny/results.h5");
  ASSERT_NE(scatter, std::string::npos) << info.out;
  EXPECT_TRUE(run({"info", "runs/tiny/specimen.h5"}).out.ends_with(info.out.substr(scatter, end - scatter)));
  expect(66, "no output folder", {"info", "."});
  const ProgramResult sieve = run({"sieve", "--sieves", "3.6mm,3.8mm,4mm", "runs/tiny", "--json", "--csv", "s.csv"});
  EXPECT_EQ(sieve.exit_code, 0) << sieve.err;
  EXPECT_EQ(std::get<JsonList>(find_field(parse_json(sieve.out, "sieve --json"), "sieves")->data).size(), 3U);
  EXPECT_TRUE(read_all(folder_ / "s.csv").starts_with("sieve_mm,gravel_passing_percent,"));
  EXPECT_NE(run({"sieve", "runs/tiny/results.h5"}).out.find("137 grains"), std::string::npos);
  expect(64, "\"4\" has no unit", {"sieve", "runs/tiny", "--sieves", "4"});
  expect(66, "holds neither", {"sieve", "."});
  expect(74, "tiny.toml", {"sieve", "tiny.toml"});
  expect(66, "no such file", {"info", "missing.h5"});
  expect(74, "tiny.toml", {"info", "tiny.toml"});
  std::filesystem::copy_file(folder_ / "runs/tiny/specimen.h5", folder_ / "runs/tiny/results.h5",
                             std::filesystem::copy_options::overwrite_existing);
  expect(74, "not of one run", {"info", "runs/tiny"});
}

/// The field of a column in the row whose displacement begins with the text.
double field_of(const std::string& csv, const std::string& column, const std::string& displacement) {
  std::istringstream lines(csv);
  std::string line, name, value;
  std::getline(lines, line);
  const std::string header = line;
  while (std::getline(lines, line)) {
    if (!line.starts_with(displacement)) continue;
    std::istringstream names(header), values(line);
    while (std::getline(names, name, ',') && std::getline(values, value, ',')) {
      if (name == column) return std::stod(value);
    }
  }
  ADD_FAILURE() << column << " at " << displacement;
  return 0.0;
}

TEST_F(CommandLine, MicroReadsWhatTheRunRecorded) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "out", "-q"}).exit_code, 0);
  const std::string csv = read_all(folder_ / "out/micro.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7) << "the header and 0, 0.2, ... 1 mm";
  const ProgramResult table = run({"micro", "out", "--at", "0.5mm", "--bootstrap", "20", "--histogram", "polar.csv"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  for (const char* part : {"state 0002 at 0.5", "g-r", "theta_n", "95 % band", "bulk_friction", "bond_strain"}) {
    EXPECT_NE(table.out.find(part), std::string::npos) << table.out;
  }
  EXPECT_TRUE(read_all(folder_ / "polar.csv").starts_with("set,angle_deg,"));
  // The stored state gives the digits of the row that was written while the test ran.
  const ProgramResult result = run({"micro", "out", "--at", "0.2 mm", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const JsonObject answer = parse_json(result.out, "micro --json");
  const auto& all =
      std::get<JsonObject>(find_field(std::get<JsonObject>(find_field(answer, "sets")->data), "all")->data);
  EXPECT_EQ(number_in(all, "a_n"), field_of(csv, "a_n_all", "0.2"));
  EXPECT_EQ(number_in(all, "theta_n_deg"), field_of(csv, "theta_n_all_deg", "0.2"));
  EXPECT_EQ(number_in(answer, "stress_zz_kPa"), field_of(csv, "stress_zz_kPa", "0.2"));
  EXPECT_EQ(number_in(answer, "bond_strain"), field_of(csv, "bond_strain", "0.2"));
  const JsonObject summary = json("out/summary.json");
  EXPECT_GT(number_in(std::get<JsonObject>(find_field(summary, "micro_at_peak")->data), "a_n"), 0.0);

  // The script makes the histograms from the stored contacts in NumPy: another reading of the same formulas.
  const ProgramResult script = test::run_program(
      {"/usr/bin/python3", std::string(DEM_SOURCE_DIR) + "/tools/plot_micro.py", "out", "--at", "0.2", "0.5"},
      folder_.path());
  EXPECT_EQ(script.exit_code, 0) << script.err;
  EXPECT_GT(std::filesystem::file_size(folder_ / "out/micro.png"), 10000U);
  const std::string expected = fmt::format(
      "a {:.4f}, theta_a {:.3f} deg; a_n {:.4f}, theta_n {:.3f} deg; a_t {:.4f}, theta_t {:.3f} deg; "
      "a_s {:.4f}, theta_s {:.3f} deg",
      number_in(all, "a"), number_in(all, "theta_a_deg"), number_in(all, "a_n"), number_in(all, "theta_n_deg"),
      number_in(all, "a_t"), number_in(all, "theta_t_deg"), number_in(all, "a_s"), number_in(all, "theta_s_deg"));
  EXPECT_NE(script.out.find(expected), std::string::npos) << script.out << expected;

  expect(66, "there are states at 0, 0.2, 0.5, 1 mm", {"micro", "out", "--at", "7mm"});
  expect(66, "absent", {"micro", "absent"});
  expect(66, "has no results.h5", {"micro", "."});
  expect(74, "tiny.toml", {"micro", "tiny.toml"});
  expect(64, "has no unit", {"micro", "out", "--at", "7"});
  expect(64, "must divide 180", {"micro", "out", "--bin-width", "7"});
  expect(64, "--level", {"micro", "out", "--level", "grain"});
  expect(64, "--bootstrap", {"micro", "out", "--bootstrap", "-1"});
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

TEST_F(CommandLine, ACrashOfTheReaderIsToldInWords) {
  // A pipe in place of the file keeps the reader waiting until a signal of a crash reaches it.
  ASSERT_EQ(::mkfifo((folder_ / "slow.h5").c_str(), 0600), 0);
  test::RunningProgram job(words({"info", "slow.h5"}), folder_.path());
  const std::string children = fmt::format("/proc/{0}/task/{0}/children", job.process());
  pid_t reader = 0;
  for (int k = 0; k < 500 && reader == 0; ++k) {
    std::ifstream(children) >> reader;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_GT(reader, 0);
  ::kill(reader, SIGSEGV);
  const ProgramResult result = job.wait();
  EXPECT_EQ(result.exit_code, 74);
  EXPECT_NE(result.err.find("slow.h5: the HDF5 library crashed while it read the file"), std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace dem
