// SPDX-License-Identifier: BSD-3-Clause
// When checkpoints are written into the folder of a run, and what a run makes of a folder whose last one was killed: a
// checkpoint from some moment, rows and states from a later one. The straight run says what must come out.
// Not tested here: a kill in the middle of writing results.h5.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <functional>
#include <map>

#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "dem4grm/runs/run_case.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

using test::read_all;
using test::RunningProgram;

constexpr double k_never = 1e9;  // s

/// The bits of every number in a file of results by the path of its dataset (a missing value is "not a number", which
/// equals nothing), and the hashes of its states.
struct Content {
  std::map<std::string, std::vector<std::uint64_t>> numbers;
  std::map<std::string, std::string> hashes;
};

herr_t collect_numbers(hid_t root, const char* name, const H5O_info_t* info, void* names) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hdf5::Handle dataset(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose, name);
  const hdf5::Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
  if (H5Tget_class(type.id()) != H5T_STRING) static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

Content content_of(const std::filesystem::path& path) {
  Content out;
  for (const StoredFrame& f : read_outline(path).frames) out.hashes[f.name] = f.state_hash;
  const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
  std::vector<std::string> names;
  EXPECT_GE(H5Ovisit(file.id(), H5_INDEX_NAME, H5_ITER_INC, collect_numbers, &names), 0);
  for (const std::string& name : names) {
    for (const double v : hdf5::read_dataset(file, name)) out.numbers[name].push_back(std::bit_cast<std::uint64_t>(v));
  }
  return out;
}

/// Calls with the number of each state that was stored.
struct FrameListener : LabObserver {
  std::function<void(int number)> act;
  void frame(const Simulation& /*state*/, const FrameInfo& info) override { act(info.number); }
};

class KilledRun : public test::CommandLine {
 protected:
  RunOutcome run_here(const std::string& folder, const RunLinks& links) const {
    return run_case(loaded_, {folder_ / folder, 1, links});
  }
  /// Lines of the log about checkpoints.
  [[nodiscard]] int checkpoints(const std::string& folder) const {
    const std::string log = read_all(folder_ / folder / "run.log"), mark = "checkpoint, written in";
    int count = 0;
    for (std::size_t at = 0; (at = log.find(mark, at)) != std::string::npos; at += mark.size()) ++count;
    return count;
  }
  void expect_same_results(const std::string& folder, const std::string& straight) const {
    EXPECT_EQ(text_in(json(folder + "/summary.json"), "state_hash"),
              text_in(json(straight + "/summary.json"), "state_hash"));
    for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "specimen.h5"}) {
      EXPECT_TRUE(read_all(folder_ / folder / file) == read_all(folder_ / straight / file)) << file;
    }
    const Content got = content_of(folder_ / folder / "results.h5");
    const Content expected = content_of(folder_ / straight / "results.h5");
    EXPECT_EQ(got.hashes, expected.hashes);
    EXPECT_GT(expected.numbers.size(), 100U);
    EXPECT_TRUE(got.numbers == expected.numbers) << "datasets of results.h5";
    EXPECT_FALSE(std::filesystem::exists(folder_ / folder / "checkpoint.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / folder / "checkpoint.previous.h5"));
  }
  /// Stops a run after it stored its third state; it kept a checkpoint at every chance.
  void stop_in_shear(const std::string& folder) const {
    volatile std::sig_atomic_t stop = 0;
    FrameListener listener;
    listener.act = [&](int number) { stop = number > 1 ? 1 : 0; };
    EXPECT_THROW(run_here(folder, {&listener, &stop, 0.0}), StoppedOnRequest);
  }

  /// Five states: at 0, 0.25, ... 1 mm.
  LoadedCase loaded_ = parse_case(
      test::k_tiny_case, folder_ / "tiny.toml",
      std::vector<Override>{
          {"shear.velocity", "100 mm/s"}, {"recording.frame_interval", "0.25 mm"}, {"recording.extra_frames", "[]"}});
};

