// SPDX-License-Identifier: BSD-3-Clause
// The shear velocity in a case: a speed or the word, what is said of other values, and the inertial number beside it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "unit/case_file/case_bits.hpp"

namespace dem {
namespace {

/// A case that ends with these lines of [shear], the first of which is line 7.
LoadedCase load(const std::string& lines, const std::vector<Override>& options = {}) {
  const std::string text = R"([specimen]
rubber_content = 0.25
gravel_grading = [["3.5 mm", 0.0], ["8.5 mm", 1.0]]
rubber_grading = [["3.65 mm", 0.0], ["3.75 mm", 1.0]]
[shear]
normal_stress = "60 kPa"
)";
  return parse_case(text + lines + "\n", "case.toml", options);
}

ShearSettings shear_of(const LoadedCase& loaded) { return std::get<DirectShearCase>(loaded.test).shear; }

/// The message of a case that must be refused; its first line where only that counts.
std::string refusal_of_velocity(const std::string& lines, const std::vector<Override>& options = {}) {
  try {
    load(lines, options);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << lines;
  return {};
}

std::string headline(const std::string& lines, const std::vector<Override>& options = {}) {
  const std::string message = refusal_of_velocity(lines, options);
  return message.substr(0, message.find('\n'));
}

std::vector<std::string> bits(const LoadedCase& loaded) {
  return testing_support::all_bits(std::get<DirectShearCase>(loaded.test));
}

TEST(CaseVelocity, MayBeLeftToAnInertialNumber) {
  const LoadedCase loaded = load("velocity = \"quasi-static\"");
  EXPECT_FALSE(shear_of(loaded).velocity);
  EXPECT_EQ(shear_of(loaded).inertial_number, 5e-5);
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(shear_of(load("velocity = \"quasi-static\"\ninertial_number = 2e-5")).inertial_number, 2e-5);
  EXPECT_EQ(shear_of(load("")).velocity, 0.002) << "the published velocity stays the default";
  EXPECT_FALSE(shear_of(load("")).inertial_number);
}

TEST(CaseVelocity, OptionsTakeTheWordInPlaceOfASpeedAndTheOtherWayRound) {
  const LoadedCase chosen = load("velocity = \"2 mm/s\"", {{"shear.velocity", "quasi-static"}});
  EXPECT_FALSE(shear_of(chosen).velocity);
  EXPECT_FALSE(shear_of(load("", {{"shear.velocity", "\"quasi-static\""}})).velocity);
  EXPECT_EQ(shear_of(load("velocity = \"quasi-static\"", {{"shear.velocity", "3 mm/s"}})).velocity, 0.003);
}

TEST(CaseVelocity, ResolvedCopyKeepsTheWordAndTheNumber) {
  for (const std::string lines : {"velocity = \"quasi-static\"", "velocity = \"quasi-static\"\ninertial_number = 8e-5",
                                  "velocity = \"2.68 mm/s\"", ""}) {
    const LoadedCase loaded = load(lines);
    const LoadedCase again = parse_case(loaded.resolved_toml, "resolved.toml");
    EXPECT_EQ(bits(again), bits(loaded)) << lines;
    EXPECT_EQ(again.resolved_toml, loaded.resolved_toml) << lines;
    EXPECT_TRUE(again.warnings.empty()) << lines;
  }
  const std::string resolved = load("velocity = \"quasi-static\"").resolved_toml;
  EXPECT_NE(resolved.find("\nvelocity = \"quasi-static\"  # "), std::string::npos) << resolved;
  EXPECT_NE(resolved.find("\ninertial_number = 0.00005  # "), std::string::npos) << resolved;
}

TEST(CaseVelocity, AnyOtherWordIsToldBothForms) {
  const std::string neither = " is neither a speed with its unit, as \"1 mm/s\", nor \"quasi-static\"";
  EXPECT_EQ(headline("velocity = \"quasistatic\""),
            "case.toml:7:12: error: shear.velocity = \"quasistatic\"" + neither + "; did you mean \"quasi-static\"?");
  EXPECT_EQ(headline("velocity = \"Quasi-Static\""),
            "case.toml:7:12: error: shear.velocity = \"Quasi-Static\"" + neither + "; did you mean \"quasi-static\"?");
  EXPECT_EQ(headline("velocity = \"slow\""), "case.toml:7:12: error: shear.velocity = \"slow\"" + neither);
  EXPECT_EQ(
      headline("", {{"shear.velocity", "quasi"}}),
      "--set shear.velocity=quasi: error: shear.velocity = \"quasi\"" + neither + "; did you mean \"quasi-static\"?");
  EXPECT_NE(
      refusal_of_velocity("velocity = \"slow\"").find("or \"quasi-static\": chosen for inertial_number, unit mm/min"),
      std::string::npos);
}

TEST(CaseVelocity, NumbersHaveTheMessagesOfOrdinaryQuantities) {
  EXPECT_EQ(headline("velocity = 2"),
            "case.toml:7:12: error: shear.velocity = 2 has no unit; write it as text with a unit, as \"2 mm/s\"");
  EXPECT_EQ(
      headline("velocity = \"2 m\""),
      "case.toml:7:12: error: shear.velocity = \"2 m\" is a length, not a speed; a speed takes mm/min, mm/s, cm/s "
      "or m/s");
  EXPECT_EQ(headline("velocity = \"9 m/s\""),
            "case.toml:7:12: error: shear.velocity = \"9 m/s\" is outside [0.001 mm/s, 1000 mm/s]");
  EXPECT_EQ(headline("velocity = true"),
            "case.toml:7:12: error: shear.velocity = true must be text with a unit, as \"1 mm/s\"");
  EXPECT_EQ(headline("inertial_number = 2e-3"),
            "case.toml:7:19: error: shear.inertial_number = 0.002 is outside [1e-6, 0.001]");
}

TEST(CaseVelocity, WarnsOfANumberThatIsLargeOrWithoutEffect) {
  const LoadedCase fast = load("velocity = \"quasi-static\"\ninertial_number = 2e-4");
  ASSERT_EQ(fast.warnings.size(), 1U);
  EXPECT_TRUE(fast.warnings[0].starts_with(
      "case.toml:8:19: warning: shear.inertial_number = 0.0002 is above 0.0001: not quasi-static beyond doubt"))
      << fast.warnings[0];
  EXPECT_TRUE(load("velocity = \"quasi-static\"\ninertial_number = 1e-4").warnings.empty());
  const LoadedCase both = load("velocity = \"2 mm/s\"\ninertial_number = 5e-5");
  ASSERT_EQ(both.warnings.size(), 1U);
  EXPECT_TRUE(both.warnings[0].starts_with(
      "case.toml:8:19: warning: shear.inertial_number has no effect beside shear.velocity = 2 mm/s"))
      << both.warnings[0];
}

}  // namespace
}  // namespace dem
