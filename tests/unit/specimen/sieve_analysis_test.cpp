// SPDX-License-Identifier: BSD-3-Clause
// Simulated sieve analysis: known grains against sizes and volumes in closed form, shares against hand counts, drawn
// specimens of full and of tiny size against their gradings.
// Not tested here: the file that a state comes from (tests/unit/results/sieve_report_test.cpp).
#include "dem4grm/specimen/sieve_analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "support/drawn_packing.hpp"

namespace dem {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_rubber_density = 1610.0, k_solid_density = 1150.0;

/// Clumps of these pebbles, each turned and moved at random.
Packing turned(const std::vector<std::vector<Pebble>>& clumps, std::uint64_t seed = 1) {
  Packing packing;
  int body = 0;
  for (const std::vector<Pebble>& pebbles : clumps) {
    RandomSequence random(seed, RandomStream::test, static_cast<std::uint64_t>(body));
    const Frame frame = frame_of(random.orientation());
    const Vec3 at{random.uniform(0, 0.1), random.uniform(0, 0.1), random.uniform(0, 0.1)};
    for (const Pebble& p : pebbles) {
      packing.position.push_back(at + to_space(frame, p.position));
      packing.radius.push_back(p.radius);
      packing.body.push_back(body);
    }
    ++body;
  }
  return packing;
}

std::vector<Pebble> pair(double radius, double distance) { return {{{0, 0, 0}, radius}, {{distance, 0, 0}, radius}}; }

std::vector<Pebble> triangle(double radius, double edge) {
  return {{{0, 0, 0}, radius}, {{edge, 0, 0}, radius}, {{0.5 * edge, 0.5 * std::sqrt(3.0) * edge, 0}, radius}};
}

TEST(SieveAnalysis, KnownClumpsHaveTheirCaliperSizes) {
  const double r = 2.5e-3;
  const MeasuredGrains grains = measure_grains(
      turned({{{{0, 0, 0}, r}}, pair(r, 2e-3), pair(2 * r, 4e-3), pair(r, 2.1e-3), triangle(r, 0.7 * r)}),
      k_rubber_density, k_solid_density);
  ASSERT_EQ(grains.gravel.size(), 5U);
  // Sphere: diameter. Pairs pass lengthwise: the diameter too. Triangle of edge e on its corner in the opening:
  // 2 R + e sqrt(6) / 4 (docs/theory/clumps.md).
  EXPECT_NEAR(grains.gravel[0].size, 2 * r, 1e-10);
  EXPECT_NEAR(grains.gravel[1].size, 2 * r, 1e-10);
  EXPECT_NEAR(grains.gravel[2].size, 4 * r, 1e-10);
  EXPECT_NEAR(grains.gravel[3].size, 2 * r, 1e-10);
  EXPECT_NEAR(grains.gravel[4].size, 2 * r + 0.7 * r * std::sqrt(6.0) / 4.0, 1e-9);
  // Union of two equal spheres at distance c: 8/3 pi R^3 - pi/12 (4R + c) (2R - c)^2.
  const auto two = [](double a, double c) {
    return 8.0 / 3.0 * k_pi * a * a * a - k_pi / 12.0 * (4 * a + c) * (2 * a - c) * (2 * a - c);
  };
  EXPECT_NEAR(grains.gravel[0].volume / (4.0 / 3.0 * k_pi * r * r * r), 1.0, 1e-12);
  EXPECT_NEAR(grains.gravel[1].volume / two(r, 2e-3), 1.0, 1e-4);
  EXPECT_NEAR(grains.gravel[2].volume / two(2 * r, 4e-3), 1.0, 1e-4);
  EXPECT_NEAR(grains.gravel[3].volume / two(r, 2.1e-3), 1.0, 1e-4);
}

TEST(SieveAnalysis, ShapesThatAreNearlyAlikeAreToldApart) {
  // The second triangle is a millionth larger in its edge; the third is the first at twice the size.
  const double r = 1e-3, edge = 1.2e-3, longer = edge * (1.0 + 1e-6);
  const MeasuredGrains grains = measure_grains(
      turned({triangle(r, edge), triangle(r, longer), triangle(2 * r, 2 * edge)}), k_rubber_density, k_solid_density);
  EXPECT_NEAR((grains.gravel[1].size - grains.gravel[0].size) / ((longer - edge) * std::sqrt(6.0) / 4.0), 1.0, 0.02);
  EXPECT_NEAR(grains.gravel[2].size / grains.gravel[0].size, 2.0, 1e-9);
  EXPECT_NEAR(grains.gravel[2].volume / grains.gravel[0].volume, 8.0, 1e-9);
}

TEST(SieveAnalysis, RubberGoesByTheRadiusOfItsBalls) {
  Packing packing;
  packing.n_rubber_grains = 2;
  for (const double radius : {0.5e-3, 0.627e-3}) {
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      packing.position.push_back({});
      packing.radius.push_back(radius);
      packing.body.push_back(radius > 0.6e-3 ? 1 : 0);
    }
  }
  const MeasuredGrains grains = measure_grains(packing, k_rubber_density, k_solid_density);
  ASSERT_EQ(grains.rubber.size(), 2U);
  EXPECT_NEAR(grains.rubber[0].size / (5.899 * 0.5e-3), 1.0, 1e-4);  // 5.899 r and 205.25 r^3 (spec of the model)
  EXPECT_NEAR(grains.rubber[1].volume / (205.25 * std::pow(0.627e-3, 3)), 1.0, 1e-4);
  EXPECT_TRUE(grains.gravel.empty());
}

