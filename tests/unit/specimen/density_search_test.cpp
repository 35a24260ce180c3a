// SPDX-License-Identifier: BSD-3-Clause
// The search for a preparation friction, against curves of void ratio over friction that are known. Not tested here:
// that real specimens have such curves (tests/lab/density_test.cpp).
#include "dem4grm/specimen/density_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"

namespace dem {
namespace {

using Curve = std::function<double(double friction)>;

/// The branches of a whole search on a curve.
std::vector<Branch> search(const Curve& void_ratio, const DensityTarget& target) {
  std::vector<Branch> done;
  while (const std::optional<double> next = next_friction(done, target)) {
    done.push_back({*next, 27e3, void_ratio(*next), 100});
  }
  return done;
}

double reached(const std::vector<Branch>& done) {
  return relative_density(done[0].void_ratio, done[1].void_ratio, done.back().void_ratio);
}

TEST(RelativeDensity, FollowsTheDefinitionOfTheLaboratory) {
  // Laboratory indices of gravel (e_min 0.545, e_max 0.725): 0.635 is half-way, 0.63 is (0.725 - 0.63) / 0.18.
  EXPECT_NEAR(relative_density(0.545, 0.725, 0.635), 0.5, 1e-12);
  EXPECT_NEAR(relative_density(0.545, 0.725, 0.63), 0.5277777777777778, 1e-12);
  EXPECT_EQ(relative_density(0.5, 0.8, 0.5), 1.0);
  EXPECT_EQ(relative_density(0.5, 0.8, 0.8), 0.0);
}

TEST(DensitySearch, AsksForBothEndsFirst) {
  const DensityTarget target{0.5, 0.02, 0.05, 1.5};
  std::vector<Branch> done;
  EXPECT_EQ(next_friction(done, target), 0.05);
  done.push_back({0.05, 1e3, 0.5, 1});
  EXPECT_EQ(next_friction(done, target), 1.5);
}

TEST(DensitySearch, FindsSmoothCurvesInFewTrials) {
  // Rounded from measured specimens: rubber climbs slowly, gravel has done most of its way at 0.1; and two extreme ones.
  const std::vector<Curve> curves{
      [](double mu) { return 0.62 + 0.30 * mu / (mu + 0.15) * 1.075; },
      [](double mu) { return 0.49 + 0.125 * mu / (mu + 0.045); },
      [](double mu) { return 0.50 + 0.10 * std::tanh(20.0 * mu); },
      [](double mu) { return 0.50 + 0.10 * mu / 2.0; },
  };
  for (std::size_t k = 0; k < curves.size(); ++k) {
    for (const double wanted : {0.2, 0.5, 0.8}) {
      const DensityTarget target{wanted, 0.02, 0.0, 2.0};
      const std::vector<Branch> done = search(curves[k], target);
      EXPECT_NEAR(reached(done), wanted, 0.02) << "curve " << k;
      EXPECT_LE(done.size(), k < 2 ? 5U : 6U) << "curve " << k << ", D_r " << wanted;
    }
  }
}

TEST(DensitySearch, BeginsNearHalfWayForAllMaterials) {
  // e_min, e_max and the friction that gave 50 %, full size (docs/results/calibration-void-ratio.md): gravel at 30 and
  // 100 kPa, rubber at 30, 60 and 100 kPa.
  const std::vector<std::array<double, 3>> specimens{{0.434, 0.615, 0.0753},
                                                     {0.415, 0.602, 0.0807},
                                                     {0.591, 0.899, 0.1099},
                                                     {0.502, 0.836, 0.1470},
                                                     {0.429, 0.772, 0.1736}};
  for (const auto& [e_min, e_max, friction] : specimens) {
    const std::vector<Branch> ends{{0.0, 27e3, e_min, 100}, {2.0, 27e3, e_max, 100}};
    const double first = next_friction(ends, {0.5, 0.02, 0.0, 2.0}).value();
    EXPECT_GT(first, friction / 1.4);
    EXPECT_LT(first, friction * 1.4);
  }
}

TEST(DensitySearch, OneTrialShowsHowTheCurveBends) {
  // On a curve e = e_min + (e_max - e_min) c m / (m + bend) the second trial hits, wherever the first one lies.
  for (const double bend : {0.02, 0.05, 0.2, 1.0}) {
    const Curve curve = [&](double mu) { return 0.5 + 0.2 * mu / (mu + bend) * (2.0 + bend) / 2.0; };
    EXPECT_LE(search(curve, {0.5, 0.02, 0.0, 2.0}).size(), 4U) << bend;
    EXPECT_LE(search(curve, {0.3, 0.02, 0.0, 2.0}).size(), 4U) << bend;
  }
  // With a smallest friction above zero, and far from 2.
  const Curve curve = [](double mu) { return 0.5 + 0.2 * (mu - 0.1) / (mu - 0.1 + 0.05); };
  EXPECT_LE(search(curve, {0.5, 0.02, 0.1, 0.8}).size(), 4U);
}

TEST(DensitySearch, EndsInSpiteOfScatterAndNeverRepeatsATrial) {
  // Scatter (standard deviation) of 0.02 of the relative density, as measured with 560 clumps.
  std::vector<std::size_t> trials;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomSequence random(seed, RandomStream::test, 0);
    const Curve curve = [&](double mu) {
      const bool is_end = mu == 0.0 || mu == 2.0;
      return 0.49 + 0.125 * mu / (mu + 0.045) + (is_end ? 0.0 : 0.125 * 0.02 * std::sqrt(3.0) * random.uniform(-1, 1));
    };
    const std::vector<Branch> done = search(curve, {0.5, 0.02, 0.0, 2.0});
    EXPECT_NEAR(reached(done), 0.5, 0.02);
    std::set<double> frictions;
    for (const Branch& b : done) frictions.insert(b.friction);
    EXPECT_EQ(frictions.size(), done.size());
    trials.push_back(done.size() - 2);
  }
  // Once near the target, a trial hits it with the probability of |scatter| < 0.02 of a uniform one of +-0.035: 0.58.
  // After one trial to get there, 95 % of the searches need at most log(0.05) / log(0.42) = 3.5 more.
  std::sort(trials.begin(), trials.end());
  EXPECT_LE(trials[trials.size() / 2], 2U);
  EXPECT_LE(trials[trials.size() * 95 / 100], 5U);
}

TEST(DensitySearch, TrialsAreRoundNumbers) {
  for (const Branch& b : search([](double mu) { return 0.5 + mu / (mu + 0.2); }, {0.37, 0.01, 0.0, 2.0})) {
    EXPECT_NEAR(b.friction * 1e4, std::round(b.friction * 1e4), 1e-9);
  }
}

TEST(DensitySearch, SaysWhyThereIsNone) {
  try {
    search([](double mu) { return mu < 1.0 ? 0.6 : 0.5; }, {0.5, 0.02, 0.0, 2.0});
    FAIL();
  } catch (const PhysicsError& e) {
    EXPECT_NE(std::string(e.what()).find("friction does not make the specimen looser"), std::string::npos) << e.what();
  }
  // A range without room: the only trial misses, and no other is made of the same friction.
  try {
    search([](double mu) { return mu < 0.001 ? 0.5 : 0.6; }, {0.5, 0.02, 0.0, 0.0005});
    FAIL();
  } catch (const PhysicsError& e) {
    EXPECT_LE(std::count(e.what(), e.what() + std::string(e.what()).size(), '\n'), 4) << e.what();
  }
  // A step: no specimen is near the target.
  try {
    search([](double mu) { return mu < 0.1 ? 0.5 : 0.6; }, {0.5, 0.02, 0.0, 2.0});
    FAIL();
  } catch (const PhysicsError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("relative density of 0.5 within 0.02"), std::string::npos) << text;
    EXPECT_NE(text.find("friction 2.0000: void ratio 0.6000, relative density 0.000"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace dem
