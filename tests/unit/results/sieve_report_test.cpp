// SPDX-License-Identifier: BSD-3-Clause
// A specimen goes to a file, comes back, and is sieved: what is read is what was written, and the three outputs agree.
#include "dem4grm/results/sieve_report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/results_file.hpp"
#include "support/drawn_packing.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

class SieveReportTest : public ::testing::Test {
 protected:
  /// Writes the drawn grains of the demonstration case with the name of a finished specimen.
  SieveReportTest() {
    const LoadedCase loaded = load_case(std::filesystem::path(DEM_SOURCE_DIR) / "cases" / "quick.toml");
    test_ = std::get<DirectShearCase>(loaded.test);
    Simulation s(test::drawn_scene(test_));
    ResultsFile file(folder_ / "specimen.h5", {"direct_shear", test_.name, loaded.source_text, loaded.resolved_toml});
    file.add_frame(s, {0, 0.0, s.state_hash()});
    packing_ = packing_of(s);
  }

  test::TemporaryFolder folder_;
  DirectShearCase test_;
  Packing packing_;
};

TEST_F(SieveReportTest, TheStateComesBackFromFolderAndFile) {
  for (const std::filesystem::path& path : {folder_.path(), folder_ / "specimen.h5"}) {
    const StoredGrains stored = read_stored_grains(path);
    EXPECT_EQ(stored.file, folder_ / "specimen.h5");
    EXPECT_EQ(stored.packing.radius, packing_.radius);
    EXPECT_EQ(stored.packing.body, packing_.body);
    EXPECT_EQ(stored.packing.n_rubber_grains, packing_.n_rubber_grains);
    ASSERT_EQ(stored.packing.position.size(), packing_.position.size());
    EXPECT_EQ(norm(stored.packing.position.back() - packing_.position.back()), 0.0);
    EXPECT_EQ(stored.plate_height, test_.box.height);
    EXPECT_TRUE(stored.normals.empty());
    EXPECT_EQ(stored.test.specimen.gravel_grading.size(), test_.specimen.gravel_grading.size());
  }
}

TEST_F(SieveReportTest, TextJsonAndPlotDataSayTheSame) {
  const SieveReport report = sieve_report(read_stored_grains(folder_.path()), {5.6e-3, 4e-3});
  EXPECT_EQ(report.table.openings, (std::vector<double>{4e-3, 5.6e-3}));
  const JsonObject json = sieve_json(report);
  const auto& sieves = std::get<JsonList>(find_field(json, "sieves")->data);
  ASSERT_EQ(sieves.size(), 2U);
  const auto& row = std::get<JsonObject>(sieves[1].data);
  EXPECT_EQ(number_in(row, "sieve_mm"), 5.6);
  EXPECT_NEAR(number_in(row, "gravel_passing_percent"), 50.0, 2.0);  // D50 of the shipped gravel
  EXPECT_EQ(number_in(row, "gravel_input_percent"), 50.0);
  EXPECT_EQ(number_in(row, "rubber_passing_percent"), 100.0);
  const double together = number_in(row, "together_passing_percent");
  // VRC 0.25: rubber is 0.25 * 1150 of 0.25 * 1150 + 0.75 * 2710 by mass, 12.4 %.
  EXPECT_NEAR(together, 12.4 + 87.6 * 0.5, 2.0);
  const std::string csv = sieve_csv(report), text = sieve_text(report);
  EXPECT_TRUE(csv.starts_with("sieve_mm,gravel_passing_percent,gravel_input_percent,gravel_difference_points,rubber_"));
  EXPECT_NE(csv.find("\n5.6,"), std::string::npos);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_NE(text.find(fmt::format("{:.2f}", together)), std::string::npos) << text;
  const auto& gravel = std::get<JsonObject>(find_field(json, "gravel")->data);
  EXPECT_NEAR(number_in(gravel, "D50_mm"), 5.6, 0.05);
  EXPECT_NEAR(number_in(gravel, "uniformity"), 1.58, 0.05);
}

TEST_F(SieveReportTest, WithoutOpeningsTheSievesAreThoseOfTheGradings) {
  const SieveReport report = sieve_report(read_stored_grains(folder_.path()), {});
  EXPECT_EQ(report.table.openings.size(), test_.specimen.gravel_grading.size() + 2);
  EXPECT_LT(report.table.gravel.largest_difference(), 0.02);
}

TEST_F(SieveReportTest, WhatCannotBeSievedIsRefused) {
  EXPECT_THROW(read_stored_grains(folder_ / "nothing"), MissingFileError);
  const test::TemporaryFolder empty;
  EXPECT_THROW(read_stored_grains(empty.path()), MissingFileError);
  test::write_all(empty / "specimen.h5", "no HDF5");
  EXPECT_THROW(read_stored_grains(empty.path()), IoError);
  const ResultsFile without_states(empty / "specimen.h5", {"direct_shear", "none", "", "[specimen]\n"});
  EXPECT_THROW(read_stored_grains(empty.path()), IoError);
  const ResultsFile of_one_grain(empty / "specimen.h5", {"grain_compression", "one", "", ""});
  try {
    read_stored_grains(empty.path());
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
  }
}

}  // namespace
}  // namespace dem