/// Counts the points from which the test could go on.
struct OfferCounter : LabObserver {
  int offers = 0;
  bool wants_checkpoint(bool /*is_new_stage*/) override {
    ++offers;
    return false;
  }
};

TEST_F(KilledRun, IntervalDecidesHowOftenACheckpointIsWritten) {
  OfferCounter counter;
  run_direct_shear(std::get<DirectShearCase>(loaded_.test), counter);
  run_here("never", {nullptr, nullptr, k_never});
  EXPECT_EQ(checkpoints("never"), 3) << "after the fill, the compression and the final friction";
  run_here("always", {nullptr, nullptr, 0.0});
  EXPECT_EQ(checkpoints("always"), counter.offers);
  EXPECT_GT(counter.offers, 30);

  const double interval = 0.05;  // s
  const auto begin = std::chrono::steady_clock::now();
  run_here("sometimes", {nullptr, nullptr, interval});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_GT(checkpoints("sometimes"), 3) << "in " << seconds << " s";
  EXPECT_LE(checkpoints("sometimes"), 3 + static_cast<int>(seconds / interval)) << "in " << seconds << " s";

  for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "results.h5", "specimen.h5"}) {
    EXPECT_TRUE(read_all(folder_ / "always" / file) == read_all(folder_ / "never" / file)) << file;
    EXPECT_TRUE(read_all(folder_ / "sometimes" / file) == read_all(folder_ / "never" / file)) << file;
  }
}

TEST_F(KilledRun, IntervalOfARunThatGoesOnBeginsAnew) {
  volatile std::sig_atomic_t stop = 0;
  FrameListener listener;
  listener.act = [&](int number) { stop = number > 0 ? 1 : 0; };
  EXPECT_THROW(run_here("out", {&listener, &stop, k_never}), StoppedOnRequest);
  StoredCheckpoint stored = read_checkpoint(folder_ / "out/checkpoint.h5");
  stored.facts.wall_time = 10.0 * k_never;  // as if the first part had taken ages
  write_checkpoint(folder_ / "out/checkpoint.h5", stored.state, stored.facts);
  const int before = checkpoints("out");
  run_here("out", {nullptr, nullptr, k_never});
  EXPECT_EQ(checkpoints("out"), before);
}

/// One bit in the middle of a file.
void flip_a_bit(const std::filesystem::path& path) {
  std::string bytes = read_all(path);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  test::write_all(path, bytes);
}

TEST_F(KilledRun, ADamagedCheckpointCostsOneIntervalAndIsTold) {
  run_here("straight", {nullptr, nullptr, k_never});
  stop_in_shear("out");
  flip_a_bit(folder_ / "out/checkpoint.h5");
  run_here("out", {nullptr, nullptr, k_never});
  expect_same_results("out", "straight");
  const JsonObject summary = json("out/summary.json");
  const auto& warnings = std::get<JsonList>(find_field(summary, "warnings")->data);
  const bool is_told = std::any_of(warnings.begin(), warnings.end(), [](const JsonValue& w) {
    const std::string& text = std::get<std::string>(w.data);
    return text.find("checkpoint.h5: is damaged") != std::string::npos &&
           text.find("goes on from the one before it") != std::string::npos;
  });
  EXPECT_TRUE(is_told);
}

