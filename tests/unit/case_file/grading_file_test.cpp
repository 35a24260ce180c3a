// SPDX-License-Identifier: BSD-3-Clause
// Gradings from CSV: values, and every rule with its place.
#include "dem4grm/case_file/grading_file.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/specimen/grading.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

std::vector<std::string> faults_in(std::string_view text) {
  std::vector<std::string> headlines;
  for (const std::string& problem : parse_grading(text, "g.csv").problems) {
    headlines.emplace_back(split_lines(problem).front());
  }
  return headlines;
}

using Faults = std::vector<std::string>;

TEST(GradingFileTest, ReadsSizesAndShares) {
  const GradingFile file =
      parse_grading("\xEF\xBB\xBF# gravel\r\nsize_mm, passing_percent\r\n\r\n3.5,0\r\n 5.6 , 14.3\r\n8.5,100", "g.csv");
  ASSERT_TRUE(file.problems.empty()) << file.problems[0];
  ASSERT_EQ(file.points.size(), 3u);
  EXPECT_EQ(file.points[1].size, 5.6e-3);
  EXPECT_EQ(file.points[1].passing, 0.143);
  EXPECT_EQ(smallest_grain(file.points), 3.5e-3);
  EXPECT_EQ(largest_grain(file.points), 8.5e-3);
}

/// What is read, in mm and per cent, and the notes.
void expect_read_as_ours(std::string_view text, const std::vector<std::string>& notes) {
  const GradingFile file = parse_grading(text, "g.csv");
  ASSERT_TRUE(file.problems.empty()) << file.problems[0];
  ASSERT_EQ(file.points.size(), 3U) << text;
  const std::array<double, 3> sizes{3.5e-3, 5.6e-3, 8e-3}, shares{0.0, 0.143, 1.0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(file.points[k].size, sizes[k]) << text;
    EXPECT_EQ(file.points[k].passing, shares[k]) << text;
  }
  EXPECT_EQ(file.notes, notes) << text;
}

TEST(GradingFileTest, TablesOfLaboratories) {
  expect_read_as_ours("size_mm,passing_percent\n3.5,0\n5.6,14.3\n8,100\n", {});
  expect_read_as_ours("size_mm,passing_percent,,\n3.5,0,,\n5.6,14.3,,\n8,100,,\n,,,\n", {});
  expect_read_as_ours("Sieve size (mm);Passing (%)\n3,5;0\n5,6;14,3\n8;100\n", {"columns parted by semicolons"});
  expect_read_as_ours("Opening [mm]\t% finer\n8\t100\n5.6\t14.3\n3.5\t0\n",
                      {"columns parted by tabs", "from the coarsest sieve down"});
  expect_read_as_ours("diameter (\xc2\xb5m),fraction passing\n3500,0\n5600,0.143\n8000,1\n",
                      {"sizes in micrometres", "shares as fractions of 1"});
  expect_read_as_ours("d [um];cumulative retained %\n8000;0\n5600;85,7\n3500;100\n",
                      {"columns parted by semicolons", "sizes in micrometres",
                       "shares are those retained, added up from the coarsest sieve", "from the coarsest sieve down"});
  expect_read_as_ours("sieve,passing\n3.5,0\n5.6,14.3\n8,100\n",
                      {"sizes in mm, since no unit is named", "shares in per cent, since the header does not say"});
  expect_read_as_ours("size (m),passing percent\n0.0035,0\n0.0056,14.3\n0.008,100\n", {"sizes in m"});
  const std::string ascii = "size_mm,passing_percent\n3.5,0\n5.6,14.3\n8,100\n";
  std::string little = "\xFF\xFE", big = "\xFE\xFF";
  for (const char c : ascii) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  expect_read_as_ours(little, {"UTF-16 text"});
  expect_read_as_ours(big, {"UTF-16 text"});
}

TEST(GradingFileTest, TablesThatCanBeReadInTwoWaysAreRefused) {
  EXPECT_EQ(faults_in("size_mm,retained_percent\n3,100\n4,0\n").size(), 1U) << "on one sieve, or added up?";
  EXPECT_EQ(faults_in("size_mm,non-cumulative retained %\n3,100\n4,0\n").size(), 1U);
  EXPECT_EQ(faults_in("size_mm,mass_g\n3,100\n4,0\n").size(), 1U);
  EXPECT_EQ(faults_in("size_mm,passing_percent\n3,5,0\n4,0,100\n").size(), 2U) << "decimal commas between commas";
}

TEST(GradingFileTest, GrainSizesComeFromTheEndsOfTheCurve) {
  const Grading grading{{1e-3, 0.0}, {2e-3, 0.0}, {4e-3, 1.0}, {8e-3, 1.0}};
  EXPECT_EQ(smallest_grain(grading), 2e-3);
  EXPECT_EQ(largest_grain(grading), 4e-3);
}

TEST(GradingFileTest, RenderedLikeTheProblemsOfACase) {
  EXPECT_EQ(parse_grading("size_mm,passing_percent\n3,0\n4,60\n5,50\n6,100\n", "g.csv").problems,
            Faults{"g.csv:4:3: error: the share that passes must not fall: 50 % after 60 %\n"
                   "    4 | 5,50\n"
                   "      |   ^^"});
}

