// SPDX-License-Identifier: BSD-3-Clause
// A finished or stopped test that is run again with a larger displacement goes on from its end, and leaves the files of one that was
// longer from the beginning; where that cannot be, the folder stays as it is and the reason is told.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;

class Prolonged : public CommandLine {
 protected:
  [[nodiscard]] static std::vector<std::string> to(const std::string& displacement, const std::string& folder,
                                                   std::vector<std::string> more = {}) {
    std::vector<std::string> all{"run",
                                 "tiny.toml",
                                 "-o",
                                 folder,
                                 "-j",
                                 "1",
                                 "--no-report",
                                 "--set",
                                 "recording.micro_interval=0.1 mm",
                                 "--set",
                                 fmt::format("shear.displacement={}", displacement)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  void expect_same_test(const std::string& a, const std::string& b) const {
    for (const char* file : {"shear.csv", "micro.csv", "walls.csv", "profiles.csv", "resolved.toml"}) {
      EXPECT_EQ(read_all(folder_ / (a + "/" + file)), read_all(folder_ / (b + "/" + file))) << file;
    }
    const JsonObject first = json(a + "/summary.json"), second = json(b + "/summary.json");
    for (const char* field : {"state_hash", "case", "time_step_limited_by"}) {
      EXPECT_EQ(text_in(first, field), text_in(second, field));
    }
    for (const char* field :
         {"steps", "rows", "peak_shear_stress_kPa", "energy_closure_per_cent", "void_ratio_at_end"}) {
      EXPECT_EQ(number_in(first, field), number_in(second, field)) << field;
    }
    const std::string hashes = json_text(std::get<JsonList>(find_field(first, "state_hashes")->data));
    EXPECT_EQ(hashes, json_text(std::get<JsonList>(find_field(second, "state_hashes")->data)));
    const ProgramResult info = run({"info", a});
    EXPECT_EQ(info.exit_code, 0) << info.err;
  }
};

TEST_F(Prolonged, AFinishedTestGoesOnWithTheBitsOfALongerOne) {
  ASSERT_EQ(run(to("1.5 mm", "straight")).exit_code, 0);
  ASSERT_EQ(run(to("0.5 mm", "out")).exit_code, 0);
  const ProgramResult longer = run(to("1 mm", "out"));
  ASSERT_EQ(longer.exit_code, 0) << longer.err;
  EXPECT_NE(longer.err.find("prolongs the test that the folder holds; goes on from the checkpoint"), std::string::npos)
      << longer.err;
  ASSERT_EQ(run(to("1.5 mm", "out")).exit_code, 0);
  expect_same_test("straight", "out");
  EXPECT_NE(run(to("1.5 mm", "out")).out.find("nothing was computed"), std::string::npos);
}

TEST_F(Prolonged, AStoppedOneGoesOnToTheNewEnd) {
  ASSERT_EQ(run(to("1.5 mm", "straight")).exit_code, 0);
  test::RunningProgram job(words(to("1 mm", "out", {"--set", "shear.velocity=200 mm/s"})), folder_.path());
  ASSERT_TRUE(test::wait_for_file(folder_ / "out/specimen.h5", 60.0));
  job.send(SIGTERM);
  ASSERT_EQ(job.wait().exit_code, 75);
  ASSERT_EQ(run(to("1.5 mm", "out")).exit_code, 0);
  expect_same_test("straight", "out");
}

TEST_F(Prolonged, WhatCannotBeProlongedIsLeftAsItIs) {
  ASSERT_EQ(run(to("0.505 mm", "odd")).exit_code, 0);
  const std::string before = read_all(folder_ / "odd/summary.json");
  expect(64, "0.505 mm, which is no multiple of recording.interval", to("1 mm", "odd"));
  expect(64, "shear.displacement", to("0.3 mm", "odd"));  // shorter: another case, as before
  expect(64, "velocity", to("1 mm", "odd", {"--set", "shear.velocity=100 mm/s"}));
  EXPECT_EQ(read_all(folder_ / "odd/summary.json"), before);
  ASSERT_EQ(run(to("0.5 mm", "bare")).exit_code, 0);
  std::filesystem::remove(folder_ / "bare/end_state.h5");
  expect(64, "It cannot be prolonged, since its end_state.h5 is not there", to("1 mm", "bare"));
}

}  // namespace
}  // namespace dem
