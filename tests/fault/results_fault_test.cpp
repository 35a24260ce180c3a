// SPDX-License-Identifier: BSD-3-Clause
// A file of results while every system call of an addition fails, or kills the process, in turn: it holds the states before the addition
// or those and the new one, and fits its seal.
#include <gtest/gtest.h>

#include <filesystem>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/results_file.hpp"
#include "fault/failing_calls.hpp"
#include "support/mixture_scene.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

using test::Fault;
using test::FaultEnd;

class ResultsFault : public ::testing::Test {
 protected:
  ResultsFault() {
    test::MixtureOptions few;
    few.cells = {3, 3, 2};
    state_.emplace(test::run_mixture(few, 300));
    ResultsFile file(two_states_, k_origin);
    for (const int number : {0, 1}) file.add_frame(*state_, {number, 1e-3 * number, state_->state_hash()});
  }

  /// The third state, as a run that goes on adds it.
  void add_third() const {
    const std::vector<FrameInfo> kept{{0, 0.0, state_->state_hash()}, {1, 1e-3, state_->state_hash()}};
    ResultsFile(path_, k_origin, kept).add_frame(*state_, {2, 2e-3, state_->state_hash()});
  }

  [[nodiscard]] std::size_t whole_states() const {
    return hdf5::names_in(hdf5::open_group(open_results(path_), "frames")).size();
  }

  void start_anew() const {
    std::filesystem::remove(path_.string() + ".tmp");
    std::filesystem::copy_file(two_states_, path_, std::filesystem::copy_options::overwrite_existing);
  }

  const ResultsOrigin k_origin{"direct_shear", "small", "text", "toml"};
  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "results.h5", two_states_ = folder_.path() / "two.h5";
  std::optional<Simulation> state_;
};

TEST_F(ResultsFault, WhateverCallIsHitTheStatesBeforeItAreWhole) {
  for (const Fault fault : {Fault::kill, Fault::error, Fault::full_disk}) {
    int calls = 0, kept_old = 0;
    for (int at = 1;; ++at) {
      start_anew();
      const FaultEnd end = test::run_with_fault(fault, at, [&] { add_third(); });
      const std::size_t found = whole_states();
      if (!end.was_due) {
        EXPECT_EQ(end.exit_code, 0);
        EXPECT_EQ(found, 3U);
        break;
      }
      ++calls;
      kept_old += found == 2 ? 1 : 0;
      EXPECT_TRUE(found == 2 || found == 3) << "call " << at << " left " << found << " states";
      EXPECT_EQ(end.was_killed, fault == Fault::kill);
      EXPECT_TRUE(end.exit_code != 0 || found == 3) << "call " << at << " was hit, and nobody was told";
      if (fault != Fault::kill && end.exit_code != 0) {
        EXPECT_EQ(end.exit_code, static_cast<int>(ExitCode::io)) << at;
        EXPECT_FALSE(std::filesystem::exists(path_.string() + ".tmp")) << "call " << at;
      }
      if (found == 2) add_third();  // whatever was left lying about
      EXPECT_EQ(whole_states(), 3U);
    }
    EXPECT_GT(calls, 10) << "the writer's calls were not seen";
    EXPECT_GT(kept_old, 5);
  }
}

TEST_F(ResultsFault, ANewStateIsOnTheDiskBeforeTheFileGetsItsName) {
  start_anew();
  const std::string calls = test::run_with_fault(Fault::kill, 1 << 30, [&] { add_third(); }).calls;
  const std::size_t last_write = calls.rfind("write"), name = calls.rfind("rename ");
  ASSERT_NE(name, std::string::npos) << calls;
  ASSERT_LT(last_write, name) << calls;
  const std::size_t synced = calls.find("fsync ", last_write);
  EXPECT_LT(synced, name) << "what a power cut would leave under the name: " << calls.substr(last_write);
  EXPECT_NE(calls.find("fsync ", name), std::string::npos) << "the name itself: " << calls.substr(last_write);
}

}  // namespace
}  // namespace dem
