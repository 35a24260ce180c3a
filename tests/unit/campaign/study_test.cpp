// SPDX-License-Identifier: BSD-3-Clause
// Studies: which tests follow from axes, ranges, pairs, rows and lists of cases, what they are called, and what is said
// about a study that is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "dem4grm/campaign/study.hpp"
#include "dem4grm/core/error.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

class StudyFile : public ::testing::Test {
 protected:
  StudyFile() { test::write_all(folder_ / "tiny.toml", test::k_tiny_case); }

  Study load(const std::string& text) const {
    test::write_all(folder_ / "study.toml", text);
    return load_study(folder_ / "study.toml");
  }
  /// With the tiny case as its base.
  Study of_base(const std::string& text) const { return load("base = \"tiny.toml\"\n" + text); }

  std::vector<std::string> names(const std::string& text) const {
    std::vector<std::string> found;
    for (const StudyTest& test : of_base(text).tests) found.push_back(test.name);
    return found;
  }
  /// The message about a study that must be refused.
  std::string refusal(const std::string& text) const {
    try {
      of_base(text);
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
  }
  void expect_refusal(const std::string& text, const std::string& message) const {
    const std::string said = refusal(text);
    EXPECT_NE(said.find(message), std::string::npos) << said;
  }

  test::TemporaryFolder folder_;
};

using Names = std::vector<std::string>;

const DirectShearCase& shear_of(const StudyTest& test) { return std::get<DirectShearCase>(test.loaded.test); }

TEST_F(StudyFile, EveryCombinationOfTheAxesIsATest) {
  const Study study =
      of_base("[axes]\nrubber_content = [0, 0.25]\nnormal_stress = [\"30 kPa\", \"0.1 MPa\"]\nseed = [1, 2]\n");
  ASSERT_EQ(study.tests.size(), 8U);
  EXPECT_EQ(study.tests[0].name, "vrc000-030kPa-seed1");
  EXPECT_EQ(study.tests[1].name, "vrc000-030kPa-seed2");
  EXPECT_EQ(study.tests[7].name, "vrc025-100kPa-seed2");
  const DirectShearCase& last = shear_of(study.tests[7]);
  EXPECT_EQ(last.specimen.rubber_content, 0.25);
  EXPECT_EQ(last.shear.normal_stress, 100e3);
  EXPECT_EQ(last.seed, 2U);
  EXPECT_EQ(last.name, study.tests[7].name) << "the case carries the name of the test";
  EXPECT_EQ(study.name, "study") << "of the file, where it gives itself none";
}

TEST_F(StudyFile, AResolvedCaseReadsAsTheSameTest) {
  const Study study = of_base("[axes]\nrubber_content = [0.25]\nvelocity = [\"quasi-static\", \"20 mm/s\"]\n");
  for (const StudyTest& test : study.tests) {
    const LoadedCase again = parse_case(test.loaded.resolved_toml, "again.toml");
    EXPECT_EQ(again.resolved_toml, test.loaded.resolved_toml);
  }
}

TEST_F(StudyFile, NamesFollowFromTheValuesHoweverTheyAreWritten) {
  EXPECT_EQ(names("[axes]\nnormal_stress = [\"60 kPa\", \"0.03 MPa\", \"7500 Pa\"]"),
            (Names{"060kPa", "030kPa", "007.5kPa"}));
  EXPECT_EQ(names("[axes]\nrubber_content = [0.125, 1]"), (Names{"vrc012.5", "vrc100"}));
  EXPECT_EQ(names("[axes]\nvelocity = [\"20 mm/s\", \"quasi-static\"]"),
            (Names{"velocity-20mm_s", "velocity-quasi-static"}));
  EXPECT_EQ(names("[axes]\ngravel.friction = [0.5]\nrubber.friction = [0.3]"),
            (Names{"gravel.friction-0.5-rubber.friction-0.3"}));
  EXPECT_EQ(names("[axes]\nmoving_half = [\"lower\", \"upper\"]"), (Names{"moving_half-lower", "moving_half-upper"}));
}

TEST_F(StudyFile, NamesStayWhenTestsAreAdded) {
  const Names few = names("[axes]\nrubber_content = [0.25]\nnormal_stress = [\"100 kPa\"]");
  const Names many =
      names("[axes]\nrubber_content = [0, 0.25, 1]\nnormal_stress = [\"5 kPa\", \"100 kPa\"]\n[[tests]]\nseed = 9");
  for (const std::string& name : few) EXPECT_NE(std::find(many.begin(), many.end(), name), many.end());
}

TEST_F(StudyFile, RangesHaveRoundValuesAndTheirEnd) {
  EXPECT_EQ(names("[axes]\nrubber_content = { from = 0, to = 0.3, step = 0.1 }"),
            (Names{"vrc000", "vrc010", "vrc020", "vrc030"}));
  EXPECT_EQ(names("[axes]\nnormal_stress = { from = \"30 kPa\", to = \"100 kPa\", step = \"30 kPa\" }"),
            (Names{"030kPa", "060kPa", "090kPa"}));
  EXPECT_EQ(names("[axes]\nseed = { from = 1, to = 3, step = 1 }"), (Names{"seed1", "seed2", "seed3"}));
  // The third multiple of 0.1 is not 0.3 in binary numbers.
  const Study study = of_base("[axes]\nrubber_content = { from = 0, to = 0.3, step = 0.1 }");
  EXPECT_EQ(shear_of(study.tests[3]).specimen.rubber_content, 0.3);
}

TEST_F(StudyFile, PairedListsAreOneAxisAndRowsAreSingleTests) {
  const Study study = of_base(
      "[axes]\nseed = [1, 2]\n[[paired]]\nbox.length = [\"21 mm\", \"30 mm\"]\nbox.width = [\"21 mm\", \"21 mm\"]\n"
      "[[tests]]\nrubber_content = 0\nseed = 7\n");
  ASSERT_EQ(study.tests.size(), 5U);
  EXPECT_EQ(study.tests[1].name, "seed1-length-30mm-width-21mm");
  EXPECT_EQ(shear_of(study.tests[1]).box.length, 0.03);
  EXPECT_EQ(study.tests[4].name, "vrc000-seed7");
  EXPECT_EQ(shear_of(study.tests[4]).box.length, 0.021) << "a row takes what it does not give from the base";
}

TEST_F(StudyFile, SetIsForAllTestsAndARowMayHaveItsOwn) {
  const Study study =
      of_base("[set]\nshear.displacement = \"0.5 mm\"\n[axes]\nseed = [1]\n[[tests]]\ndisplacement = \"0.7 mm\"\n");
  EXPECT_EQ(shear_of(study.tests[0]).shear.displacement, 0.5e-3);
  EXPECT_EQ(shear_of(study.tests[1]).shear.displacement, 0.7e-3);
}

TEST_F(StudyFile, CasesAreTestsAndAxesAreForEachOfThem) {
  std::string other = test::k_tiny_case;
  other.replace(other.find("tiny"), 4, "some");
  other.replace(other.find("seed = 3"), 8, "seed = 8");
  test::write_all(folder_ / "other.toml", other);
  const Study plain = load("cases = [\"tiny.toml\", \"other.toml\"]\n");
  ASSERT_EQ(plain.tests.size(), 2U);
  EXPECT_EQ(plain.tests[0].name, "tiny");
  EXPECT_EQ(plain.tests[1].name, "some");
  const Study crossed = load("cases = [\"tiny.toml\", \"other.toml\"]\n[axes]\nrubber_content = [0.1, 0.2]\n");
  ASSERT_EQ(crossed.tests.size(), 4U);
  EXPECT_EQ(crossed.tests[3].name, "some-vrc020");
}

TEST_F(StudyFile, AGradingOfAnAxisLiesBesideTheStudy) {
  std::filesystem::create_directories(folder_ / "bases");
  test::write_all(folder_ / "bases/tiny.toml", test::k_tiny_case);
  test::write_all(folder_ / "fine.csv", "size_mm,passing_percent\n3.5,0\n3.9,100\n");
  const Study study = load("base = \"bases/tiny.toml\"\n[axes]\ngravel_grading = [\"fine.csv\"]\n");
  ASSERT_EQ(study.tests.size(), 1U);
  EXPECT_EQ(shear_of(study.tests[0]).specimen.gravel_grading.front().size, 3.5e-3);
  EXPECT_EQ(study.tests[0].name, "gravel_grading-fine.csv");
}

TEST_F(StudyFile, AGradingMayStandInTheStudyItself) {
  const Study study =
      of_base("[set]\nspecimen.gravel_grading = [[\"4.0 mm\", 0.0],\n  [\"4.8 mm\", 1.0]]\n[axes]\nseed = [1, 2]\n");
  ASSERT_EQ(study.tests.size(), 2U);
  const auto& grading = shear_of(study.tests[1]).specimen.gravel_grading;
  ASSERT_EQ(grading.size(), 2U);
  EXPECT_DOUBLE_EQ(grading[0].size, 4.0e-3);
  EXPECT_DOUBLE_EQ(grading[1].size, 4.8e-3);
  EXPECT_EQ(grading[1].passing, 1.0);
}

TEST_F(StudyFile, ColumnsCarryUnitsAndNumbersAreInThem) {
  const Study study = of_base("[axes]\nnormal_stress = [\"0.06 MPa\"]\nvelocity = [\"20 mm/s\", \"quasi-static\"]\n");
  const std::vector<StudyValue>& values = study.tests[0].values;
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0].column, "normal_stress_kPa");
  EXPECT_EQ(values[0].number, 60.0);
  EXPECT_EQ(values[1].column, "velocity_mm_per_s");
  EXPECT_EQ(values[1].number, 20.0);
  EXPECT_EQ(study.tests[1].values[1].number, std::nullopt);
}