TEST_F(KilledRun, BothCheckpointsDamagedOrNoStatesIsToldWithTheWayOut) {
  stop_in_shear("out");
  std::filesystem::copy(folder_ / "out", folder_ / "no_states");
  const auto refusal = [&](const std::string& folder) -> std::string {
    try {
      run_here(folder, {nullptr, nullptr, k_never});
    } catch (const IoError& e) {
      return e.what();
    }
    return "went on";
  };
  for (const char* file : {"out/checkpoint.h5", "out/checkpoint.previous.h5"}) flip_a_bit(folder_ / file);
  const std::string damaged = refusal("out");
  for (const char* part : {"checkpoint.h5: is damaged", "checkpoint.previous.h5: is damaged",
                           "remove checkpoint.h5 and checkpoint.previous.h5 to start the run anew"}) {
    EXPECT_NE(damaged.find(part), std::string::npos) << damaged;
  }
  std::filesystem::remove(folder_ / "no_states/results.h5");
  const std::string without = refusal("no_states");
  for (const char* part : {"results.h5", "put the file back, or remove checkpoint.h5 and checkpoint.previous.h5"}) {
    EXPECT_NE(without.find(part), std::string::npos) << without;
  }
  // The way out is one.
  for (const char* file : {"no_states/checkpoint.h5", "no_states/checkpoint.previous.h5"}) {
    std::filesystem::remove(folder_ / file);
  }
  run_here("straight", {nullptr, nullptr, k_never});
  run_here("no_states", {nullptr, nullptr, k_never});
  expect_same_results("no_states", "straight");
}

/// What a kill leaves: everything but the lock, with the checkpoint of this or of an earlier moment.
void copy_as_killed(const std::filesystem::path& from, const std::filesystem::path& to,
                    const std::filesystem::path& checkpoint) {
  std::filesystem::copy(from, to);
  std::filesystem::copy_file(checkpoint, to / "checkpoint.h5", std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(to / "run.lock");
  std::filesystem::remove(to / "summary.json");
}

TEST_F(KilledRun, StatesLaterThanTheCheckpointAreMadeAgain) {
  const auto killed = [](int number) { return "killed" + std::to_string(number); };
  const std::filesystem::path straight = folder_ / "straight", early = folder_ / "early.h5";
  FrameListener listener;
  listener.act = [&](int number) {
    // The last checkpoint is from before this state was stored; from state 3 on an older one takes its place.
    if (number == 2) std::filesystem::copy_file(straight / "checkpoint.h5", early);
    copy_as_killed(straight, folder_ / killed(number), number < 3 ? straight / "checkpoint.h5" : early);
  };
  run_here("straight", {&listener, nullptr, 0.0});
  copy_as_killed(straight, folder_ / killed(5), early);  // the record was added, the summary not yet written
  for (int number = 0; number <= 5; ++number) {
    SCOPED_TRACE(killed(number));
    const StoredResults left = read_outline(folder_ / killed(number) / "results.h5");
    EXPECT_EQ(left.frames.size(), static_cast<std::size_t>(std::min(number, 4)) + 1);
    EXPECT_EQ(left.table_rows > 0, number == 5);
    const bool is_in_shear = read_checkpoint(folder_ / killed(number) / "checkpoint.h5").state.has_group("shear");
    EXPECT_EQ(is_in_shear, number > 0) << "the first state is stored before the first checkpoint of the shear stage";
    run_here(killed(number), {nullptr, nullptr, k_never});
    expect_same_results(killed(number), "straight");
  }
}

TEST_F(KilledRun, ProgramThatWasKilledEndsWithTheSameResults) {
  const auto command = [&](const std::string& folder) {
    return words({"run", "tiny.toml", "-o", folder, "-j", "1", "--set", "shear.velocity=50 mm/s", "--set",
                  "recording.frame_interval=0.1 mm"});
  };
  {
    RunningProgram program(command("killed"), folder_.path());
    const auto has_state = [&] { return read_all(folder_ / "killed/run.log").find("state 2 at") != std::string::npos; };
    for (int k = 0; k < 3000 && !has_state(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    program.send(SIGKILL);
    ASSERT_EQ(program.wait().signal, SIGKILL) << "it was over before";
  }
  EXPECT_GE(read_outline(folder_ / "killed/results.h5").frames.size(), 3U);
  const test::ProgramResult next = test::run_program(command("killed"), folder_.path());
  EXPECT_EQ(next.exit_code, 0) << next.err;
  EXPECT_NE(next.err.find("goes on from the checkpoint"), std::string::npos) << next.err;
  EXPECT_EQ(test::run_program(command("straight"), folder_.path()).exit_code, 0);
  expect_same_results("killed", "straight");
}

}  // namespace
}  // namespace dem
