// SPDX-License-Identifier: BSD-3-Clause
// A checkpoint while every system call of its writer fails, or kills the process, in turn: a whole one is always left.
#include <gtest/gtest.h>

#include <filesystem>

#include "dem4grm/core/error.hpp"
#include "dem4grm/runs/checkpoint_file.hpp"
#include "fault/failing_calls.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using test::Fault;
using test::FaultEnd;

class CheckpointFault : public ::testing::Test {
 protected:
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "checkpoint.h5";
  std::filesystem::path older_ = folder_.path() / "checkpoint.previous.h5";

  /// The checkpoint of a generation; its number stands in its wall time and in its state.
  void write(double generation) const {
    StateArchive state;
    std::vector<double> numbers(20000, generation);
    state.exchange("numbers", numbers);
    write_checkpoint(path_, state, {"case", generation, {}}, older_);
  }

  /// The generation that a run would go on from.
  [[nodiscard]] double newest() const {
    std::optional<NewestCheckpoint> found = read_newest_checkpoint(path_, older_);
    if (!found) return 0.0;
    std::vector<double> numbers;
    found->stored.state.exchange("numbers", numbers);
    EXPECT_EQ(numbers, std::vector<double>(20000, found->stored.facts.wall_time));
    return found->stored.facts.wall_time;
  }

  void clean() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) std::filesystem::remove(entry.path());
  }
};

TEST_F(CheckpointFault, WhateverCallIsHitAWholeGenerationIsLeft) {
  for (const Fault fault : {Fault::kill, Fault::error, Fault::full_disk}) {
    int calls = 0, kept_old = 0;
    for (int at = 1;; ++at) {
      clean();
      write(1.0);
      write(2.0);
      const FaultEnd end = test::run_with_fault(fault, at, [&] { write(3.0); });
      const double found = newest();
      if (!end.was_due) {
        EXPECT_EQ(end.exit_code, 0);
        EXPECT_EQ(found, 3.0);
        break;
      }
      ++calls;
      kept_old += found == 2.0 ? 1 : 0;
      EXPECT_TRUE(found == 2.0 || found == 3.0) << "call " << at << " left generation " << found;
      EXPECT_EQ(end.was_killed, fault == Fault::kill);
      EXPECT_TRUE(end.exit_code != 0 || found == 3.0) << "call " << at << " was hit, and nobody was told";
      if (fault != Fault::kill && end.exit_code != 0) {
        EXPECT_EQ(end.exit_code, static_cast<int>(ExitCode::io)) << at;
        EXPECT_FALSE(std::filesystem::exists(path_.string() + ".tmp")) << "call " << at;
      }
      write(4.0);  // whatever was left lying about
      EXPECT_EQ(newest(), 4.0);
    }
    EXPECT_GT(calls, 10) << "the writer's calls were not seen";
    EXPECT_GT(kept_old, 5);
  }
}

TEST_F(CheckpointFault, IsOnTheDiskBeforeItGetsItsName) {
  write(1.0);
  write(2.0);
  const std::string calls = test::run_with_fault(Fault::kill, 1 << 30, [&] { write(3.0); }).calls;
  const std::size_t last_write = calls.rfind("write"), first_rename = calls.find("rename "),
                    last_rename = calls.rfind("rename ");
  ASSERT_NE(first_rename, std::string::npos) << calls;
  EXPECT_LT(first_rename, last_rename) << "the older name, then the newer";
  EXPECT_LT(last_write, first_rename);
  const std::size_t synced = calls.find("fsync ", last_write);
  EXPECT_LT(synced, first_rename) << "what a power cut would leave under the name: " << calls.substr(last_write);
  EXPECT_NE(calls.find("fsync ", last_rename), std::string::npos)
      << "the names themselves: " << calls.substr(last_write);
}

TEST_F(CheckpointFault, ADamagedNewestOneDoesNotReplaceTheWholeOneBeforeIt) {
  for (int at = 1;; ++at) {
    clean();
    write(1.0);
    write(2.0);
    std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
    const FaultEnd end = test::run_with_fault(Fault::kill, at, [&] { write(3.0); });
    const double found = newest();
    EXPECT_TRUE(found == 1.0 || found == 3.0) << "call " << at << " left generation " << found;
    if (!end.was_due) {
      EXPECT_EQ(found, 3.0);
      break;
    }
  }
}

TEST_F(CheckpointFault, TheFirstCheckpointOfARunIsWholeOrNotThere) {
  for (int at = 1;; ++at) {
    clean();
    const FaultEnd end = test::run_with_fault(Fault::kill, at, [&] { write(1.0); });
    if (!end.was_due) break;
    const double found = newest();
    EXPECT_TRUE(found == 0.0 || found == 1.0) << at;
  }
}

}  // namespace
}  // namespace dem