TEST(SieveAnalysis, SharesOfAFewGrainsByHand) {
  // Volumes 1, 2, 5 of sizes 3, 4, 6 mm: 0, 1/8, 3/8, 1.
  const std::vector<MeasuredGrain> grains{{6e-3, 5.0}, {3e-3, 1.0}, {4e-3, 2.0}};
  EXPECT_EQ(share_passing(grains, 2.999e-3), 0.0);
  EXPECT_EQ(share_passing(grains, 3e-3), 0.125);
  EXPECT_EQ(share_passing(grains, 5.9e-3), 0.375);
  EXPECT_EQ(share_passing(grains, 6e-3), 1.0);
  EXPECT_EQ(share_passing({}, 1.0), 0.0);
  // Middles of the shares at 1/16, 1/4 and 11/16.
  EXPECT_NEAR(opening_for_share(grains, 0.25), 4e-3, 1e-15);
  EXPECT_NEAR(opening_for_share(grains, 0.5), 4e-3 + 2e-3 * (0.25 / 0.4375), 1e-12);
  EXPECT_EQ(opening_for_share(grains, 0.01), 3e-3);
  EXPECT_EQ(opening_for_share(grains, 0.99), 6e-3);
  EXPECT_THROW(opening_for_share({}, 0.5), InputError);
}

