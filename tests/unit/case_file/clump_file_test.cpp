// SPDX-License-Identifier: BSD-3-Clause
// Clump shapes of the user: from CSV and from a case, every rule with its place, and what becomes of a good file.
// Not tested here: the mass properties of unions in general (clump_mass_properties_test.cpp).
#include "dem4grm/case_file/clump_file.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/case_file/toml_scan.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "support/run_program.hpp"
#include "unit/case_file/case_bits.hpp"

namespace dem {
namespace {

using Faults = std::vector<std::string>;
using testing_support::all_bits;

const std::filesystem::path k_example =
    std::filesystem::path(DEM_SOURCE_DIR) / "cases" / "clumps" / "example-shapes.csv";

Faults faults_of(std::string_view text) {
  Faults headlines;
  for (const std::string& problem : parse_clumps(text, "c.csv").problems) {
    headlines.emplace_back(split_lines(problem).front());
  }
  return headlines;
}

/// A pure gravel case whose [specimen] has further lines.
std::string case_with(const std::string& lines) {
  return "[specimen]\nrubber_content = 0\n" + lines +
         "\ngravel_grading = [[\"3.5 mm\", 0.0], [\"5 mm\", 1.0]]\n[box]\nlength = \"50 mm\"\nwidth = \"50 mm\"\n"
         "[shear]\nnormal_stress = \"60 kPa\"\n";
}

DirectShearCase case_of(const std::string& lines, std::span<const Override> overrides = {}) {
  return std::get<DirectShearCase>(parse_case(case_with(lines), "case.toml", overrides).test);
}

Faults refusals_of(const std::string& lines, const std::filesystem::path& file = "case.toml") {
  Faults found;
  try {
    parse_case(case_with(lines), file);
  } catch (const InputError& error) {
    for (const std::string_view line : split_lines(error.what())) {
      const std::size_t at = line.find(": error: ");
      if (at != std::string_view::npos) found.emplace_back(line.substr(at + 9));
    }
  }
  return found;
}

TEST(ClumpFile, ReadsShapesInOrder) {
  const ClumpFile file = parse_clumps(
      "\xEF\xBB\xBF# mine\r\nshape, x, y, z, radius\r\n\r\negg,0,0,0,2\r\n egg , 1.5,-1e-1,0 ,1\r\nball,9,9,9,0.5",
      "c.csv");
  ASSERT_TRUE(file.problems.empty()) << file.problems[0];
  ASSERT_EQ(file.shapes.size(), 2U);
  EXPECT_EQ(file.shapes[0].name, "egg");
  ASSERT_EQ(file.shapes[0].pebbles.size(), 2U);
  EXPECT_EQ(file.shapes[0].pebbles[1].position.x, 1.5);
  EXPECT_EQ(file.shapes[0].pebbles[1].position.y, -0.1);
  EXPECT_EQ(file.shapes[0].pebbles[1].radius, 1.0);
  EXPECT_EQ(file.shapes[1].name, "ball");
}

TEST(ClumpFile, AllProblemsComeAtOnceWithTheirPlaces) {
  const std::string apart = "the pebbles do not hang together: nothing joins pebble 2 to pebble 1";
  EXPECT_EQ(faults_of("shape,x,y,z,radius\n"
                      "apart,0,0,0,1\napart,2.1,0,0,1\n"          // 2 and 3: do not touch
                      "flat,0,0,0,0\n"                            // 4
                      "nest,0,0,0,2\nnest,0.5,0,0,1\n"            // 6 inside 5
                      "T3,0,0,0,1\n"                              // 7
                      "egg,0,0,0,1\nball,0,0,0,1\negg,1,0,0,1\n"  // 10 comes again
                      "odd name,0,0,2e6,1\n"),                    // 11
            (Faults{"c.csv:3:1: error: shape \"apart\": " + apart, "c.csv:4:12: error: radius 0 is not positive",
                    "c.csv:6:1: error: shape \"nest\": pebble 2 lies inside pebble 1 and can be left out",
                    "c.csv:7:1: error: \"T3\" is a shape of the program; choose another name",
                    "c.csv:10:1: error: shape \"egg\" is there already; the pebbles of one shape stand together",
                    "c.csv:11:1: error: \"odd name\" is no name for a shape: 1 to 40 letters, digits, '-', '_' or '.'",
                    "c.csv:11:14: error: place 2000000 is outside [-1e6, 1e6]; take another unit"}));
}

TEST(ClumpFile, RowsThatAreNoPebbles) {
  const std::string head = "shape,x,y,z,radius\n";
  EXPECT_EQ(faults_of(""), Faults{"c.csv:1:1: error: there is no shape; write one pebble a line below the header"});
  EXPECT_EQ(faults_of(head), Faults{"c.csv:1:1: error: there is no shape; write one pebble a line below the header"});
  EXPECT_EQ(faults_of("egg,0,0,0,1\n"),
            Faults{"c.csv:1:1: error: the first line must be the header \"shape,x,y,z,radius\""});
  EXPECT_EQ(faults_of(head + "egg;0;0;0;1\negg,0,0,0\negg,0,x,0,inf\negg,0,0,0,-1\n"),
            (Faults{"c.csv:2:1: error: 1 instead of 5 fields", "c.csv:3:1: error: 4 instead of 5 fields",
                    "c.csv:4:7: error: \"x\" is not a plain decimal number",
                    "c.csv:4:11: error: \"inf\" is not a plain decimal number"}));
  EXPECT_EQ(faults_of(head + "egg,0,0,0,-1\nbit,0,0,0,1e-7\n"),
            (Faults{"c.csv:2:11: error: radius -1 is not positive",
                    "c.csv:3:11: error: radius 1e-07 is outside [1e-6, 1e6]; take another unit"}));
  EXPECT_EQ(faults_of(std::string(k_largest_case_file + 1, 'x')).size(), 1U);
  EXPECT_FALSE(faults_of(std::string_view("\0\xff,\x80\n,,,,\n,,,,\n", 15)).empty());
  std::string many = head;
  for (int k = 0; k < 1500; ++k) many += "row," + std::to_string(k) + ",0,0,0.6\n";
  EXPECT_EQ(faults_of(many), Faults{"c.csv:1002:1: error: more than 1000 pebbles"});
  EXPECT_THROW(read_clump_file("no-such.csv"), MissingFileError);
}

/// Volume of two overlapping spheres at distance c: both minus the lens they share (closed form of the lens from two
/// caps of heights ha and hb).
double volume_of_pair(double a, double b, double c) {
  const double from_a = (c * c + a * a - b * b) / (2 * c), ha = a - from_a, hb = b - (c - from_a);
  const auto cap = [](double r, double h) { return std::numbers::pi * h * h * (r - h / 3.0); };
  return 4.0 / 3.0 * std::numbers::pi * (a * a * a + b * b * b) - cap(a, ha) - cap(b, hb);
}

/// Volume of the union by counting the points of a fine grid that lie in a pebble.
double counted_volume(const ClumpTemplate& shape) {
  constexpr int k_points = 160;
  const double half = shape.bounding_radius, step = 2.0 * half / k_points;
  int inside = 0;
  for (int k = 0; k < k_points * k_points * k_points; ++k) {
    const int x = k % k_points, y = k / k_points % k_points, z = k / (k_points * k_points);
    const Vec3 p{(x + 0.5) * step - half, (y + 0.5) * step - half, (z + 0.5) * step - half};
    for (const Pebble& pebble : shape.pebbles) {
      const Vec3 d = p - pebble.position;
      if (dot(d, d) > pebble.radius * pebble.radius) continue;
      ++inside;
      break;
    }
  }
  return inside * step * step * step;
}

TEST(ClumpFile, ExampleBecomesGrainsOfTheRightVolume) {
  const ClumpFile file = read_clump_file(k_example);
  ASSERT_TRUE(file.problems.empty()) << file.problems[0];
  ASSERT_EQ(file.shapes.size(), 3U);
  SpecimenSettings settings;
  settings.gravel_grading = {{3.5e-3, 0.0}, {5e-3, 1.0}};
  settings.clump_templates = file.shapes;
  settings.clump_shapes = {"egg", "bean", "dice", "T1"};
  const GrainList list = draw_grains(settings, {.length = 0.05, .width = 0.05}, 1610.0, 1150.0, 1);
  ASSERT_EQ(list.shapes.size(), 4U);
  // The egg passes lengthwise, so its sieve size is the diameter of its large end.
  EXPECT_NEAR(list.shapes[0].volume, volume_of_pair(2.6, 2.0, 1.4) / std::pow(5.2, 3), 1e-3 * list.shapes[0].volume);
  // Eight balls of radius 1.6 on the corners of a cube of edge 2 pass a square of 2 + 2 * 1.6.
  EXPECT_NEAR(list.shapes[2].pebbles.at(0).radius, 1.6 / 5.2, 1e-8);
  for (std::size_t shape = 0; shape < 3; ++shape) {
    EXPECT_NEAR(list.shapes[shape].volume / counted_volume(list.shapes[shape]), 1.0, 1e-3) << file.shapes[shape].name;
  }
  std::vector<double> volume(4);
  for (const GravelGrain& grain : list.gravel) {
    const auto shape = static_cast<std::size_t>(grain.shape);
    volume[shape] += list.shapes[shape].volume * std::pow(grain.sieve_size, 3);
  }
  for (const double of_shape : volume) EXPECT_NEAR(of_shape / list.gravel_volume, 0.25, 0.01);
}

TEST(ClumpFile, UnitAndFrameOfAShapeDoNotMatter) {
  SpecimenSettings settings;
  settings.gravel_grading = {{3.5e-3, 0.0}, {5e-3, 1.0}};
  settings.clump_shapes = {"a", "b"};
  settings.clump_templates = {{"a", {{{0, 0, 0}, 1.0}, {{1.2, 0, 0}, 0.7}}},
                              {"b", {{{5, 30, 3}, 10.0}, {{5, 30, 15}, 7.0}}}};
  const GrainList list = draw_grains(settings, {.length = 0.05, .width = 0.05}, 1610.0, 1150.0, 1);
  EXPECT_NEAR(list.shapes[0].volume, list.shapes[1].volume, 1e-5 * list.shapes[0].volume);
  EXPECT_NEAR(list.shapes[0].moment_of_inertia.z, list.shapes[1].moment_of_inertia.z, 1e-6);
}

TEST(ClumpShares, AreMetWhateverTheyAre) {
  SpecimenSettings settings;
  settings.gravel_grading = {{3.0e-3, 0.0}, {5.6e-3, 0.5}, {8.8e-3, 1.0}};
  settings.clump_shapes = {"T4", "T5", "sphere"};
  for (const std::vector<double>& shares : std::vector<std::vector<double>>{{0.7, 0.25, 0.05}, {0.01, 0.01, 0.98}}) {
    settings.clump_shares = shares;
    const GrainList list = draw_grains(settings, {}, 1610.0, 1150.0, 3);
    std::vector<double> volume(3);
    for (const GravelGrain& grain : list.gravel) {
      const auto shape = static_cast<std::size_t>(grain.shape);
      volume[shape] += list.shapes[shape].volume * std::pow(grain.sieve_size, 3) / list.gravel_volume;
    }
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(volume[k], shares[k], 0.004) << k;
  }
  settings.clump_shares = {0.5, 0.5};
  EXPECT_THROW(draw_grains(settings, {}, 1610.0, 1150.0, 3), InputError);
  settings.clump_shares = {0.5, 0.5, 0.0};
  EXPECT_THROW(draw_grains(settings, {}, 1610.0, 1150.0, 3), InputError);
}

TEST(ClumpShares, EqualSharesAreTheDefaultToTheLastBit) {
  SpecimenSettings settings;
  settings.gravel_grading = {{3.0e-3, 0.0}, {8.8e-3, 1.0}};
  const GrainList plain = draw_grains(settings, {}, 1610.0, 1150.0, 3);
  settings.clump_shares.assign(6, 0.125);  // exact in binary
  const GrainList shared = draw_grains(settings, {}, 1610.0, 1150.0, 3);
  ASSERT_EQ(plain.gravel.size(), shared.gravel.size());
  for (std::size_t k = 0; k < plain.gravel.size(); ++k) {
    EXPECT_EQ(plain.gravel[k].shape, shared.gravel[k].shape);
    EXPECT_EQ(plain.gravel[k].sieve_size, shared.gravel[k].sieve_size);
  }
}

TEST(ClumpKeys, FileAndListGiveTheSameGrainsAndTheResolvedCaseStandsAlone) {
  const std::string lines =
      "clump_templates = \"" + k_example.string() + "\"\nclump_shapes = [\"egg\", \"T2\"]\nclump_shares = [0.4, 0.6]\n";
  const LoadedCase loaded = parse_case(case_with(lines), "case.toml");
  EXPECT_TRUE(loaded.warnings.empty());
  const auto& test = std::get<DirectShearCase>(loaded.test);
  EXPECT_EQ(test.specimen.clump_templates.size(), 3U);
  EXPECT_EQ(test.specimen.clump_shapes, (std::vector<std::string>{"egg", "T2"}));
  EXPECT_EQ(test.specimen.clump_shares, (std::vector<double>{0.4, 0.6}));
  const LoadedCase again = parse_case(loaded.resolved_toml, "elsewhere/resolved.toml");
  EXPECT_EQ(all_bits(test), all_bits(std::get<DirectShearCase>(again.test)));
  EXPECT_EQ(loaded.resolved_toml, again.resolved_toml);
  EXPECT_NE(loaded.resolved_toml.find("[\"egg\", 1.4, 0.0, 0.0, 2.0],"), std::string::npos);
}

TEST(ClumpKeys, OptionsTakeShapesAndShares) {
  const DirectShearCase test = case_of(
      "", std::vector<Override>{{"specimen.clump_templates", "[[\"egg\", 0, 0, 0, 2], [\"egg\", 1, 0, 0, 1.5]]"},
                                {"specimen.clump_shapes", "egg, sphere"},
                                {"specimen.clump_shares", "0.25, 0.75"}});
  EXPECT_EQ(test.specimen.clump_templates.at(0).pebbles.at(1).radius, 1.5);
  EXPECT_EQ(test.specimen.clump_shapes, (std::vector<std::string>{"egg", "sphere"}));
  EXPECT_EQ(test.specimen.clump_shares, (std::vector<double>{0.25, 0.75}));
}

TEST(ClumpKeys, ProblemsOfFileListNamesAndSharesComeTogether) {
  const test::TemporaryFolder folder;
  test::write_all(folder / "bad.csv", "shape,x,y,z,radius\negg,0,0,0,1\negg,3,0,0,1\nflat,0,0,0,0\n");
  EXPECT_EQ(refusals_of("clump_templates = \"bad.csv\"\nclump_shapes = [\"egg\", \"eg\"]\nclump_shares = [\"1\"]\n",
                        folder / "case.toml"),
            (Faults{"shape \"egg\": the pebbles do not hang together: nothing joins pebble 2 to pebble 1",
                    "radius 0 is not positive",
                    "specimen.clump_shapes = \"eg\" is not one of T1, T2, T3, T4, T5, T6, sphere, egg, flat; did you "
                    "mean \"egg\"?",
                    "specimen.clump_shares = \"1\" is text; write the number without quotes: 1"}));
  // Of a file that is not there nobody knows the names.
  const Faults missing =
      refusals_of("clump_templates = \"none.csv\"\nclump_shapes = [\"egg\"]\n", folder / "case.toml");
  ASSERT_EQ(missing.size(), 1U);
  EXPECT_NE(missing[0].find("none.csv"), std::string::npos);
  EXPECT_EQ(refusals_of("clump_templates = [[\"egg\", 0, 0, 0], [\"T1\", 0, 0, 0, 1]]\n"),
            Faults{"specimen.clump_templates: every pebble is [shape, x, y, z, radius], as [\"egg\", 0, 0, 0, 1]"});
  EXPECT_EQ(refusals_of("clump_templates = [[\"T1\", 0, 0, 0, 1], [\"egg\", 0, 0, 0, -1]]\n"),
            (Faults{"specimen.clump_templates: \"T1\" is a shape of the program; choose another name",
                    "specimen.clump_templates: radius -1 is not positive"}));
}

TEST(ClumpKeys, SharesFitTheShapes) {
  EXPECT_EQ(refusals_of("clump_shares = [0.5, 0.5]\n"),
            Faults{"specimen.clump_shares gives 2 share(s) for 6 clump_shapes"});
  EXPECT_EQ(refusals_of("clump_shapes = [\"T1\", \"T2\"]\nclump_shares = [0.5, 0.6]\n"),
            Faults{"specimen.clump_shares add up to 1.1, not to 1"});
  EXPECT_EQ(refusals_of("clump_shapes = [\"T1\", \"T2\"]\nclump_shares = [50, 0.5]\n"),
            Faults{"specimen.clump_shares = 50 is outside [0.0001, 1]"});
  EXPECT_EQ(case_of("clump_shapes = [\"T1\", \"T2\", \"T3\"]\nclump_shares = [0.33, 0.33, 0.33]\n")
                .specimen.clump_shares.size(),
            3U);
}

TEST(ClumpKeys, ShapesThatAreNotUsedAreMentioned) {
  const LoadedCase loaded = parse_case(case_with("clump_templates = [[\"egg\", 0, 0, 0, 1]]\n"), "case.toml");
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_NE(loaded.warnings[0].find("clump_shapes names none of the shapes"), std::string::npos);
}

}  // namespace
}  // namespace dem
