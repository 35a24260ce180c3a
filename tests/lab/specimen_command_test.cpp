// SPDX-License-Identifier: BSD-3-Clause
// dem4grm specimen, and runs that start from a specimen, as a user types them.
#include <gtest/gtest.h>

#include "support/command_line.hpp"

namespace dem {
namespace {

using test::CommandLine;
using test::ProgramResult;

class SpecimenCommand : public CommandLine {
 protected:
  /// A search among so few grains scatters; its density need not be near.
  const std::vector<std::string> search_{"--set", "specimen.relative_density=0.5", "--set",
                                         "specimen.relative_density_tolerance=0.15"};
  void SetUp() override {
    CommandLine::SetUp();
    std::string text = test::read_all(folder_ / "tiny.toml");
    const std::string given = "preparation_friction = 0.3\n";
    test::write_all(folder_ / "search.toml", text.erase(text.find(given), given.size()));
  }
};

TEST_F(SpecimenCommand, MakesASpecimenThatRunGoesOnWith) {
  std::vector<std::string> make{"specimen", "search.toml", "-o", "out", "-j", "1"};
  make.insert(make.end(), search_.begin(), search_.end());
  const ProgramResult made = run(make);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("holds the specimen"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("e_min, e_max"), std::string::npos) << made.out;
  EXPECT_NE(made.err.find("relative density"), std::string::npos) << made.err;
  const JsonObject specimen = json("out/specimen.json");
  EXPECT_NEAR(number_in(specimen, "relative_density"), 0.5, 0.15);
  EXPECT_LT(number_in(specimen, "void_ratio_min"), number_in(specimen, "void_ratio_max"));
  EXPECT_EQ(text_in(json("out/status.json"), "state"), "specimen ready");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/summary.json"));
  EXPECT_EQ(run({"info", "out"}).exit_code, 0);

  const ProgramResult again = run(make);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.out.find("nothing was computed"), std::string::npos) << again.out;

  std::vector<std::string> shear = make;
  shear[0] = "run";
  const ProgramResult sheared = run(shear);
  ASSERT_EQ(sheared.exit_code, 0) << sheared.err;
  std::vector<std::string> straight = shear;
  straight[3] = "straight";
  ASSERT_EQ(run(straight).exit_code, 0);
  EXPECT_EQ(text_in(json("out/summary.json"), "state_hash"), text_in(json("straight/summary.json"), "state_hash"));
  EXPECT_EQ(test::read_all(folder_ / "out/shear.csv"), test::read_all(folder_ / "straight/shear.csv"));
}

TEST_F(SpecimenCommand, ASpecimenServesOtherShearTests) {
  ASSERT_EQ(run({"specimen", "tiny.toml", "-o", "made", "-q"}).exit_code, 0);
  const std::vector<std::string> faster{"run", "tiny.toml", "-q", "--set", "shear.velocity=400 mm/s", "-o"};
  std::vector<std::string> from_it = faster, straight = faster;
  from_it.insert(from_it.end(), {"a", "--specimen", "made"});
  straight.insert(straight.end(), {"b"});
  const ProgramResult result = run(from_it);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  ASSERT_EQ(run(straight).exit_code, 0);
  EXPECT_EQ(text_in(json("a/summary.json"), "state_hash"), text_in(json("b/summary.json"), "state_hash"));

  const ProgramResult other = run({"run", "tiny.toml", "-o", "c", "--specimen", "made/specimen.h5", "--set", "seed=4",
                                   "--set", "gravel.friction=0.5"});
  EXPECT_EQ(other.exit_code, 65) << other.err;
  EXPECT_NE(other.err.find("made with  seed = 3"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("the case has  gravel.friction = 0.5"), std::string::npos) << other.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "c"));
  EXPECT_EQ(run({"run", "tiny.toml", "-o", "c", "--specimen", "nowhere"}).exit_code, 66);
  test::write_all(folder_ / "broken.h5", "no specimen");
  EXPECT_EQ(run({"run", "tiny.toml", "-o", "c", "--specimen", "broken.h5"}).exit_code, 74);
}

TEST_F(SpecimenCommand, IsForShearTestsOnly) {
  ASSERT_EQ(run({"new", "grain_compression", "-o", "grain.toml"}).exit_code, 0);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"specimen", "grain.toml", "-o", "g"},
        std::vector<std::string>{"run", "grain.toml", "-o", "g", "--store", "s"},
        std::vector<std::string>{"run", "grain.toml", "-o", "g", "--specimen", "s"}}) {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.exit_code, 64) << result.err;
    EXPECT_NE(result.err.find("is no direct shear test"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "g"));
  }
}

TEST_F(SpecimenCommand, ANamedSpecimenReplacesAPreparationButNotShear) {
  ASSERT_EQ(run({"specimen", "tiny.toml", "-o", "made", "-q"}).exit_code, 0);
  // A folder whose preparation is done has a checkpoint that is not in shear yet, or just at its beginning.
  const std::vector<std::string> words{"run", "tiny.toml", "-o", "made", "--specimen", "made/specimen.h5"};
  const ProgramResult result = run(words);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("shear has begun already; the specimen that was named is not used"), std::string::npos)
      << result.err;
}

TEST_F(SpecimenCommand, AStoreIsShared) {
  ASSERT_EQ(run({"specimen", "tiny.toml", "-o", "one", "-q", "--store", "store"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "one/preparation"));
  ASSERT_EQ(run({"specimen", "tiny.toml", "-o", "two", "-q", "--store", "store"}).exit_code, 0);
  EXPECT_EQ(text_in(json("one/specimen.json"), "state_hash"), text_in(json("two/specimen.json"), "state_hash"));
  EXPECT_EQ(number_in(json("one/specimen.json"), "steps"), number_in(json("two/specimen.json"), "steps"));
  EXPECT_EQ(test::read_all(folder_ / "two/run.log").find("stage fill"), std::string::npos) << "the fill was kept";
}

}  // namespace
}  // namespace dem
