// SPDX-License-Identifier: BSD-3-Clause
// What a plan says: which tests share a preparation, when the last is done, how the machine is used.
#include <gtest/gtest.h>

#include "dem4grm/campaign/campaign_plan.hpp"
#include "support/command_line.hpp"

namespace dem {
namespace {

PlannedTest planned(double preparation, double shear, const std::string& group = {}, bool leads = false) {
  PlannedTest test;
  test.preparation_time = preparation;
  test.test_time = shear;
  test.group = group;
  test.leads = leads;
  return test;
}

TEST(Makespan, TestsWithoutAGroupFillTheWorkers) {
  EXPECT_EQ(makespan({planned(0, 3), planned(0, 2), planned(0, 2)}, 1), 7.0);
  EXPECT_EQ(makespan({planned(0, 2), planned(0, 2), planned(0, 3)}, 2), 4.0) << "the longest first";
  EXPECT_EQ(makespan({planned(0, 2), planned(0, 2), planned(0, 3)}, 9), 3.0);
  EXPECT_EQ(makespan({}, 2), 0.0);
}

TEST(Makespan, MembersOfAGroupWaitForThePreparation) {
  // The leader prepares until 4 and shears until 10; the other begins at 4.
  EXPECT_EQ(makespan({planned(1, 5, "a"), planned(4, 6, "a", true)}, 2), 10.0);
  EXPECT_EQ(makespan({planned(1, 9, "a"), planned(4, 6, "a", true)}, 2), 14.0);
}

TEST(BestCrew, TakesTheFastestAndFewerWorkersWinADraw) {
  EXPECT_EQ(best_crew(2, 9, [](const Crew& c) { return c.workers == 2 ? 2.0 : 1.8; }), (Crew{2, 1}));
  EXPECT_EQ(best_crew(2, 9, [](const Crew& c) { return c.workers == 2 ? 2.0 : 1.99; }), (Crew{1, 2}));
  EXPECT_EQ(best_crew(16, 99, [](const Crew& c) { return c.threads == 4 ? 2.0 : 1.0; }), (Crew{4, 4}));
}

TEST(BestCrew, NoMoreWorkersThanTestsAndAllProcessorsAreUsed) {
  EXPECT_EQ(best_crew(16, 3, [](const Crew& c) { return static_cast<double>(c.workers); }), (Crew{3, 5}));
  EXPECT_EQ(best_crew(1, 5, [](const Crew&) { return 1.0; }), (Crew{1, 1}));
  EXPECT_EQ(best_crew(8, 1, [](const Crew&) { return 1.0; }), (Crew{1, 8}));
}

class PlanOfAStudy : public ::testing::Test {
 protected:
  PlanOfAStudy() { test::write_all(folder_ / "tiny.toml", test::k_tiny_case); }
  CampaignPlan plan(const std::string& text) {
    test::write_all(folder_ / "study.toml", "base = \"tiny.toml\"\n" + text);
    study_ = load_study(folder_ / "study.toml");
    return plan_campaign(study_, {1, 1}, 1e12, 0.02);
  }
  Study study_;
  test::TemporaryFolder folder_;
};

TEST_F(PlanOfAStudy, StressesOfOneSpecimenShareAndTheLargestLeads) {
  const CampaignPlan p = plan("[axes]\nseed = [1, 2]\nnormal_stress = [\"30 kPa\", \"100 kPa\", \"60 kPa\"]\n");
  ASSERT_EQ(p.tests.size(), 6U);
  for (const PlannedTest& test : p.tests) {
    EXPECT_EQ(test.group, test.name.starts_with("seed1") ? "seed1-100kPa" : "seed2-100kPa");
    EXPECT_EQ(test.leads, test.name == test.group);
  }
  EXPECT_LT(p.tests[0].preparation_time, p.tests[1].preparation_time) << "the fill is there already";
}

TEST_F(PlanOfAStudy, OtherGrainsShareNothing) {
  const CampaignPlan p = plan("[axes]\nrubber_content = [0, 0.2]\ngravel.friction = [0.5, 0.7]\n");
  for (const PlannedTest& test : p.tests) EXPECT_TRUE(test.group.empty()) << test.name;
}

TEST_F(PlanOfAStudy, TwiceTheWayTakesTwiceTheShear) {
  const CampaignPlan p = plan("[axes]\ndisplacement = [\"0.5 mm\", \"1 mm\"]\n");
  EXPECT_NEAR(p.tests[1].test_time, 2.0 * p.tests[0].test_time, 0.01 * p.tests[1].test_time);
  EXPECT_NEAR(p.time, p.tests[0].time() + p.tests[1].time(), 1e-9);
  EXPECT_GT(p.disk, 0.0);
  EXPECT_GT(p.memory, 1e6);
}

TEST_F(PlanOfAStudy, JsonNamesEveryTestWithItsValues) {
  const CampaignPlan p = plan("[axes]\nseed = [1, 2]\n");
  const JsonObject json = plan_as_json(study_, p);
  const auto& tests = std::get<JsonList>(find_field(json, "tests")->data);
  ASSERT_EQ(tests.size(), 2U);
  const auto& second = std::get<JsonObject>(tests[1].data);
  EXPECT_EQ(text_in(second, "name"), "seed2");
  EXPECT_EQ(number_in(std::get<JsonObject>(find_field(second, "values")->data), "seed"), 2.0);
}

}  // namespace
}  // namespace dem
