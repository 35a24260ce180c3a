// SPDX-License-Identifier: BSD-3-Clause
// A test that starts from a stored state of another one: what it may change, that it keeps the bits where nothing changes, what the
// plate and the halves do where something does, and that the source is only read.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "dem4grm/case_file/case_schema.hpp"
#include "dem4grm/lab/branched_state.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/runs/branch_rules.hpp"
#include "support/command_line.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;
using test::RunningProgram;

class Branched : public CommandLine {
 protected:
  /// `run` without a page, on one thread; `settings` as for --set.
  [[nodiscard]] static std::vector<std::string> start(std::vector<std::string> first, const std::string& folder,
                                                      const std::vector<std::string>& settings = {}) {
    first.insert(first.begin(), "run");
    first.insert(first.end(), {"-o", folder, "-j", "1", "--no-report"});
    for (const std::string& setting : settings) first.insert(first.end(), {"--set", setting});
    return first;
  }
  void make_source(const std::vector<std::string>& settings = {"shear.displacement=0.5 mm"}) const {
    ASSERT_EQ(run(start({"tiny.toml"}, "source", settings)).exit_code, 0);
  }
  [[nodiscard]] std::string hash_of(const std::string& folder) const {
    return text_in(json(folder + "/summary.json"), "state_hash");
  }
  void expect_same_record(const std::string& a, const std::string& b) const {
    for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "resolved.toml"}) {
      EXPECT_EQ(read_all(folder_ / (a + "/" + file)), read_all(folder_ / (b + "/" + file))) << file;
    }
    EXPECT_EQ(hash_of(a), hash_of(b));
  }
  [[nodiscard]] JsonObject branch_of(const std::string& folder) const {
    return std::get<JsonObject>(find_field(json(folder + "/summary.json"), "branch")->data);
  }
  /// Every file of a folder with its bytes and its time.
  [[nodiscard]] std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> files_of(
      const std::string& folder) const {
    std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / folder)) {
      if (entry.is_regular_file()) out[entry.path().string()] = {read_all(entry.path()), entry.last_write_time()};
    }
    return out;
  }
};

TEST_F(Branched, WithoutAChangeOfPhysicsItEndsWithTheBitsOfTheStraightTest) {
  const std::string micro = "recording.micro_interval=0.1 mm";
  ASSERT_EQ(run(start({"tiny.toml"}, "straight", {micro})).exit_code, 0);
  make_source({micro, "shear.displacement=0.5 mm"});
  const auto before = files_of("source");
  const ProgramResult longer = run(start({"--from", "source"}, "longer", {"shear.displacement=1 mm"}));
  ASSERT_EQ(longer.exit_code, 0) << longer.err;
  expect_same_record("straight", "longer");
  EXPECT_EQ(number_in(branch_of("longer"), "numbers_from_mm"), 0.0);
  EXPECT_EQ(number_in(json("longer/summary.json"), "peak_shear_stress_kPa"),
            number_in(json("straight/summary.json"), "peak_shear_stress_kPa"));
  // From before shear, by another way: a case besides, whose other keys are those of the source.
  ASSERT_EQ(run(start({"straight/resolved.toml", "--from", "source/specimen.h5"}, "sheared")).exit_code, 0);
  expect_same_record("straight", "sheared");
  ASSERT_EQ(run(start({"--from", "source"}, "again")).exit_code, 0);
  expect_same_record("source", "again");
  EXPECT_TRUE(files_of("source") == before) << "it is only read";
}

