// SPDX-License-Identifier: BSD-3-Clause
// The candidate search against brute force over all pairs: sizes over 10:1 and more, strays, equal positions, any
// number of threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/search/candidates.hpp"

namespace {

using namespace dem;

struct Cloud {
  std::vector<double> x, y, z, radius;
  std::vector<int> body;
  [[nodiscard]] SearchBalls view() const { return {x, y, z, radius, body}; }
  void add(const Vec3& p, double r, int b) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
    radius.push_back(r);
    body.push_back(b);
  }
  [[nodiscard]] Vec3 at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Random balls in a box of side `side`; three balls of one body follow each other.
Cloud random_cloud(int n, double side, double smallest, double largest, std::uint64_t seed) {
  Cloud c;
  for (int i = 0; i < n; ++i) {
    RandomSequence random(seed, RandomStream::test, static_cast<std::uint64_t>(i));
    // Small ones are many, as in a graded mixture.
    const double t = random.uniform(), r = smallest * largest / (smallest + (largest - smallest) * t * t);
    c.add({random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)}, std::min(r, largest), i / 3);
  }
  return c;
}

std::vector<PairKey> brute_force(const Cloud& c, double skin) {
  std::vector<PairKey> keys;
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    for (std::size_t j = i + 1; j < c.x.size(); ++j) {
      if (c.body[i] == c.body[j]) continue;
      const Vec3 d = c.at(j) - c.at(i);
      const double reach = c.radius[i] + skin + c.radius[j];
      if (dot(d, d) < reach * reach) keys.push_back(pair_key(static_cast<int>(i), static_cast<int>(j)));
    }
  }
  return keys;
}

void expect_same(const Cloud& c, double skin, const std::string& what) {
  const std::vector<PairKey> expected = brute_force(c, skin);
  EXPECT_EQ(find_pairs(c.view(), skin), expected) << what;
}

TEST(FindPairs, MixturesOfManySizes) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const double ratio : {1.0, 2.0, 10.0, 100.0}) {
      const Cloud c = random_cloud(900, 0.02, 1e-3 / ratio, 1e-3, seed);
      ASSERT_GT(brute_force(c, 1e-4).size(), 30U);
      for (const double skin : {0.0, 1e-4}) expect_same(c, skin, "seed " + std::to_string(seed));
    }
  }
}

TEST(FindPairs, DenseCloudOfThousands) {
  const Cloud c = random_cloud(5000, 0.02, 0.2e-3, 2e-3, 4);
  EXPECT_GT(brute_force(c, 5e-5).size(), 20000U);
  expect_same(c, 5e-5, "dense");
}

TEST(FindPairs, StraysFarAway) {
  for (const double far : {0.1, 10.0, 1e4, 1e9, 1e15}) {
    Cloud c = random_cloud(300, 0.01, 1e-4, 1e-3, 9);
    c.add({far, -far, far}, 1e-3, 1000);         // a large one
    c.add({-far, far, 0.5 * far}, 1e-4, 1001);   // a small one
    c.add({far + 1e-3, -far, far}, 1e-4, 1002);  // close to the first
    expect_same(c, 1e-4, "stray at " + std::to_string(far));
  }
}

TEST(FindPairs, EqualPositionsAndPlanes) {
  Cloud c;
  for (int i = 0; i < 40; ++i) c.add({0.01, 0.01, 0.01}, i % 2 == 0 ? 1e-3 : 1e-4, i / 4);
  expect_same(c, 1e-5, "one point");
  Cloud flat;
  for (int i = 0; i < 400; ++i) flat.add({1e-3 * (i % 20), 1e-3 * (i / 20), 0.0}, 0.5e-3, i);
  expect_same(flat, 0.0, "touching exactly: none");
  expect_same(flat, 1e-12, "touching exactly with a hair of skin");
  EXPECT_EQ(find_pairs(flat.view(), 1e-6).size(), 2U * 20U * 19U);
  Cloud none;
  EXPECT_TRUE(find_pairs(none.view(), 1e-3).empty());
  none.add({0, 0, 0}, 1e-3, 0);
  EXPECT_TRUE(find_pairs(none.view(), 1e-3).empty());
}