TEST_F(StudyFile, AMistakeIsShownAtItsLine) {
  expect_refusal("[axes]\nnormal_stres = [\"60 kPa\"]",
                 "study.toml:3:1: error: unknown key \"normal_stres\"; did you mean \"normal_stress\"?");
  expect_refusal("[axes]\nnormal_stress = [\"60 kPa\", \"60\"]",
                 "study.toml:3:28: error: shear.normal_stress = \"60\" has no unit");
  expect_refusal("[axes]\nrubber_content = [0, 1.5]",
                 "study.toml:3:22: error: specimen.rubber_content = 1.5 is outside [0, 1]");
  expect_refusal("[axes]\nfriction = [0.5]",
                 "friction is the name of several keys: write gravel.friction or rubber.friction or walls.friction");
  expect_refusal("[axes]\nseed = 3", "seed must be a list of values");
  expect_refusal("[axes]\nseed = []", "seed must be a list of values");
  expect_refusal("[axes]\nseed = [1, 2, 1]", "study.toml:3:15: error: seed = 1 is listed twice");
  expect_refusal("[axes]\nname = [\"a\"]", "name cannot differ from test to test");
  expect_refusal("[axes]\nseed = [1]\n[axis]\n", "unknown word \"axis\" in a study; did you mean \"axes\"?");
  expect_refusal("[set]\nseed = 2\n[axes]\nseed = [1]", "seed is given twice");
  expect_refusal("[[paired]]\nseed = [1, 2]\nrubber_content = [0]",
                 "paired lists must be of one length: seed gives 2 value(s), specimen.rubber_content gives 1");
  expect_refusal("[axes]\nseed = [1\n", "study.toml:");
}

