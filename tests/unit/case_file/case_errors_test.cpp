// SPDX-License-Identifier: BSD-3-Clause
// Bad cases: each kind of mistake has its message, at its place, and all come at once.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

/// The message of a case that must be refused.
std::string refusal(std::string_view text, std::span<const Override> overrides = {}) {
  try {
    parse_case(text, "case.toml", overrides);
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_case);
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

/// The lines of a message that begin with a place, without their excerpts.
std::vector<std::string> headlines(const std::string& message) {
  std::vector<std::string> result;
  for (const std::string_view line : split_lines(message)) {
    if (line.find(": error: ") != std::string_view::npos) result.emplace_back(line);
  }
  return result;
}

/// A good case with lines added to or put in place of its own; the text of `section` follows its header.
std::string with(std::string_view section, std::string_view lines) {
  std::string text;
  for (const std::string_view name : {"specimen", "box", "gravel", "rubber", "rubber.bond", "shear"}) {
    text.append("[").append(name).append("]\n");
    if (name == section) text.append(lines).append("\n");
    if (name == "specimen" && lines.find("rubber_content") == std::string_view::npos) text += "rubber_content = 0.25\n";
    if (name == "specimen" && lines.find("gravel_grading") == std::string_view::npos) {
      text += "gravel_grading = [[\"3.5 mm\", 0.0], [\"8.5 mm\", 1.0]]\n";
    }
    if (name == "specimen") text += "rubber_grading = [[\"3.65 mm\", 0.0], [\"3.75 mm\", 1.0]]\n";
    if (name == "shear" && lines.find("normal_stress") == std::string_view::npos)
      text += "normal_stress = \"60 kPa\"\n";
  }
  return text;
}

/// The only headline of a case with these lines under [walls], without its place.
std::string with_walls(const std::string& lines) {
  const std::vector<std::string> found = headlines(refusal(with("shear", "") + "[walls]\n" + lines + "\n"));
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? "" : found[0].substr(found[0].find("error: "));
}

/// The only headline of a case with one mistake, without "case.toml:".
std::string mistake(std::string_view section, std::string_view lines) {
  const std::string message = refusal(with(section, lines));
  EXPECT_TRUE(message.ends_with("\n1 error, nothing was run")) << message;
  const std::vector<std::string> found = headlines(message);
  return found.empty() ? "" : found[0].substr(found[0].find(':') + 1);
}

TEST(CaseErrors, MessageHasPlaceLineCaretAndCount) {
  EXPECT_EQ(refusal(with("rubber", "friction = -0.27")),
            "case.toml:8:12: error: rubber.friction = -0.27 is outside [0, 5]\n"
            "    8 | friction = -0.27\n"
            "      |            ^^^^^ friction coefficient, no unit (published: 0.27)\n"
            "1 error, nothing was run");
}

TEST(CaseErrors, TheHelperCaseItselfIsGood) { EXPECT_NO_THROW(parse_case(with("", ""), "case.toml")); }

TEST(CaseErrors, UnknownNamesGetTheNearestOne) {
  EXPECT_EQ(mistake("gravel", "densiti = \"2710 kg/m3\""),
            "7:1: error: unknown key \"densiti\" in [gravel]; did you mean \"density\"?");
  EXPECT_EQ(mistake("rubber", "mu = 0.3"), "8:1: error: unknown key \"mu\" in [rubber]; did you mean \"friction\"?");
  EXPECT_EQ(mistake("box", "velocity = \"2 mm/s\""),
            "6:1: error: unknown key \"velocity\" in [box]; it belongs in [shear]");
  EXPECT_EQ(mistake("shear", "strain = 0.3"),
            "10:1: error: unknown key \"strain\" in [shear]; it belongs in [compression] of test = "
            "\"grain_compression\"");
  EXPECT_EQ(mistake("box", "xyzzy = 1"), "6:1: error: unknown key \"xyzzy\" in [box]");
  EXPECT_EQ(headlines(refusal("normal_stress = \"60 kPa\"\n" + with("", "")))[0],
            "case.toml:1:1: error: unknown key \"normal_stress\" before the first section; it belongs in [shear]");
  EXPECT_EQ(headlines(refusal(with("", "") + "[recordings]\ninterval = 3\n"))[0],
            "case.toml:11:2: error: unknown section [recordings]; did you mean [recording]?");
  EXPECT_EQ(mistake("shear", "moving_half = \"lowr\""),
            "10:15: error: shear.moving_half = \"lowr\" is not one of lower, upper, both; did you mean \"lower\"?");
}

TEST(CaseErrors, UnitsAreAskedFor) {
  EXPECT_EQ(mistake("shear", "normal_stress = 60"),
            "10:17: error: shear.normal_stress = 60 has no unit; write it as text with a unit, as \"60 kPa\"");
  EXPECT_EQ(mistake("shear", "normal_stress = \"60\""),
            "10:17: error: shear.normal_stress = \"60\" has no unit; a stress takes Pa, kPa, MPa, GPa or N/mm2");
  EXPECT_EQ(mistake("shear", "normal_stress = \"60 mm\""),
            "10:17: error: shear.normal_stress = \"60 mm\" is a length, not a stress; a stress takes Pa, kPa, MPa, GPa "
            "or N/mm2");
  EXPECT_EQ(mistake("shear", "velocity = \"2 mm/h\""),
            "10:12: error: shear.velocity = \"2 mm/h\" has the unknown unit \"mm/h\"; a speed takes mm/min, mm/s, cm/s "
            "or m/s");
  EXPECT_EQ(mistake("rubber", "friction = \"0.27\""),
            "8:12: error: rubber.friction = \"0.27\" is text; write the number without quotes: 0.27");
  EXPECT_EQ(mistake("specimen", "rubber_content = \"25 %\""),
            "2:18: error: specimen.rubber_content = \"25 %\" is in per cent; write a fraction: 0.25");
}

TEST(CaseErrors, RangesAndFractions) {
  EXPECT_EQ(mistake("specimen", "rubber_content = 1.2"),
            "2:18: error: specimen.rubber_content = 1.2 is outside [0, 1]");
  EXPECT_EQ(mistake("specimen", "rubber_content = 25"),
            "2:18: error: specimen.rubber_content = 25 is outside [0, 1]; a fraction: did you mean 0.25?");
  EXPECT_EQ(mistake("specimen", "rubber_content = nan"),
            "2:18: error: specimen.rubber_content = nan is outside [0, 1]");
  EXPECT_EQ(mistake("shear", "normal_stress = \"5 GPa\""),
            "10:17: error: shear.normal_stress = \"5 GPa\" is outside [100 Pa, 100 MPa]");
  EXPECT_EQ(mistake("rubber", "poisson_ratio = 0.6"), "8:17: error: rubber.poisson_ratio = 0.6 is outside [0, 0.5]");
  EXPECT_EQ(mistake("specimen", "gravel_clumps = 1.5"),
            "2:17: error: specimen.gravel_clumps = 1.5 must be a whole number");
  EXPECT_EQ(mistake("specimen", "gravel_clumps = 0"),
            "2:17: error: specimen.gravel_clumps = 0 does not go with rubber_content = 0.25");
}

TEST(CaseErrors, NothingIsRecordedMoreOftenThanTheRows) {
  for (const char* key : {"frame_interval", "micro_interval"}) {
    const std::string recording = "[recording]\ninterval = \"0.05 mm\"\n" + std::string(key) + " = \"0.02 mm\"\n";
    const std::vector<std::string> lines = headlines(refusal(with("", "") + recording));
    ASSERT_FALSE(lines.empty()) << key;
    EXPECT_EQ(lines[0].substr(lines[0].find("error")),
              "error: recording." + std::string(key) + " = 0.02 mm is shorter than recording.interval = 0.05 mm");
  }
}

TEST(CaseErrors, WrongKinds) {
  EXPECT_EQ(mistake("rubber.bond", "linear_spring = \"yes\""),
            "9:17: error: rubber.bond.linear_spring = \"yes\" must be true or false, without quotes");
  EXPECT_EQ(mistake("rubber", "friction = [0.27]"), "8:12: error: rubber.friction must be a plain number, not a list");
  EXPECT_EQ(mistake("rubber", "friction = 1979-05-27"),
            "8:12: error: rubber.friction must be a plain number, not a date");
  EXPECT_EQ(mistake("specimen", "clump_shapes = [\"T1\", \"T9\"]"),
            "2:23: error: specimen.clump_shapes = \"T9\" is not one of T1, T2, T3, T4, T5, T6, sphere; did you mean "
            "\"T1\"?");
  EXPECT_EQ(mistake("specimen", "clump_shapes = []"),
            "2:16: error: specimen.clump_shapes = [...] is empty; name at least one");
  EXPECT_EQ(mistake("gravel", "friction.x = 1"), "7:1: error: gravel.friction is a key, not a section");
  EXPECT_EQ(
      headlines(refusal("box = 3\n[specimen]\nrubber_content = 0.0\ngravel_grading = [[\"4 mm\", 0], [\"5 mm\", 1]]\n"
                        "[shear]\nnormal_stress = \"60 kPa\"\n"))[0],
      "case.toml:1:1: error: box is a section: write [box] on a line of its own, then its keys below");
}

TEST(CaseErrors, DensityOrFriction) {
  EXPECT_EQ(mistake("specimen", "relative_density = 0.5\npreparation_friction = 0.2"),
            "3:24: error: specimen.preparation_friction and specimen.relative_density exclude each other");
  EXPECT_EQ(mistake("specimen", "relative_density = 50"),
            "2:20: error: specimen.relative_density = 50 is outside [0.02, 0.98]");
  EXPECT_EQ(mistake("specimen", "smallest_friction = 2.5"),
            "2:21: error: specimen.smallest_friction = 2.5 must be 0.01 below specimen.largest_friction = 2");
  EXPECT_EQ(mistake("specimen", "load_steps = [\"60 kPa\", \"30 kPa\"]"),
            "2:14: error: specimen.load_steps must rise from entry to entry");
  EXPECT_EQ(mistake("specimen", "dr = 0.5"),
            "2:1: error: unknown key \"dr\" in [specimen]; did you mean \"relative_density\"?");
}

TEST(CaseErrors, OverlapsThatFollowFromStressAndModulus) {
  EXPECT_EQ(
      mistake("gravel", "shear_modulus = \"50 kPa\""),
      "7:17: error: gravel.shear_modulus = 50 kPa under a normal stress of 60 kPa makes balls overlap by about 2.3 of "
      "their radius: grains would pass through each other");
  const std::vector<std::string> warnings =
      parse_case(with("gravel", "shear_modulus = \"1 MPa\""), "case.toml").warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("overlap by about 0.32 of their radius"), std::string::npos) << warnings[0];
  EXPECT_TRUE(parse_case(with("gravel", "shear_modulus = \"20 MPa\""), "case.toml").warnings.empty());
}

