// SPDX-License-Identifier: BSD-3-Clause
// A run on a disk of a given size, real and full: what it says, what it leaves, and that it goes on elsewhere to the same state.
//
// The disk is a tmpfs in a mount namespace of its own, so neither root nor a real disk is needed; where the system
// grants no such namespace the test is skipped. DEM4GRM_DISK_SIZES in the environment: how many sizes, 8 by default.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>

#include "dem4grm/results/output_file.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

using test::ProgramResult;
using test::read_all;

class FullDisk : public test::CommandLine {
 protected:
  static constexpr const char* k_run = "run tiny.toml -j 1 -q --set 'shear.displacement=0.3 mm'";

  [[nodiscard]] ProgramResult shell(const std::string& script) const {
    return test::run_program({"/bin/sh", "-c", script}, folder_.path());
  }
  /// The exit code of a run on a disk of so many kB; what it left is copied to a folder of that name.
  [[nodiscard]] ProgramResult run_on_disk(int kilobytes, const std::string& name) const {
    return shell(fmt::format(
        "unshare -rm sh -c 'mkdir -p disk && mount -t tmpfs -o size={}k none disk && {{ {} {} -o disk/out; code=$?; "
        "cp -r disk/out {}; exit $code; }}'",
        kilobytes, DEM_PROGRAM, "run tiny.toml -j 1 -q --set \"shear.displacement=0.3 mm\"", name));
  }
  [[nodiscard]] int kilobytes_of(const std::string& name) const {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / name)) {
      if (entry.is_regular_file()) bytes += entry.file_size();
    }
    return static_cast<int>(bytes / 1024);
  }
  [[nodiscard]] int drafts_in(const std::string& name) const {
    int drafts = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / name)) {
      const std::string file = entry.path().filename().string();
      drafts += file.ends_with(".tmp") || file.ends_with(".part") ? 1 : 0;
    }
    return drafts;
  }
};

TEST_F(FullDisk, OfAnySizeLosesNothingThatWasWritten) {
  if (shell("unshare -rm sh -c 'mkdir -p disk && mount -t tmpfs -o size=64k none disk'").exit_code != 0) {
    GTEST_SKIP() << "no mount namespaces here";
  }
  ASSERT_EQ(shell(fmt::format("{} {} -o straight", DEM_PROGRAM, k_run)).exit_code, 0);
  const std::string expected = text_in(json("straight/summary.json"), "state_hash");
  const char* wanted = std::getenv("DEM4GRM_DISK_SIZES");
  const int sizes = wanted != nullptr ? std::atoi(wanted) : 8;
  const int enough = 2 * kilobytes_of("straight");  // checkpoints lie beside the results until the end
  int full = 0, with_checkpoint = 0;
  for (int k = 1; k <= sizes; ++k) {
    const std::string name = fmt::format("size{}", k);
    const int kilobytes = enough * k / sizes;
    const ProgramResult result = run_on_disk(kilobytes, name);
    if (result.exit_code == 0) {
      EXPECT_EQ(text_in(json(name + "/summary.json"), "state_hash"), expected) << kilobytes << " kB";
      continue;
    }
    ++full;
    EXPECT_EQ(result.exit_code, 74) << kilobytes << " kB: " << result.err;
    EXPECT_NE(result.err.find("No space left on device"), std::string::npos) << result.err;
    EXPECT_EQ(drafts_in(name), 0) << kilobytes << " kB";
    const std::string status = read_all(folder_ / name / "status.json");
    if (!status.empty()) {
      EXPECT_EQ(text_in(json(name + "/status.json"), "state"), "failed") << kilobytes << " kB: " << status;
    }
    with_checkpoint += std::filesystem::exists(folder_ / name / "checkpoint.h5") ? 1 : 0;
    const ProgramResult again = shell(fmt::format("{} {} -o {}", DEM_PROGRAM, k_run, name));
    EXPECT_EQ(again.exit_code, 0) << kilobytes << " kB: " << again.err;
    EXPECT_EQ(text_in(json(name + "/summary.json"), "state_hash"), expected) << kilobytes << " kB";
  }
  EXPECT_GT(full, sizes / 4);
  EXPECT_GT(with_checkpoint, 0);
}

}  // namespace
}  // namespace dem