TEST_F(Branched, FromARunningTestItTakesTheNewestCheckpoint) {
  const std::vector<std::string> slow{"shear.velocity=5 mm/s", "shear.displacement=0.6 mm"};
  RunningProgram source(words(start({"tiny.toml"}, "source", slow)), folder_.path());
  for (int k = 0; k < 3000; ++k) {
    const std::string rows = read_all(folder_ / "source/shear.csv");
    if (std::count(rows.begin(), rows.end(), '\n') > 5) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::filesystem::remove(folder_ / "source/checkpoint.h5");  // that of the start of shear
  source.send(SIGUSR1);
  ASSERT_TRUE(test::wait_for_file(folder_ / "source/checkpoint.h5", 20.0));
  std::vector<std::string> on_two = start({"--from", "source"}, "new", {"shear.displacement=0.3 mm"});
  std::replace(on_two.begin(), on_two.end(), std::string("1"), std::string("2"));
  const ProgramResult branch = run(on_two);
  EXPECT_EQ(branch.exit_code, 0) << branch.err;
  source.send(SIGTERM);
  const int code = source.wait().exit_code;
  EXPECT_TRUE(code == 75 || code == 0) << code;
  ASSERT_EQ(run(start({"tiny.toml"}, "straight", {slow[0], "shear.displacement=0.3 mm"})).exit_code, 0);
  expect_same_record("straight", "new");
  EXPECT_GT(number_in(branch_of("new"), "displacement_mm"), 0.04);
}

TEST_F(Branched, UnderAnotherStressThePlateHoldsTheNewOne) {
  make_source();
  const std::vector<std::string> changes{"shear.normal_stress=60 kPa", "shear.velocity=20 mm/s",
                                         "shear.displacement=0.8 mm"};
  const ProgramResult result = run(start({"--from", "source/end_state.h5"}, "new", changes));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("consolidates under 60 kPa"), std::string::npos) << result.err;
  const JsonObject summary = json("new/summary.json"), branch = branch_of("new");
  EXPECT_NEAR(number_in(summary, "normal_stress_mean_kPa"), 60.0, 0.6);
  EXPECT_LT(number_in(summary, "normal_stress_max_error"), 0.05);
  EXPECT_NEAR(number_in(branch, "numbers_from_mm"), 0.5, 0.001);
  EXPECT_NEAR(number_in(branch, "displacement_mm"), 0.5, 0.001);
  EXPECT_EQ(text_in(branch, "stage"), "shear");
  EXPECT_EQ(text_in(branch, "state_hash"), hash_of("source"));
  EXPECT_FALSE(has_number(summary, "secant_stiffness_kPa_per_mm")) << "the start of shear is not in it";
  EXPECT_TRUE(std::fabs(number_in(summary, "energy_closure_per_cent")) < 5.0);
  // What was recorded before is kept.
  const std::string old_rows = read_all(folder_ / "source/shear.csv"), rows = read_all(folder_ / "new/shear.csv");
  EXPECT_TRUE(rows.starts_with(old_rows));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 81);
  const ProgramResult info = run({"info", "new"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_NE(info.out.find("shear.normal_stress 100 kPa -> 60 kPa"), std::string::npos) << info.out;
  EXPECT_NE(read_all(folder_ / "new/run.log").find("branches from"), std::string::npos);
  EXPECT_NE(run({"report", "new", "--data"}).out.find("--from"), std::string::npos);
  // The same command goes on, or has nothing to do; so does the complete case that the folder holds.
  EXPECT_NE(run(start({"--from", "source"}, "new", changes)).out.find("nothing was computed"), std::string::npos);
  EXPECT_NE(run(start({"new/case.toml"}, "new")).out.find("nothing was computed"), std::string::npos);
  // A branch of the branch tells the whole line.
  ASSERT_EQ(run(start({"--from", "new"}, "third", {"shear.displacement=0.9 mm"})).exit_code, 0);
  EXPECT_NE(find_field(branch_of("third"), "source_branch"), nullptr);
  EXPECT_NEAR(number_in(branch_of("third"), "numbers_from_mm"), 0.5, 0.001) << "the course is still that of 60 kPa";
}

TEST_F(Branched, StoppedAndKilledItGoesOnWithTheSameBits) {
  make_source();
  const std::vector<std::string> changes{"shear.normal_stress=150 kPa", "shear.velocity=20 mm/s",
                                         "shear.displacement=0.7 mm"};
  const std::vector<std::string> command = start({"--from", "source"}, "new", changes);
  ASSERT_EQ(run(start({"--from", "source"}, "straight", changes)).exit_code, 0);
  for (const int signal : {SIGKILL, SIGTERM}) {
    RunningProgram job(words(command), folder_.path());
    ASSERT_TRUE(test::wait_for_file(folder_ / "new/checkpoint.h5", 20.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    job.send(signal);
    job.wait();
  }
  // Without its source, too.
  std::filesystem::rename(folder_ / "source", folder_ / "elsewhere");
  ASSERT_EQ(run(start({"new/case.toml"}, "new")).exit_code, 0);
  expect_same_record("straight", "new");
  // As if it had died before its first checkpoint: it does not begin at the beginning.
  for (const char* file : {"summary.json", "end_state.h5"}) std::filesystem::remove(folder_ / "new" / file);
  expect(64, "run it with --from again", start({"new/case.toml"}, "new"));
  std::filesystem::rename(folder_ / "elsewhere", folder_ / "source");
  ASSERT_EQ(run(command).exit_code, 0);
  expect_same_record("straight", "new");
}

TEST_F(Branched, WhatTheStateEmbodiesIsRefusedWithOneMessage) {
  make_source();
  const ProgramResult refused =
      expect(65, "shear.moving_half = lower -> upper: may change until shear begins",
             start({"--from", "source"}, "new",
                   {"shear.moving_half=upper", "seed=4", "rubber.friction=0.3", "specimen.rubber_content=0.1",
                    "shear.displacement=0.4 mm", "shear.normal_stress=60 kPa"}));
  for (const char* part : {"seed = 3 -> 4: may change at no stored point", "rubber.friction = 0.27 -> 0.3",
                           "specimen.rubber_content = 0.2 -> 0.1", "shear.displacement = 0.5 mm -> 0.4 mm"}) {
    EXPECT_NE(refused.err.find(part), std::string::npos) << part << "\n" << refused.err;
  }
  EXPECT_EQ(refused.err.find("normal_stress"), std::string::npos) << "that may change";
  expect(65, "say how far to shear on", start({"--from", "source"}, "new", {"shear.normal_stress=60 kPa"}));
  expect(64, "choose another one with -o", start({"--from", "source"}, "source"));
  expect(64, "CASE is required, or --from", start({}, "new"));
  expect(66, "no such file or folder", start({"--from", "nowhere"}, "new"));
  test::write_all(folder_ / "foreign.h5", "no HDF5");
  expect(74, "foreign.h5", start({"--from", "foreign.h5"}, "new"));
  std::string bytes = read_all(folder_ / "source/end_state.h5");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::write_all(folder_ / "damaged.h5", bytes);
  expect(74, "damaged.h5", start({"--from", "damaged.h5"}, "new"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new"));
  // Without a folder, its name tells the change.
  ASSERT_EQ(run({"run", "--from", "source", "--no-report", "--set", "shear.displacement=0.51 mm"}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "runs/tiny-displacement-0.51mm/summary.json"));
  std::filesystem::remove(folder_ / "source/end_state.h5");
  expect(66, "its end_state.h5 is not there", start({"--from", "source"}, "new"));
  expect(64, "that started anew",
         start({"--from", "runs/tiny-displacement-0.51mm"}, "source", {"shear.displacement=0.5 mm"}));
}

TEST(BranchRules, EveryKeyOfACaseHasOne) {
  DirectShearCase test;
  std::set<std::string_view> used;
  for (const Key& key : case_schema(test).keys) {
    const BranchRule& rule = branch_rule_of(key.path());
    used.insert(rule.key);
    EXPECT_TRUE(!rule.reason.empty() || rule.stages == 63U) << key.path();
  }
  EXPECT_EQ(used.size(), 35U) << "a rule that fits no key is a mistake";
}

// ---- states inside the process, at every point of every stage

DirectShearCase small_case() {
  DirectShearCase test = test::tiny_shear_case(0.3, 0.020, 0.018);
  test.shear.displacement = 0.3e-3;
  test.equilibrium.plate_speed = 5e-3;
  test.equilibrium.stress_tolerance = 0.05;
  test.equilibrium.hold_steps = 200;
  return test;
}

struct Interruption {};

/// Keeps the state at the n-th offer of a checkpoint in a stage, and stops there.
struct Interrupter : LabObserver {
  std::string wanted_stage;
  int offers_left = -1;  ///< never stops when negative
  std::string stage;
  std::optional<StateArchive> state;
  int offers = 0;

  void progress(const Progress& now) override { stage = now.stage; }
  bool wants_checkpoint(bool /*is_new_stage*/) override {
    if (stage != wanted_stage) return false;
    ++offers;
    return offers_left >= 0 && offers_left-- == 0;
  }
  void checkpoint(const StateArchive& archive) override {
    state.emplace(archive.entries());
    throw Interruption{};
  }
};

StateArchive state_in(const DirectShearCase& test, const std::string& stage, int offer, StateArchive* from = nullptr) {
  Interrupter interrupter;
  interrupter.wanted_stage = stage;
  interrupter.offers_left = offer;
  EXPECT_THROW(run_direct_shear(test, interrupter, from), Interruption) << stage;
  return std::move(interrupter.state.value());
}

StateArchive branch(StateArchive& state, const DirectShearCase& from, const DirectShearCase& to) {
  const BranchPoint point = branch_point_of(state, from);
  EXPECT_EQ(branch_problem(point, from, to, "state"), "");
  return branched_state(state, point, from, to);
}

TEST(BranchedState, FromAnyStageTheSpecimenComesUnderTheNewStress) {
  const DirectShearCase from = small_case();
  DirectShearCase to = from;
  to.shear.normal_stress = 90e3;
  to.shear.velocity = 0.02;
  for (const char* stage : {"compression", "final friction", "shear"}) {
    StateArchive state = state_in(from, stage, 1);
    StateArchive start = branch(state, from, to);
    LabObserver silent;
    const DirectShearResult result = run_direct_shear(to, silent, &start);
    EXPECT_NEAR(result.normal_stress_mean / 90e3, 1.0, 0.02) << stage;
    EXPECT_LT(result.normal_stress_max_error, 0.1) << stage;
    EXPECT_EQ(result.rows.size(), 30U) << stage;
    EXPECT_EQ(result.rows_before > 0, std::string(stage) == "shear");
  }
}

TEST(BranchedState, StoppedWhileItConsolidatesOrShearsItKeepsItsBits) {
  const DirectShearCase from = small_case();
  DirectShearCase to = from;
  to.shear.normal_stress = 120e3;
  to.recording.frame_interval = 0.05e-3;
  StateArchive state = state_in(from, "shear", 0);
  StateArchive straight_start = branch(state, from, to);
  Interrupter straight;
  straight.wanted_stage = "consolidation";
  const DirectShearResult expected = run_direct_shear(to, straight, &straight_start);
  ASSERT_GT(straight.offers, 3);
  for (const auto& [stage, offer] : {std::pair{"consolidation", 1}, std::pair{"consolidation", straight.offers - 1},
                                     std::pair{"shear", 0}, std::pair{"shear", 1}}) {
    StateArchive start = branch(state, from, to);
    StateArchive stopped = state_in(to, stage, offer, &start);
    LabObserver silent;
    const DirectShearResult resumed = run_direct_shear(to, silent, &stopped);
    EXPECT_EQ(resumed.state_hash, expected.state_hash) << stage << " " << offer;
    ASSERT_EQ(resumed.rows.size(), expected.rows.size());
    for (std::size_t k = 0; k < expected.rows.size(); ++k) {
      EXPECT_EQ(resumed.rows[k].shear_stress, expected.rows[k].shear_stress) << "row " << k;
      EXPECT_EQ(resumed.rows[k].energy.boundary_work, expected.rows[k].energy.boundary_work) << "row " << k;
    }
    EXPECT_EQ(resumed.curve.peak_stress, expected.curve.peak_stress);
  }
}

/// Hears where states and rows are recorded.
struct Recorder : LabObserver {
  std::vector<double> frames, rows;
  std::optional<StateArchive> end;
  bool wants_end_state() override { return true; }
  void end_state(const StateArchive& state) override { end.emplace(state.entries()); }
  void frame(const Simulation& /*state*/, const FrameInfo& info) override { frames.push_back(info.displacement); }
  void shear_row(const ShearRow& row) override { rows.push_back(row.displacement); }
};

TEST(BranchedState, AnotherRecordKeepsTheMotionAndTakesItsOwnMarks) {
  const DirectShearCase from = small_case();
  LabObserver silent;
  const DirectShearResult straight = run_direct_shear(from, silent);
  DirectShearCase to = from;
  to.recording.interval = 0.02e-3;
  to.recording.frame_interval = 0.06e-3;
  to.recording.extra_frames = {0.15e-3};
  StateArchive state = state_in(from, "shear", 1);
  const double reached = branch_point_of(state, from).displacement;
  StateArchive start = branch(state, from, to);
  Recorder heard;
  const DirectShearResult result = run_direct_shear(to, heard, &start);
  EXPECT_EQ(result.state_hash, straight.state_hash) << "what is written does not move a grain";
  std::vector<double> wanted;
  for (const double mark : {0.06e-3, 0.12e-3, 0.15e-3, 0.18e-3, 0.24e-3, 0.3e-3}) {
    if (mark > reached) wanted.push_back(mark);
  }
  ASSERT_EQ(heard.frames.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(heard.frames[k], wanted[k], 0.011e-3);
  for (const double row : heard.rows) EXPECT_NEAR(row, 0.02e-3 * std::round(row / 0.02e-3), 1e-6);
}

TEST(BranchedState, AnotherVelocityIsTakenUpFromTheSameState) {
  const DirectShearCase from = small_case();
  DirectShearCase to = from;
  to.shear.velocity = 0.01;
  StateArchive state = state_in(from, "shear", 1);
  const BranchPoint point = branch_point_of(state, from);
  EXPECT_DOUBLE_EQ(point.halves_velocity, 0.05);
  StateArchive start = branch(state, from, to);
  const BranchPoint begun = branch_point_of(start, to);
  EXPECT_EQ(begun.state_hash, point.state_hash);
  EXPECT_EQ(begun.displacement, point.displacement);
  Recorder heard;
  const DirectShearResult result = run_direct_shear(to, heard, &start);
  EXPECT_EQ(result.displacement_before, point.displacement);
  EXPECT_LT(result.inertial_number_max, 0.25 * result.rows.front().inertial_number)
      << "that of the old part is not in it";
  StateArchive end = std::move(heard.end.value());
  EXPECT_DOUBLE_EQ(branch_point_of(end, to).halves_velocity, 0.01);
}

}  // namespace
}  // namespace dem