TEST(CaseErrors, RulesBetweenKeys) {
  EXPECT_EQ(mistake("box", "width = \"16 mm\""),
            "6:9: error: box.width = 16 mm is less than 2 of the largest grains (8.5 mm): at least 17 mm");
  EXPECT_EQ(mistake("box", "upper_height = \"20 mm\""),
            "6:16: error: box.upper_height = 20 mm must be greater than half of box.height (26.5 mm)");
  EXPECT_EQ(mistake("box", "wing = \"10 mm\""),
            "6:8: error: shear.displacement = 14 mm is longer than box.wing = 10 mm: grains would fall out");
  EXPECT_EQ(mistake("box", "gap = \"3.5 mm\""),
            "6:7: error: box.gap = 3.5 mm lets grains out of the box: gravel of 3.5 mm and shape T5, whose thickest "
            "pebble is 2.766 mm");
  // A gap that a pebble gets into, but no grain through, is only warned about.
  const std::vector<std::string> warnings = parse_case(with("box", "gap = \"2.7 mm\""), "case.toml").warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("6:7: warning: box.gap = 2.7 mm lets parts of grains in, which may wedge: the smallest "
                             "pebbles or balls are 1.238 mm thick"),
            std::string::npos)
      << warnings[0];
  EXPECT_TRUE(parse_case(with("box", "gap = \"1.2 mm\""), "case.toml").warnings.empty());
  EXPECT_EQ(with_walls("plate_roughness = \"1 mm\""),
            "error: ribs 2 mm apart are finer than a fourth of the largest grains (8.5 mm): at least 2.13 mm");
  EXPECT_EQ(with_walls("plate_roughness = \"15 mm\"\nplate_roughness_pitch = \"40 mm\""),
            "error: walls.plate_roughness = 15 mm is more than a fourth of box.height = 53 mm");
  EXPECT_EQ(with_walls("plate_roughness = \"2 mm\"\nplate_roughness_pitch = \"60 mm\""),
            "error: ribs 60 mm apart do not fit a plate of 100 mm: at least two");
  EXPECT_NE(parse_case(with("shear", "") + "[walls]\nplate_roughness_pitch = \"4 mm\"\n", "case.toml")
                .warnings.at(0)
                .find("has no effect without walls.plate_roughness"),
            std::string::npos);
  EXPECT_EQ(mistake("rubber.bond", "tensile_strength = \"1 MPa\""),
            "9:20: error: rubber.bond.tensile_strength = 1 MPa needs rubber.bond.form = \"incremental\"");
  EXPECT_EQ(mistake("rubber.bond", "hertz_contact = true\nspring_friction = 0.3"),
            "9:17: error: rubber.bond.hertz_contact = true does not go with rubber.bond.spring_friction above 0");
  EXPECT_EQ(mistake("rubber.bond", "spring_friction = 0.3\nlinear_spring = false"),
            "9:19: error: rubber.bond.spring_friction needs rubber.bond.linear_spring = true");
  EXPECT_EQ(mistake("rubber.bond", "moment_scale = 0.05"),
            "9:16: error: rubber.bond.moment_scale = 0.05 is below 0.1 with rubber.bond.form = \"history_free\"");
  EXPECT_NO_THROW(parse_case(with("rubber.bond", "moment_scale = 0.1"), "case.toml"));
  EXPECT_NO_THROW(
      parse_case(with("rubber.bond", "form = \"incremental\"\nmoment_scale = 0.0\nshear_strength = \"1 MPa\""), "x"));
}