TEST_F(StudyFile, RangesThatCannotBeAreRefused) {
  expect_refusal("[axes]\nseed = { from = 1, to = 3 }", "the range of seed needs from, to and step");
  expect_refusal("[axes]\nseed = { from = 3, to = 1, step = 1 }", "must rise");
  expect_refusal("[axes]\nseed = { from = 1, to = 3, step = 0 }", "must rise");
  expect_refusal("[axes]\nnormal_stress = { from = 30, to = 60, step = 10 }", "each a number with its unit");
  expect_refusal("[axes]\nseed = { from = 1, to = 3, step = 1, steps = 4 }", "unknown key \"steps\" in a range");
  expect_refusal("[axes]\nseed = { from = 1, to = 9000, step = 1 }\nrubber_content = { from = 0, to = 1, step = 0.01 }",
                 "tests, 20000 are allowed");
}

TEST_F(StudyFile, SeveralMistakesComeTogether) {
  const std::string said = refusal("[axes]\nsed = [1]\nrubber_content = [2]\nnormal_stress = [\"60\"]");
  EXPECT_NE(said.find("3 errors"), std::string::npos) << said;
}

TEST_F(StudyFile, ATestThatBreaksARuleOfTheCaseIsNamedByItsValues) {
  const std::string said = refusal("[axes]\nshear.displacement = [\"0.5 mm\", \"15 mm\"]");
  EXPECT_NE(said.find("test shear.displacement = \"15 mm\""), std::string::npos) << said;
  EXPECT_NE(said.find("half of box.length"), std::string::npos) << said;
  EXPECT_EQ(said.find("--set"), std::string::npos) << "nobody gave an option: " << said;
}