TEST(FindPairs, SmallestIdsMayBeTheLargestBallsOrTheSmallest) {
  for (const bool descending : {false, true}) {
    Cloud c = random_cloud(1500, 0.02, 1e-4, 1.5e-3, 3), sorted;
    std::vector<std::size_t> order(c.x.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return descending ? c.radius[a] > c.radius[b] : c.radius[a] < c.radius[b];
    });
    for (const std::size_t i : order) sorted.add(c.at(i), c.radius[i], static_cast<int>(i));
    expect_same(sorted, 1e-5, "sorted by size");
  }
}

TEST(FindPairs, DoesNotDependOnTheNumberOfThreads) {
  const Cloud c = random_cloud(9000, 0.03, 2e-4, 1e-3, 5);  // several blocks of the search
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<PairKey> one = find_pairs(c.view(), 1e-5);
  for (const int threads : {2, 3, 8}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(find_pairs(c.view(), 1e-5), one);
  }
  omp_set_num_threads(before);
}

// ---- walls --------------------------------------------------------------------------------------------------------

/// Distance of a point from a rectangle in space: ternary search along each side, which shares nothing with look_at.
double distance_by_search(const Wall& w, const Vec3& p) {
  const auto at = [&](double a, double b) { return norm(p - (w.corner + w.u * a + w.v * b)); };
  const auto least_along_v = [&](double a) {
    double low = 0.0, high = w.length_v;
    for (int k = 0; k < 60; ++k) {
      const double third = (high - low) / 3.0;
      (at(a, low + third) < at(a, high - third) ? high : low) +=
          (at(a, low + third) < at(a, high - third) ? -third : third);
    }
    return at(a, 0.5 * (low + high));
  };
  double low = 0.0, high = w.length_u;
  for (int k = 0; k < 60; ++k) {
    const double third = (high - low) / 3.0;
    const bool left = least_along_v(low + third) < least_along_v(high - third);
    (left ? high : low) += left ? -third : third;
  }
  return least_along_v(0.5 * (low + high));
}

TEST(FindWallPairs, AgreesWithTheDistanceFromEachRectangle) {
  RandomSequence random(8, RandomStream::test, 1);
  std::vector<Wall> walls;
  for (int k = 0; k < 6; ++k) {
    const Frame f = frame_of(random.orientation());
    walls.push_back(make_wall("w", {random.uniform(0, 0.02), random.uniform(0, 0.02), random.uniform(0, 0.02)},
                              f.e1 * random.uniform(2e-3, 0.01), f.e2 * random.uniform(2e-3, 0.01)));
  }
  const Cloud c = random_cloud(800, 0.02, 2e-4, 2e-3, 6);
  const double skin = 1e-4;
  const std::vector<PairKey> keys = find_wall_pairs(c.view(), walls, skin);
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  EXPECT_GT(keys.size(), 50U);
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const double gap = distance_by_search(walls[w], c.at(i)) - c.radius[i] - skin;
      if (std::abs(gap) < 1e-9) continue;
      const bool listed =
          std::binary_search(keys.begin(), keys.end(), pair_key(static_cast<int>(i), static_cast<int>(w)));
      // In front of and behind the wall alike: a ball pressed through by less than its radius must be pushed back.
      EXPECT_EQ(listed, gap < 0.0) << "ball " << i << " wall " << w << " gap " << gap;
    }
  }
}

TEST(FindWallPairs, DoesNotDependOnTheNumberOfThreads) {
  const Cloud c = random_cloud(9000, 0.03, 2e-4, 1e-3, 5);
  const std::vector<Wall> walls{make_wall("floor", {0, 0, 0}, {0.03, 0, 0}, {0, 0.03, 0}),
                                make_wall("side", {0, 0, 0}, {0, 0.03, 0}, {0, 0, 0.03})};
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<PairKey> one = find_wall_pairs(c.view(), walls, 1e-5);
  for (const int threads : {2, 3, 8}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(find_wall_pairs(c.view(), walls, 1e-5), one);
  }
  omp_set_num_threads(before);
}

}  // namespace