TEST(CaseErrors, GradingsAreChecked) {
  EXPECT_EQ(mistake("specimen", "gravel_grading = [[\"5 mm\", 0.0], [\"4 mm\", 1.0]]"),
            "2:35: error: specimen.gravel_grading: sieve sizes must increase: 4 mm after 5 mm");
  EXPECT_EQ(
      mistake("specimen", "gravel_grading = [[\"4 mm\", 0.0], [\"5 mm\", 0.5], [\"6 mm\", 0.4], [\"7 mm\", 1.0]]"),
      "2:58: error: specimen.gravel_grading: the share that passes must not fall: 0.4 after 0.5");
  EXPECT_EQ(mistake("specimen", "gravel_grading = [[4, 0.0], [\"5 mm\", 1.0]]"),
            "2:20: error: specimen.gravel_grading = 4 has no unit; write it as text with a unit, as \"4 mm\"");
  EXPECT_EQ(mistake("specimen", "gravel_grading = \"no-such.csv\""),
            "2:18: error: specimen.gravel_grading: no-such.csv: no such file");
  EXPECT_EQ(headlines(refusal("[specimen]\nrubber_content = 0.5\n[shear]\nnormal_stress = \"60 kPa\"\n")),
            (std::vector<std::string>{"case.toml:2:18: error: a specimen with gravel needs specimen.gravel_grading",
                                      "case.toml:2:18: error: a specimen with rubber needs specimen.rubber_grading"}));
}