TEST_F(StudyFile, EqualTestsAreRefused) {
  expect_refusal("[axes]\nseed = [3]\n[[tests]]\nrubber_content = 0.2\n",
                 "two tests are the same case: seed3 and vrc020");
}

TEST_F(StudyFile, CasesOfOneNameAreToldApart) {
  std::string other = test::k_tiny_case;
  other.replace(other.find("seed = 3"), 8, "seed = 8");
  test::write_all(folder_ / "other.toml", other);
  try {
    load("cases = [\"tiny.toml\", \"other.toml\"]\n");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("two tests that differ have one name, tiny"), std::string::npos)
        << error.what();
  }
}

TEST_F(StudyFile, ABaseMayLackWhatTheAxesGive) {
  std::string text = test::k_tiny_case;
  text.erase(text.find("rubber_content"), text.find('\n', text.find("rubber_content")) - text.find("rubber_content"));
  test::write_all(folder_ / "tiny.toml", text);
  EXPECT_EQ(names("[axes]\nrubber_content = [0.1]"), (Names{"vrc010"}));
}

TEST_F(StudyFile, MissingFilesAndWordsAreNamed) {
  EXPECT_THROW(load_study(folder_ / "none.toml"), MissingFileError);
  const auto said = [&](const std::string& text) {
    try {
      load(text);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(said("base = \"nowhere.toml\"\n").find("nowhere.toml: no such file"), std::string::npos);
  EXPECT_NE(said(test::k_tiny_case).find("this is a case, not a study"), std::string::npos);
  EXPECT_NE(said("name = \"x\"\n").find("a study names either its base"), std::string::npos);
  EXPECT_NE(said("base = \"tiny.toml\"\ncases = [\"tiny.toml\"]\n").find("a study names either its base"),
            std::string::npos);
}

TEST_F(StudyFile, PublishedCampaignHasItsEighteenTests) {
  const Study study = load_study(std::filesystem::path(DEM_SOURCE_DIR) / "cases/paper/campaign.toml");
  ASSERT_EQ(study.tests.size(), 18U);
  EXPECT_EQ(study.tests.front().name, "vrc000-030kPa");
  EXPECT_EQ(study.tests.back().name, "vrc100-100kPa");
  for (const StudyTest& test : study.tests) {
    EXPECT_EQ(shear_of(test).box.length, 0.1);
    EXPECT_EQ(shear_of(test).shear.velocity, 0.002);
    EXPECT_EQ(shear_of(test).specimen.relative_density, 0.5);
  }
}

TEST_F(StudyFile, ShippedStudiesAreWhatTheySay) {
  const std::filesystem::path studies = std::filesystem::path(DEM_SOURCE_DIR) / "cases/studies";
  EXPECT_EQ(load_study(studies / "quick.toml").tests.size(), 6U);
  EXPECT_EQ(load_study(studies / "replicates.toml").tests.size(), 45U);
  EXPECT_EQ(load_study(studies / "contraction-full.toml").tests.size(), 3U);
  for (const StudyTest& test : load_study(studies / "loose-rubber.toml").tests) {
    EXPECT_EQ(shear_of(test).specimen.preparation_friction, 2.0) << "in place of the relative density of its base";
  }
}

}  // namespace
}  // namespace dem
