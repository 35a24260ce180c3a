// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/written_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "dem4grm/core/error.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

WrittenTable table_of(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "table.csv";
  std::ofstream(path, std::ios::binary) << text;
  return read_table(path);
}

TEST(WrittenTable, HasTheNumbersOfEachColumn) {
  const WrittenTable table = table_of("displacement_mm,kind,stress_kPa\n0.01,gravel,-3e2\n0.02,,nan\n");
  EXPECT_EQ(table.names, (std::vector<std::string>{"displacement_mm", "kind", "stress_kPa"}));
  EXPECT_EQ(table.columns[0], (std::vector<double>{0.01, 0.02}));
  EXPECT_TRUE(std::isnan(table.columns[1][0]) && std::isnan(table.columns[1][1]));
  EXPECT_EQ(table.columns[2][0], -300.0);
  EXPECT_TRUE(std::isnan(table.columns[2][1]));
  EXPECT_FALSE(table.is_cut);
}

TEST(WrittenTable, LeavesOutARowThatIsBeingWritten) {
  const WrittenTable table = table_of("a,b\n1,2\n3,");
  EXPECT_EQ(table.columns, (std::vector<std::vector<double>>{{1.0}, {2.0}}));
  EXPECT_TRUE(table.is_cut);
  EXPECT_TRUE(table_of("a,b").names.empty());
  EXPECT_TRUE(table_of("").names.empty());
  EXPECT_FALSE(table_of("").is_cut);
}

TEST(WrittenTable, NamesTheLineOfAnIncompleteRow) {
  try {
    table_of("a,b\n1,2\n3\n4,5\n");
    FAIL() << "a row of one cell was taken";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("table.csv:3: 1 cells in place of 2"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read_table("no-such-folder/table.csv"), IoError);
}

}  // namespace
}  // namespace dem
