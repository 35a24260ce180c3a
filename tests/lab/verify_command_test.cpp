// SPDX-License-Identifier: BSD-3-Clause
// `dem4grm verify` as a user meets it. Not tested here: what the cases find (tests/verification).
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::ProgramResult;

constexpr const char* k_example_case = "hertz-impact-spheres";

class VerifyCommand : public test::CommandLine {
 protected:
  /// The words of the example in the help, without the name of the program.
  [[nodiscard]] std::vector<std::string> example() const {
    const std::string help = run({"verify", "--help"}).out, mark = "Example:\n  dem4grm ";
    const std::size_t begin = help.find(mark);
    if (begin == std::string::npos) return {};
    std::istringstream words(help.substr(begin + mark.size()));
    return {std::istream_iterator<std::string>(words), {}};
  }
};

TEST_F(VerifyCommand, ListNamesTheCasesAndRunsNone) {
  const ProgramResult result = run({"verify", "--list"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::vector<std::string> names;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) names.push_back(line.substr(0, line.find(' ')));
  for (const char* name : {k_example_case, "free-top", "servo-approach", "energy-shear-test"}) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name << " in\n" << result.out;
  }
}

TEST_F(VerifyCommand, ExampleOfTheHelpRuns) {
  const std::vector<std::string> words = example();
  ASSERT_GE(words.size(), 3U) << "verify --only NAME";
  EXPECT_EQ(words.front(), "verify");
  const ProgramResult result = run(words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find(words.back()), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" in 1 cases, 0 missed"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("MISS"), std::string::npos) << result.out;
}

TEST_F(VerifyCommand, JsonIsAListOfCheckedQuantitiesAndNothingElse) {
  const ProgramResult result = run({"verify", "--only", k_example_case, "--only", "free-flight", "--json", "-j", "1"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json list = nlohmann::json::parse(result.out);  // throws on anything else on stdout
  ASSERT_TRUE(list.is_array());
  ASSERT_FALSE(list.empty());
  std::set<std::string> cases;
  for (const nlohmann::json& row : list) {
    cases.insert(row.at("case"));
    for (const char* name : {"quantity", "unit", "comparison", "source"}) {
      EXPECT_FALSE(row.at(name).get<std::string>().empty()) << name << " in " << row;
    }
    for (const char* name : {"expected", "obtained", "error", "tolerance"}) {
      EXPECT_TRUE(row.at(name).is_number()) << name << " in " << row;
    }
    EXPECT_TRUE(row.at("passed").get<bool>()) << row;
  }
  EXPECT_EQ(cases, (std::set<std::string>{"free-flight", k_example_case}));
}

TEST_F(VerifyCommand, UnknownCaseIsAUsageErrorThatNamesTheKnownOnes) {
  const ProgramResult result =
      expect(64, "no verification case 'hertz-impact'; there are:", {"verify", "--only", "hertz-impact"});
  EXPECT_NE(result.err.find(std::string("\n  ") + k_example_case + "\n"), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  // One wrong name among right ones: nothing is run.
  EXPECT_EQ(expect(64, "'no-such'", {"verify", "--only", k_example_case, "--only", "no-such"}).out, "");
  expect(64, "--only", {"verify", "--only"});
  expect(64, "1024", {"verify", "-j", "0"});
}

}  // namespace
}  // namespace dem
