// SPDX-License-Identifier: BSD-3-Clause
// What is gathered from finished tests, from folders that this test writes itself.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "dem4grm/campaign/collect.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/profile_file.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

class Collected : public ::testing::Test {
 protected:
  Collected() { std::filesystem::create_directories(folder_ / "out"); }

  /// A finished shear test of two rows with tau = 5 kPa + sigma tan(30 deg) at its peak.
  CollectedTest write_test(double rubber_content, double stress, int seed, double more = 0.0) const {
    const std::string name = fmt::format("vrc{:g}-{:g}-{}", rubber_content, stress, seed);
    const std::filesystem::path place = folder_ / name;
    std::filesystem::create_directories(place);
    const double peak = 5.0 + stress * std::tan(M_PI / 6.0) + more;
    test::write_all(place / "summary.json",
                    fmt::format("{{\"test\": \"direct_shear\", \"case\": \"{}\", \"peak_shear_stress_kPa\": {}, "
                                "\"residual_shear_stress_kPa\": {}, \"normal_stress_mean_kPa\": {}, \"hardening\": {}, "
                                "\"branches\": [1], \"micro_at_peak\": {{\"a_n\": 0.25}}}}",
                                name, peak, 0.5 * stress, stress, rubber_content == 1.0));
    write_table(place / "shear.csv", shear_columns(), 2);
    write_table(place / "micro.csv", micro_columns(), 1);
    write_table(place / "walls.csv", wall_columns(), 2);
    if (normal_stress_has_profiles(stress)) write_table(place / "profiles.csv", profile_columns(), 3);
    return {name,
            {{"specimen.rubber_content", fmt::format("{}", rubber_content), "rubber_content", rubber_content},
             {"shear.normal_stress", fmt::format("\"{} kPa\"", stress), "normal_stress_kPa", stress},
             {"seed", fmt::format("{}", seed), "seed", static_cast<double>(seed)},
             {"shear.moving_half", "\"lower\"", "moving_half", std::nullopt}},
            place};
  }
  /// Those of 30 kPa are of a program that wrote none.
  static bool normal_stress_has_profiles(double stress) { return stress > 30.0; }
  static void write_table(const std::filesystem::path& path, std::span<const ColumnInfo> columns, int rows) {
    std::string text;
    for (const ColumnInfo& c : columns) text += fmt::format("{}{}", text.empty() ? "" : ",", c.name);
    text += '\n';
    for (int row = 0; row < rows; ++row) {
      for (std::size_t c = 0; c < columns.size(); ++c)
        text += fmt::format("{}{}", c == 0 ? "" : ",", row + 0.5 * static_cast<double>(c));
      text += '\n';
    }
    test::write_all(path, text);
  }
  std::vector<CollectedTest> six_tests() const {
    std::vector<CollectedTest> tests;
    for (const double content : {0.0, 1.0}) {
      for (const double stress : {30.0, 60.0, 100.0}) tests.push_back(write_test(content, stress, 1));
    }
    return tests;
  }
  [[nodiscard]] std::vector<std::string> lines_of(const std::string& file) const {
    std::istringstream text(test::read_all(folder_ / ("out/" + file)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
  test::TemporaryFolder folder_;
};

TEST_F(Collected, EnvelopesAreThoseOfTheMixtures) {
  const Collection c = read_collection(six_tests());
  ASSERT_EQ(c.envelopes.size(), 4U) << "peak and residual of two mixtures";
  EXPECT_EQ(c.envelopes[0].values.size(), 2U) << "neither stress nor seed tells mixtures apart";
  EXPECT_NEAR(c.envelopes[0].fit.friction_angle->value, M_PI / 6.0, 1e-9);
  EXPECT_NEAR(c.envelopes[0].fit.cohesion->value, 5e3, 1e-5);
  EXPECT_NEAR(c.envelopes[1].fit.friction_angle->value, std::atan(0.5), 1e-9);
  EXPECT_EQ(c.envelopes[0].hardening, 0);
  EXPECT_EQ(c.envelopes[2].hardening, 3);
  EXPECT_NE(envelopes_text(c).find("phi 30.0 (30.0 to 30.0) degrees, c 5.0"), std::string::npos) << envelopes_text(c);
}

TEST_F(Collected, SeedsOfOneMixtureAreInOneEnvelope) {
  std::vector<CollectedTest> tests;
  for (const int seed : {1, 2}) {
    for (const double stress : {30.0, 60.0, 100.0})
      tests.push_back(write_test(0.0, stress, seed, seed == 1 ? 2.0 : -2.0));
  }
  const Collection c = read_collection(tests);
  ASSERT_EQ(c.envelopes.size(), 2U);
  EXPECT_EQ(c.envelopes[0].fit.points, 6);
  EXPECT_EQ(c.envelopes[0].fit.stresses, 3);
  EXPECT_NEAR(c.envelopes[0].fit.friction_angle->value, M_PI / 6.0, 1e-9);
  EXPECT_NEAR(*c.envelopes[0].fit.residual_deviation, std::sqrt(6.0 * 4e6 / 4.0), 1e-3);
}

TEST_F(Collected, TablesHoldEveryNumberOnce) {
  write_collection(read_collection(six_tests()), folder_ / "out");
  const std::vector<std::string> tests = lines_of("tests.csv");
  ASSERT_EQ(tests.size(), 7U);
  EXPECT_EQ(tests[0],
            "test,rubber_content,normal_stress_kPa,seed,moving_half,kind_of_test,case,peak_shear_stress_kPa,"
            "residual_shear_stress_kPa,normal_stress_mean_kPa,hardening,micro_at_peak_a_n");
  EXPECT_TRUE(tests[1].starts_with("vrc0-30-1,0,30,1,lower,direct_shear,vrc0-30-1,")) << tests[1];
  EXPECT_TRUE(tests[1].ends_with(",15,30,0,0.25")) << tests[1];

  const std::vector<std::string> all = lines_of("collected.csv");
  EXPECT_EQ(all[0], "test,rubber_content,normal_stress_kPa,seed,moving_half,table,displacement_mm,quantity,unit,value");
  const std::size_t numbers_of_summary = 5;
  const std::size_t of_a_test = numbers_of_summary + 2 * (shear_columns().size() - 1) + micro_columns().size() - 1;
  EXPECT_EQ(all.size(), 1 + 6 * of_a_test);
  EXPECT_EQ(std::count(all.begin(), all.end(), "vrc0-30-1,0,30,1,lower,summary,,residual_shear_stress_kPa,kPa,15"), 1);
  EXPECT_EQ(std::count(all.begin(), all.end(), "vrc1-60-1,1,60,1,lower,shear,1,shear_stress_kPa,kPa,1.5"), 1);

  const std::vector<std::string> envelopes = lines_of("envelopes.csv");
  ASSERT_EQ(envelopes.size(), 5U);
  EXPECT_TRUE(envelopes[0].starts_with(
      "rubber_content,moving_half,quantity,tests,normal_stresses,hardening,friction_angle_deg,"));
  EXPECT_TRUE(envelopes[3].starts_with("1,lower,peak,3,3,3,30")) << envelopes[3];
}

TEST_F(Collected, Hdf5HasTheSameWithUnits) {
  write_collection(read_collection(six_tests()), folder_ / "out");
  const hdf5::Handle file = hdf5::open_file(folder_ / "out/collected.h5", hdf5::Access::read);
  const hdf5::Handle tests = hdf5::open_group(file, "tests"), shear = hdf5::open_group(file, "shear");
  EXPECT_EQ(hdf5::read_texts(tests, "name").at(5), "vrc1-100-1");
  EXPECT_EQ(hdf5::read_dataset(tests, "study_normal_stress_kPa"), (std::vector{30.0, 60.0, 100.0, 30.0, 60.0, 100.0}));
  EXPECT_EQ(hdf5::read_texts(tests, "study_moving_half").at(0), "lower");
  EXPECT_EQ(hdf5::read_whole_numbers(shear, "test"), (std::vector<std::int64_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
  EXPECT_EQ(hdf5::read_dataset(shear, "shear_stress_kPa").at(1), 1.5);
  EXPECT_NEAR(hdf5::read_dataset(hdf5::open_group(file, "envelopes"), "friction_angle_deg").at(0), 30.0, 1e-9);
  const hdf5::Handle walls = hdf5::open_group(file, "walls"), profiles = hdf5::open_group(file, "profiles");
  EXPECT_EQ(hdf5::read_whole_numbers(walls, "test"), hdf5::read_whole_numbers(shear, "test"));
  EXPECT_EQ(hdf5::names_in(walls).size(), 1 + wall_columns().size());
  EXPECT_EQ(hdf5::read_whole_numbers(profiles, "test"), (std::vector<std::int64_t>{1, 1, 1, 2, 2, 2, 4, 4, 4, 5, 5, 5}))
      << "tests of an older program have none";
  EXPECT_EQ(hdf5::read_dataset(profiles, std::string(profile_columns()[1].name)).at(1), 1.5);
}

TEST_F(Collected, TheSameTestsGiveTheSameBytes) {
  write_collection(read_collection(six_tests()), folder_ / "out");
  const std::string first = test::read_all(folder_ / "out/collected.h5"),
                    text = test::read_all(folder_ / "out/collected.csv");
  write_collection(read_collection(six_tests()), folder_ / "out");
  EXPECT_EQ(test::read_all(folder_ / "out/collected.h5"), first);
  EXPECT_EQ(test::read_all(folder_ / "out/collected.csv"), text);
}

TEST_F(Collected, ADamagedTestIsLeftOutWithAWarning) {
  std::vector<CollectedTest> tests = six_tests();
  test::write_all(tests[1].folder / "micro.csv", "displacement_mm,a_all\n1\n");
  test::write_all(tests[4].folder / "summary.json", "{");
  const Collection c = read_collection(tests);
  EXPECT_EQ(c.tests.size(), 4U);
  ASSERT_EQ(c.warnings.size(), 2U);
  EXPECT_NE(c.warnings[0].find("vrc0-60-1 is left out"), std::string::npos) << c.warnings[0];
  EXPECT_EQ(c.shear.test.size(), 8U) << "the rows of a test that is left out are left out too";
  EXPECT_EQ(c.shear.columns[0].values.size(), 8U);
}

}  // namespace
}  // namespace dem
