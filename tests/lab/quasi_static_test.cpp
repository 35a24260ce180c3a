// SPDX-License-Identifier: BSD-3-Clause
// Tests that choose their velocity: the recorded inertial number begins where it was asked for, the velocity is the same for
// any number of threads and after a stop, and the files say what it was. Not tested here: whether results depend on the
// velocity, which takes larger boxes than these.
#include <gtest/gtest.h>
#include <omp.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/lab/direct_shear.hpp"
#include "support/command_line.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

DirectShearCase chosen_case(double rubber_content, double inertial_number) {
  DirectShearCase test = test::tiny_shear_case(rubber_content, 0.020, 0.018);
  if (rubber_content == 1.0) test.specimen.generation_void_ratio = 1.2;  // walls on all sides cost rubber more room
  test.shear.velocity.reset();
  test.shear.inertial_number = inertial_number;
  test.shear.displacement = 0.1e-3;
  test.equilibrium.plate_speed = 5e-3;
  test.equilibrium.stress_tolerance = 0.02;
  test.equilibrium.hold_steps = 200;
  return test;
}

TEST(QuasiStatic, TheRecordBeginsWithTheNumberAskedFor) {
  for (const double rubber_content : {0.0, 0.3, 1.0}) {
    const DirectShearCase test = chosen_case(rubber_content, 5e-4);
    LabObserver silent;
    const DirectShearResult r = run_direct_shear(test, silent);
    ASSERT_EQ(r.rows.size(), 10U);
    // At most 1 % from rounding, and half of what the normal stress of a row is off.
    for (const ShearRow& row : r.rows) EXPECT_NEAR(row.inertial_number / 5e-4, 0.995, 0.025) << rubber_content;
    // By hand from the finished specimen, whose height is not the nominal one.
    const double rate = 5e-4 / (r.specimen.mean_size * std::sqrt(r.specimen.mean_density / 60e3));
    EXPECT_LE(r.shear_velocity, rate * r.specimen.height);
    EXPECT_GT(r.shear_velocity, 0.99 * rate * r.specimen.height);
    EXPECT_NE(r.specimen.height, test.box.height);
  }
}

/// Stops at the n-th offer of a checkpoint in shear.
struct StopInShear : LabObserver {
  int offers_left = -1;
  bool is_in_shear = false;
  std::optional<std::vector<StateEntry>> state;
  struct Stop {};
  void shear_row(const ShearRow& /*row*/) override { is_in_shear = true; }
  bool wants_checkpoint(bool /*is_new_stage*/) override { return is_in_shear && offers_left-- == 0; }
  void checkpoint(const StateArchive& archive) override {
    state = archive.entries();
    throw Stop{};
  }
};

TEST(QuasiStatic, GoesOnWithTheSameVelocityAndBits) {
  const DirectShearCase test = chosen_case(0.3, 5e-4);
  LabObserver silent;
  const DirectShearResult expected = run_direct_shear(test, silent);
  const int before = omp_get_max_threads();
  for (const int offer : {0, 1}) {
    StopInShear stopped;
    stopped.offers_left = offer;
    EXPECT_THROW(run_direct_shear(test, stopped), StopInShear::Stop);
    ASSERT_TRUE(stopped.state.has_value());
    StateArchive state(*stopped.state);
    omp_set_num_threads(2 + offer);
    const DirectShearResult resumed = run_direct_shear(test, silent, &state);
    omp_set_num_threads(before);
    EXPECT_EQ(resumed.shear_velocity, expected.shear_velocity);
    EXPECT_EQ(resumed.rows.back().inertial_number, expected.rows.back().inertial_number);
    EXPECT_EQ(resumed.state_hash, expected.state_hash);
  }
}

using test::CommandLine;
using test::ProgramResult;

TEST_F(CommandLine, AWordInPlaceOfTheVelocity) {
  const std::vector<std::string> settings{
      "--set", "shear.velocity=quasi-static", "--set", "shear.inertial_number=1e-3",
      "--set", "shear.displacement=0.3 mm",   "--set", "servo.shear_speed_cap=500 mm/s"};
  const auto with_settings = [&](std::vector<std::string> words) {
    words.insert(words.end(), settings.begin(), settings.end());
    return words;
  };
  const ProgramResult check = run(with_settings({"check", "tiny.toml", "--brief", "--json"}));
  ASSERT_EQ(check.exit_code, 0) << check.err;
  const JsonObject facts = parse_json(check.out, "check");
  EXPECT_TRUE(is_set_in(facts, "is_velocity_chosen"));
  EXPECT_NEAR(number_in(facts, "inertial_number"), 1e-3, 1e-5);
  EXPECT_NE(run(with_settings({"check", "tiny.toml", "--brief"})).out.find("chosen for the nominal height"),
            std::string::npos);

  const ProgramResult chosen = run(with_settings({"run", "tiny.toml", "-o", "chosen", "-j", "1"}));
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  const JsonObject summary = json("chosen/summary.json");
  const double velocity = number_in(summary, "shear_velocity_mm_per_s");
  EXPECT_EQ(text_in(summary, "shear_velocity_rule"), "quasi-static");
  EXPECT_EQ(number_in(summary, "inertial_number_target"), 1e-3);
  EXPECT_NEAR(number_in(summary, "inertial_number_max"), 1e-3, 1e-4);
  EXPECT_EQ(number_in(json("chosen/status.json"), "shear_velocity_mm_per_s"), velocity);
  for (const std::string& text : {chosen.err, chosen.out, test::read_all(folder_ / "chosen/run.log")}) {
    EXPECT_NE(text.find(fmt::format("{:g} mm/s", velocity)), std::string::npos) << text;
  }
  // The copy names the word, since the velocity belongs to the specimen; the folder is taken for finished by it.
  EXPECT_NE(test::read_all(folder_ / "chosen/resolved.toml").find("velocity = \"quasi-static\""), std::string::npos);
  EXPECT_NE(run(with_settings({"run", "tiny.toml", "-o", "chosen"})).out.find("nothing was computed"),
            std::string::npos);

  // Typed by hand it is the same test to the last bit; the plate's speed is the same in both.
  const ProgramResult by_hand = run({"run", "tiny.toml", "-o", "typed", "-j", "2", "--specimen", "chosen", "--set",
                                     fmt::format("shear.velocity={} mm/s", velocity), "--set",
                                     "servo.shear_speed_cap=500 mm/s", "--set", "shear.displacement=0.3 mm"});
  ASSERT_EQ(by_hand.exit_code, 0) << by_hand.err;
  EXPECT_EQ(test::read_all(folder_ / "typed/shear.csv"), test::read_all(folder_ / "chosen/shear.csv"));
  EXPECT_EQ(text_in(json("typed/summary.json"), "shear_velocity_rule"), "given");

  expect(65, "neither a speed with its unit, as \"1 mm/s\", nor \"quasi-static\"; did you mean",
         {"check", "tiny.toml", "--set", "shear.velocity=quasistatic"});
}

}  // namespace
}  // namespace dem
