// SPDX-License-Identifier: BSD-3-Clause
// profiles.csv, the shear band of summary.json and dem4grm profile: one set of numbers, whichever way it is asked for.
#include <gtest/gtest.h>

#include <sstream>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;
using test::read_all;

class ProfileCommand : public CommandLine {};

/// Rows of a CSV file of numbers without its header.
std::vector<std::vector<std::string>> rows_of_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  std::string line, field;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream fields(line);
    while (std::getline(fields, field, ',')) rows.back().push_back(field);
  }
  return rows;
}

TEST_F(ProfileCommand, TellsWhatTheRunWrote) {
  ASSERT_EQ(run({"run", "tiny.toml", "-o", "out", "-q"}).exit_code, 0);
  const std::string csv = read_all(folder_ / "out/profiles.csv");
  const auto rows = rows_of_csv(csv);
  ASSERT_EQ(rows.size() % 4, 0U) << "states of a low box have four layers or more, all the same number";
  EXPECT_EQ(std::stod(rows.front()[4]), 0.0) << "nothing has moved before shear";
  // The lowest layer of the last state moved with the lower half, the uppermost stayed.
  const std::size_t layers = rows.size() / 4;  // states at 0, 0.2, 0.5, 1 mm
  EXPECT_NEAR(std::stod(rows.back()[0]), 1.0, 0.01);
  EXPECT_GT(std::stod(rows[rows.size() - layers][4]), 0.7);
  EXPECT_LT(std::stod(rows.back()[4]), 0.3);
  double grains = 0.0;
  for (std::size_t k = rows.size() - layers; k < rows.size(); ++k) grains += std::stod(rows[k][3]);
  const JsonObject summary = json("out/summary.json");
  EXPECT_EQ(grains, number_in(summary, "clumps") + number_in(summary, "rubber_grains"));

  const auto& bands = std::get<JsonList>(find_field(summary, "shear_band")->data);
  ASSERT_EQ(bands.size(), 4U);
  const auto& first = std::get<JsonObject>(bands.front().data);
  const auto& last = std::get<JsonObject>(bands.back().data);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(find_field(first, "thickness_mm")->data))
      << "no band before shear";
  EXPECT_NEAR(number_in(last, "displacement_mm"), 1.0, 0.01);
  EXPECT_GT(number_in(last, "thickness_mm"), 0.0);

  // Asked for later, from results.h5: the same bytes, and other layers when they are wanted.
  const ProgramResult table = run({"profile", "out", "--csv", "again.csv"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(read_all(folder_ / "again.csv"), csv);
  EXPECT_NE(table.out.find("state at 1.000 mm"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("shear band"), std::string::npos) << table.out;
  EXPECT_NE(run({"profile", "out", "--at", "0 mm"}).out.find("no shear band"), std::string::npos);
  const ProgramResult fine = run({"profile", "out/results.h5", "--layers", "9", "--json"});
  const JsonObject answer = parse_json(fine.out, "profile --json");
  const auto& states = std::get<JsonList>(find_field(answer, "states")->data);
  ASSERT_EQ(states.size(), 4U);
  const auto& state = std::get<JsonObject>(states.back().data);
  EXPECT_EQ(std::get<JsonList>(find_field(state, "void_ratio")->data).size(), 9U);

  const ProgramResult picture = test::run_program(
      {"/usr/bin/python3", std::string(DEM_SOURCE_DIR) + "/tools/plot_profiles.py", "out"}, folder_.path());
  EXPECT_EQ(picture.exit_code, 0) << picture.err;
  EXPECT_GT(std::filesystem::file_size(folder_ / "out/profiles.png"), 10000U);

  EXPECT_EQ(run({"profile", "absent"}).exit_code, 66);
  EXPECT_EQ(run({"profile", "tiny.toml"}).exit_code, 74);
  EXPECT_EQ(run({"profile", "out", "--at", "7"}).exit_code, 64);
  EXPECT_EQ(run({"profile", "out", "--layers", "0"}).exit_code, 64);
}

}  // namespace
}  // namespace dem
