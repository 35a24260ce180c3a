// SPDX-License-Identifier: BSD-3-Clause
// The choice of the processor target by the environment, through the program.
#include <algorithm>

#include "dem4grm/engine/kernel_target.hpp"
#include "support/command_line.hpp"

namespace {

using namespace dem;
using test::CommandLine;
using test::ProgramResult;
using test::read_all;

class ProcessorTarget : public CommandLine {
 protected:
  [[nodiscard]] ProgramResult run_with(const std::string& target, std::vector<std::string> arguments) const {
    std::vector<std::string> all{"/usr/bin/env", "DEM4GRM_TARGET=" + target};
    for (std::string& word : words(std::move(arguments))) all.push_back(std::move(word));
    return test::run_program(all, folder_.path());
  }
};

TEST_F(ProcessorTarget, AWholeTestEndsWithTheSameHashForEveryTarget) {
  std::string expected;
  for (const std::string_view name : usable_kernel_targets()) {
    const std::string target(name), folder = "with-" + target;
    const ProgramResult result = run_with(target, {"run", "tiny.toml", "-q", "-j", "1", "-o", folder});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string log = read_all(folder_ / (folder + "/run.log"));
    EXPECT_NE(log.find("processors of target " + target), std::string::npos) << log;
    const std::string summary = read_all(folder_ / (folder + "/summary.json"));
    EXPECT_NE(summary.find("\"processor_target\": \"" + target + "\""), std::string::npos) << summary;
    const std::size_t at = summary.find("\"state_hash\": \"");
    ASSERT_NE(at, std::string::npos);
    const std::string hash = summary.substr(at, 50);
    if (expected.empty()) expected = hash;
    EXPECT_EQ(hash, expected) << target;
  }
}

TEST_F(ProcessorTarget, TheVersionNamesTheOneInForce) {
  for (const std::string_view name : usable_kernel_targets()) {
    const ProgramResult result = run_with(std::string(name), {"--version"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.out.find("target   " + std::string(name)), std::string::npos) << result.out;
  }
}

TEST_F(ProcessorTarget, AnUnknownOneIsAUsageErrorThatNamesThoseToChooseFrom) {
  const ProgramResult result = run_with("v9", {"check", "tiny.toml"});
  EXPECT_EQ(result.exit_code, 64);
  for (const std::string_view part : {std::string_view("DEM4GRM_TARGET"), usable_kernel_targets().front()}) {
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
  }
}

}  // namespace