TEST(CaseErrors, MissingSectionsAreNamed) {
  const std::vector<std::string> both{
      "case.toml:1:1: error: section [specimen] is missing; it must give rubber_content",
      "case.toml:1:1: error: section [shear] is missing; it must give normal_stress"};
  EXPECT_EQ(headlines(refusal("")), both);
  EXPECT_EQ(headlines(refusal("# nothing here\n")), both);
  EXPECT_EQ(headlines(refusal("[shear]\nvelocity = \"2 mm/s\"\n")),
            (std::vector<std::string>{both[0], "case.toml:1:2: error: [shear] does not give normal_stress"}));
}

TEST(CaseErrors, AllProblemsComeInTheOrderOfTheFile) {
  const std::string message = refusal(
      "[shear]\nnormal_stress = \"60\"\nvelocity = 2 mm/s\n[specimen]\nrubber_content = 25\n"
      "gravel_grading = \"x.csv\"\n[gravel]\nfrction = 0.3\nfriction = 9\n",
      std::vector<Override>{{"box.length", "3 kPa"}});
  const std::vector<std::string> found = headlines(message);
  ASSERT_EQ(found.size(), 7u) << message;
  EXPECT_TRUE(found[0].starts_with("case.toml:2:17: error: ")) << found[0];
  EXPECT_TRUE(found[1].starts_with("case.toml:3:12: error: ")) << found[1];
  EXPECT_TRUE(found[2].starts_with("case.toml:5:18: error: ")) << found[2];
  EXPECT_TRUE(found[3].starts_with("case.toml:6:18: error: ")) << found[3];
  EXPECT_TRUE(found[4].starts_with("case.toml:8:1: error: ")) << found[4];
  EXPECT_TRUE(found[5].starts_with("case.toml:9:12: error: ")) << found[5];
  EXPECT_EQ(
      found[6],
      "--set box.length=3 kPa: error: box.length = \"3 kPa\" is a stress, not a length; a length takes um, mm, cm "
      "or m");
  EXPECT_TRUE(message.ends_with("\n7 errors, nothing was run"));
}

