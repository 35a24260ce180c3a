// SPDX-License-Identifier: BSD-3-Clause
// The cases of `dem4grm verify` as tests: those that take seconds are called Quick, the others Full.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "dem4grm/report/verification_manual.hpp"
#include "dem4grm/verify/runner.hpp"

namespace {

using namespace dem;

std::vector<const VerificationCase*> cases_of(Extent extent) {
  std::vector<const VerificationCase*> out;
  for (const VerificationCase& c : verification_cases()) {
    if (c.extent == extent) out.push_back(&c);
  }
  return out;
}

class Verification : public ::testing::TestWithParam<const VerificationCase*> {};

TEST_P(Verification, HoldsItsTolerances) {
  const CaseOutcome outcome = run_case_of_suite(*GetParam());
  EXPECT_EQ(outcome.missed(), 0) << verification_table_head() << verification_table_rows(outcome);
}

std::string test_name(const ::testing::TestParamInfo<const VerificationCase*>& tested) {
  std::string name = tested.param->name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Quick, Verification, ::testing::ValuesIn(cases_of(Extent::quick)), test_name);
INSTANTIATE_TEST_SUITE_P(Full, Verification, ::testing::ValuesIn(cases_of(Extent::full)), test_name);

TEST(VerificationSuite, NamesAreUniqueAndTextsAreThere) {
  std::set<std::string> names;
  for (const VerificationCase& c : verification_cases()) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    EXPECT_FALSE(c.title.empty()) << c.name;
    EXPECT_FALSE(c.text.empty()) << c.name;
  }
}

}  // namespace