TEST(SieveAnalysis, TogetherCountsMassNotVolume) {
  // Equal volumes; gravel twice as dense as rubber: a third of the mass is rubber, which alone passes 4 mm.
  MeasuredGrains grains;
  grains.gravel = {{6e-3, 1.0}};
  grains.rubber = {{3e-3, 1.0}};
  SieveInput input;
  input.gravel = {{5e-3, 0.0}, {7e-3, 1.0}};
  input.rubber = {{2e-3, 0.0}, {4e-3, 1.0}};
  input.gravel_density = 2000.0;
  input.solid_density = 1000.0;
  input.rubber_content = 0.4;  // asked for less than there is
  const SieveTable table = sieve_table(grains, input, {7e-3, 4e-3, 4e-3, 6e-3});
  EXPECT_EQ(table.openings, (std::vector<double>{4e-3, 6e-3, 7e-3}));
  EXPECT_NEAR(table.together.measured[0], 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(table.together.asked[0], 0.4 / (0.4 + 1.2), 1e-15);
  EXPECT_EQ(table.gravel.measured, (std::vector<double>{0.0, 1.0, 1.0}));
  EXPECT_NEAR(table.gravel.asked[1], 0.5, 1e-12);
  EXPECT_NEAR(table.gravel.largest_difference(), 0.5, 1e-12);
  input.is_content_asked = false;
  EXPECT_NEAR(sieve_table(grains, input, {4e-3}).together.asked[0], 1.0 / 3.0, 1e-15);
  grains.rubber.clear();
  EXPECT_FALSE(sieve_table(grains, input, {4e-3}).together.is_there());
  EXPECT_FALSE(sieve_table(grains, input, {4e-3}).rubber.is_there());
}

/// Analysis of the drawn grains of a shipped case, turned at random.
struct Analysis {
  MeasuredGrains grains;
  SieveTable table;
};

Analysis analysis_of(const char* rubber_content, std::vector<Override> changes = {}) {
  changes.push_back({"specimen.rubber_content", rubber_content});
  const LoadedCase loaded = load_case(std::filesystem::path(DEM_SOURCE_DIR) / "cases/paper/direct-shear.toml", changes);
  const auto& test = std::get<DirectShearCase>(loaded.test);
  const MeasuredGrains grains =
      measure_grains(packing_of(Simulation(test::drawn_scene(test))), test.rubber.density, test.rubber_solid_density);
  const SieveInput input{test.specimen.gravel_grading, test.specimen.rubber_grading, test.gravel.density,
                         test.rubber_solid_density,    test.specimen.rubber_content, true};
  return {grains, sieve_table(grains, input, usual_sieves(grains, input))};
}

TEST(SieveAnalysis, FullSizeSpecimensReturnTheirGradings) {
  const Analysis gravel = analysis_of("0");
  EXPECT_GT(gravel.grains.gravel.size(), 4000U);
  ASSERT_EQ(gravel.table.openings.size(), 14U);
  // Wanted are 2 points, of a mixture 3; the walk along the mass axis leaves about 0.1.
  EXPECT_LT(gravel.table.gravel.largest_difference(), 0.005);
  EXPECT_NEAR(gravel.table.gravel.measured[7], 0.594, 0.02);  // of the shipped table at 6 mm
  const Analysis mixture = analysis_of("0.4");
  EXPECT_LT(mixture.table.gravel.largest_difference(), 0.005);
  EXPECT_LT(mixture.table.rubber.largest_difference(), 0.005);
  EXPECT_LT(mixture.table.together.largest_difference(), 0.005);
}

TEST(SieveAnalysis, RubberOfManySizesReturnsItsGrading) {
  const std::vector<Override> changes{{"specimen.rubber_grading", "../gradings/rubber-wide.csv"}};
  const Analysis mixture = analysis_of("0.4", changes);
  EXPECT_LT(mixture.table.gravel.largest_difference(), 0.005);
  EXPECT_LT(mixture.table.rubber.largest_difference(), 0.01);  // runs of eight grains
}

TEST(SieveAnalysis, SmallNumbersReturnTheirGradingsToo) {
  for (const char* count : {"30", "100", "400"}) {
    for (const char* file : {"gravel-narrow.csv", "gravel-rounded.csv", "gravel-wide.csv"}) {
      const std::vector<Override> changes{{"specimen.gravel_clumps", count},
                                          {"specimen.gravel_grading", std::string("../gradings/") + file}};
      const Analysis analysis = analysis_of("0", changes);
      ASSERT_EQ(analysis.grains.gravel.size(), std::stoul(count));
      double all = 0.0, heaviest = 0.0;
      for (const MeasuredGrain& grain : analysis.grains.gravel) {
        all += grain.volume;
        heaviest = std::max(heaviest, grain.volume);
      }
      // A curve of whole grains misses a smooth one by half the share of a grain where it steps.
      EXPECT_LT(analysis.table.gravel.largest_difference(), 0.5 * heaviest / all + 0.002) << file << ", " << count;
    }
  }
}

}  // namespace
}  // namespace dem
