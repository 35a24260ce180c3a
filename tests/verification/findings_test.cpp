// SPDX-License-Identifier: BSD-3-Clause
// A suite that cannot miss would prove nothing: how a check is judged, chosen and reported.
#include <gtest/gtest.h>

#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/report/verification_manual.hpp"
#include "dem4grm/verify/runner.hpp"

namespace {

using namespace dem;

constexpr double k_no_number = std::numeric_limits<double>::quiet_NaN();

Check only_check(const Findings& f) { return f.checks().at(0); }

TEST(Check, RelativeError) {
  Findings f;
  f.relative("q", "N", -200.0, -202.0, 0.011, "s");
  EXPECT_NEAR(only_check(f).error(), 0.01, 1e-15);
  EXPECT_TRUE(only_check(f).passes());
  Findings g;
  g.relative("q", "N", -200.0, 200.0, 0.011, "s");
  EXPECT_FALSE(only_check(g).passes());
}

TEST(Check, AbsoluteError) {
  Findings f;
  f.absolute("q", "N", 0.0, -0.5, 0.5, "s");
  f.absolute("q", "N", 0.0, -0.51, 0.5, "s");
  EXPECT_TRUE(f.checks()[0].passes());
  EXPECT_FALSE(f.checks()[1].passes());
}

TEST(Check, Limits) {
  Findings f;
  f.at_most("q", "1", 2.0, 2.0, "s");
  f.at_most("q", "1", 2.0, 2.1, "s");
  f.at_least("q", "1", 2.0, 2.0, "s");
  f.at_least("q", "1", 2.0, 1.9, "s");
  EXPECT_TRUE(f.checks()[0].passes());
  EXPECT_FALSE(f.checks()[1].passes());
  EXPECT_NEAR(f.checks()[1].error(), 0.1, 1e-15);
  EXPECT_TRUE(f.checks()[2].passes());
  EXPECT_FALSE(f.checks()[3].passes());
}

TEST(Check, WhatIsNoNumberMisses) {
  Findings f;
  f.relative("q", "1", 1.0, k_no_number, 1e9, "s");
  f.absolute("q", "1", 1.0, k_no_number, 1e9, "s");
  f.at_most("q", "1", 1e9, k_no_number, "s");
  f.at_least("q", "1", -1e9, k_no_number, "s");
  for (const Check& c : f.checks()) EXPECT_FALSE(c.passes());
}

TEST(CaseOfSuite, EndsWithAnErrorOrWithoutChecksIsMissed) {
  VerificationCase broken{"broken", "t", "x", Extent::quick, [](Findings&) { throw PhysicsError("ball 7 is lost"); }};
  const CaseOutcome outcome = run_case_of_suite(broken);
  EXPECT_EQ(outcome.missed(), 1);
  EXPECT_NE(verification_table_rows(outcome).find("ball 7 is lost"), std::string::npos);
  broken.run = [](Findings&) {};
  EXPECT_EQ(run_case_of_suite(broken).missed(), 1);
}

TEST(CaseOfSuite, UnknownNameIsAUsageErrorThatListsTheNames) {
  try {
    select_cases({"no-such-case"}, Extent::full);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    for (const VerificationCase& c : verification_cases()) {
      EXPECT_NE(std::string(e.what()).find(c.name), std::string::npos);
    }
  }
}

TEST(CaseOfSuite, SelectionKeepsTheOrderOfTheSuite) {
  const auto& all = verification_cases();
  ASSERT_GE(all.size(), 2U);
  const auto chosen = select_cases({all[1].name, all[0].name}, Extent::quick);
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0], &all[0]);
  EXPECT_EQ(chosen[1], &all[1]);
  EXPECT_EQ(select_cases({}, Extent::full).size(), all.size());
}

TEST(Manual, HoldsEveryNumberAndEscapesTables) {
  const VerificationCase tested{"a-case", "Title", "Words.", Extent::quick, [](Findings& f) {
                                  f.relative("force |F|", "N", 2.0, 2.5, 0.1, "book");
                                  f.picture({"curve", "Curve", "x", "y", {{"ours", false, {0, 1}, {2, 3}}}});
                                  f.remark("A remark.");
                                }};
  const std::vector<CaseOutcome> outcomes{run_case_of_suite(tested)};
  const std::string text = verification_manual(outcomes);
  for (const char* part : {"## Title", "Words.", "force \\|F\\|", "| N | 2 | 2.5 |", "**MISSED**", "pictures/curve.png",
                           "A remark.", "1 quantities in 1 cases, 1 missed"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  const std::string json = json_text(verification_json(outcomes));
  for (const char* part : {"\"case\": \"a-case\"", "\"expected\": 2.0", "\"obtained\": 2.5", "\"error\": 0.25",
                           "\"tolerance\": 0.1", "\"passed\": false", "\"source\": \"book\""}) {
    EXPECT_NE(json.find(part), std::string::npos) << part;
  }
  EXPECT_NE(json_text(verification_curves(outcomes)).find("\"y\": [\n"), std::string::npos);
}

}  // namespace