TEST(CaseErrors, OptionsNameThemselves) {
  const auto option = [](std::string key, std::string value) {
    const std::vector<Override> options{{std::move(key), std::move(value)}};
    return headlines(refusal(with("", ""), options)).at(0);
  };
  EXPECT_EQ(
      option("shear.normal_stress", "5 kN"),
      "--set shear.normal_stress=5 kN: error: shear.normal_stress = \"5 kN\" has the unknown unit \"kN\"; a stress "
      "takes Pa, kPa, MPa, GPa or N/mm2");
  EXPECT_EQ(option("shear.velocty", "1"),
            "--set shear.velocty=1: error: unknown key \"velocty\" in [shear]; did you mean \"velocity\"?");
  EXPECT_EQ(option("shear", "1"), "--set shear=1: error: shear is a section, not a key");
  EXPECT_EQ(option("a..b", "1"),
            "--set a..b=1: error: not a key; write it as section.key=value, for example shear.normal_stress=60kPa");
  EXPECT_EQ(option("name", "a\nb"), "--set name=a?b: error: the value is not one line of UTF-8 text");
  EXPECT_EQ(option("name", "\xFF"), "--set name=?: error: the value is not one line of UTF-8 text");
  EXPECT_EQ(option("name", ""), "--set name=: error: name = \"\" is empty");
  EXPECT_EQ(option("specimen.gravel_grading", "[[1"),
            "--set specimen.gravel_grading=[[1: error: specimen.gravel_grading: [[1: no such file");
}

TEST(CaseErrors, FilesThatAreNotThere) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "dem4grm_case_errors";
  std::filesystem::create_directories(folder);
  EXPECT_THROW(load_case(folder / "no-such.toml"), MissingFileError);
  EXPECT_THROW(load_case(folder), MissingFileError);
  try {
    load_case(folder / "no-such.toml");
  } catch (const MissingFileError& error) {
    EXPECT_EQ(error.code(), ExitCode::missing_file);
    EXPECT_EQ(error.what(), (folder / "no-such.toml").string() + ": no such file");
  }
  std::ofstream(folder / "bad.csv") << "size_mm,passing_percent\n3,0\n3,50\n4,100\n";
  std::ofstream(folder / "case.toml") << "[specimen]\nrubber_content = 0\ngravel_grading = \"bad.csv\"\n[shear]\n"
                                         "normal_stress = \"60\"\n";
  try {
    load_case(folder / "case.toml");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    const std::vector<std::string> found = headlines(error.what());
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0], (folder / "bad.csv").string() + ":3:1: error: sieve sizes must increase: 3 mm after 3 mm");
    EXPECT_TRUE(found[1].starts_with((folder / "case.toml").string() + ":5:17: error: "));
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace dem