TEST(GradingFileTest, AllRules) {
  const std::string head = "size_mm,passing_percent\n";
  EXPECT_EQ(faults_in(""), Faults{"g.csv:1:1: error: a grading needs at least two rows: the sieve that nothing passes "
                                  "and the one that everything passes"});
  EXPECT_EQ(faults_in(head + "3,0\n").size(), 1u);
  EXPECT_EQ(faults_in("3,0\n4,100\n"),
            Faults{"g.csv:1:1: error: the first line must be the header \"size_mm,passing_percent\""});
  EXPECT_EQ(faults_in(head + "3,0\n3,50\n4,100\n"),
            Faults{"g.csv:3:1: error: sieve sizes must increase: 3 mm after 3 mm"});
  EXPECT_EQ(faults_in(head + "3,1\n4,99\n"), (Faults{"g.csv:2:3: error: the first row must pass 0, not 1 %",
                                                     "g.csv:3:3: error: the last row must pass 100 %, not 99 %"}));
  EXPECT_EQ(faults_in(head + "-3,0\n4,100.5\n"),
            (Faults{"g.csv:2:1: error: sieve size -3 mm is outside [0.001 mm, 1000 mm]",
                    "g.csv:3:3: error: passing 100.5 % is outside [0 %, 100 %]"}));
  EXPECT_EQ(faults_in(head + "3,0\n4;5\nx,50\n5,inf\n6,1e999\n"),
            (Faults{"g.csv:3:1: error: 1 instead of 2 numbers", "g.csv:4:1: error: \"x\" is not a plain decimal number",
                    "g.csv:5:3: error: \"inf\" is not a plain decimal number",
                    "g.csv:6:3: error: \"1e999\" is not a plain decimal number"}));
  EXPECT_EQ(faults_in(head + "3,0,7\n4,100\n"), Faults{"g.csv:2:1: error: 3 instead of 2 numbers"});
}

TEST(GradingFileTest, AnyBytesAreSurvived) {
  EXPECT_FALSE(parse_grading(std::string_view("\0\xff,\x80\n,,,\n", 9), "g.csv").problems.empty());
  EXPECT_EQ(faults_in(std::string(k_largest_case_file + 1, 'x')).size(), 1u);
  std::string many = "size_mm,passing_percent\n";
  for (int i = 0; i < 5000; ++i) many += std::to_string(1 + i) + ",0\n";
  EXPECT_EQ(faults_in(many), Faults{"g.csv:1002:1: error: more than 1000 rows"});
}

TEST(GradingFileTest, MissingFile) {
  EXPECT_THROW(read_grading_file("no-such.csv"), MissingFileError);
  EXPECT_THROW(read_grading_file(testing::TempDir()), MissingFileError);
}

/// Size at a share by interpolation that is linear in the size.
double size_at(const Grading& grading, double passing) {
  for (std::size_t i = 1; i < grading.size(); ++i) {
    if (passing > grading[i].passing) continue;
    const double t = (passing - grading[i - 1].passing) / (grading[i].passing - grading[i - 1].passing);
    return grading[i - 1].size + t * (grading[i].size - grading[i - 1].size);
  }
  return NAN;
}

TEST(GradingFileTest, ShippedGradingsAreThePublishedMaterials) {
  const std::filesystem::path folder = std::filesystem::path(DEM_SOURCE_DIR) / "cases" / "gradings";
  const GradingFile gravel = read_grading_file(folder / "gravel-rounded.csv");
  ASSERT_TRUE(gravel.problems.empty());
  EXPECT_DOUBLE_EQ(size_at(gravel.points, 0.5), 5.6e-3);
  EXPECT_NEAR(size_at(gravel.points, 0.6) / size_at(gravel.points, 0.1), 1.575, 0.005);
  EXPECT_EQ(smallest_grain(gravel.points), 3.0e-3);
  EXPECT_EQ(largest_grain(gravel.points), 8.8e-3);
  const GradingFile rubber = read_grading_file(folder / "rubber-3.7mm.csv");
  ASSERT_TRUE(rubber.problems.empty());
  EXPECT_NEAR(size_at(rubber.points, 0.5), 3.7e-3, 1e-12);
}

/// The number that follows these words; NaN when they are not there.
double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

TEST(GradingFileTest, ShippedTablesHaveTheD50AndCuOfTheirHeads) {
  const std::filesystem::path folder = std::filesystem::path(DEM_SOURCE_DIR) / "cases" / "gradings";
  std::map<std::string, std::pair<double, double>> found;  // D50 in mm and Cu by file
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string text = test::read_all(entry.path());
    const double stated_middle = number_after(text, "has D50 "),
                 stated_uniformity = number_after(text, "Cu = D60/D10 = ");
    const GradingFile file = parse_grading(text, entry.path().string());
    ASSERT_TRUE(file.problems.empty()) << file.problems[0];
    const double middle = 1e3 * size_at(file.points, 0.5);
    const double uniformity = size_at(file.points, 0.6) / size_at(file.points, 0.1);
    EXPECT_NEAR(middle, stated_middle, 0.005) << entry.path();
    EXPECT_NEAR(uniformity, stated_uniformity, 0.006) << entry.path();
    found[entry.path().filename().string()] = {middle, uniformity};
  }
  const auto& [narrow, wide] = std::pair(found.at("gravel-narrow.csv"), found.at("gravel-wide.csv"));
  EXPECT_NEAR(narrow.first, found.at("gravel-rounded.csv").first, 0.01);
  EXPECT_NEAR(wide.first, found.at("gravel-rounded.csv").first, 0.01);
  EXPECT_NEAR(narrow.second, 1.2, 0.01);
  EXPECT_NEAR(wide.second, 2.2, 0.01);
  EXPECT_NEAR(found.at("rubber-narrow.csv").second, 1.1, 0.01);
  EXPECT_NEAR(found.at("rubber-wide.csv").second, 1.6, 0.01);
}

}  // namespace
}  // namespace dem
