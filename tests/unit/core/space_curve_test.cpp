// SPDX-License-Identifier: BSD-3-Clause
// The curve through space: a permutation that puts neighbours side by side.
#include <gtest/gtest.h>

#include <algorithm>

#include "dem4grm/core/random.hpp"
#include "dem4grm/core/space_curve.hpp"

namespace {

using namespace dem;

std::vector<Vec3> random_cloud(int n) {
  std::vector<Vec3> points;
  RandomSequence random(5, RandomStream::test, 0);
  for (int k = 0; k < n; ++k) points.push_back({random.uniform(), random.uniform(), random.uniform()});
  return points;
}

TEST(SpaceCurve, VisitsTheCornersOfACubeWithXFastestAndZSlowest) {
  std::vector<Vec3> corners;
  for (const int k : {6, 1, 7, 0, 3, 5, 2, 4}) corners.push_back({k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 - 0.5});
  EXPECT_EQ(order_along_curve(corners), (std::vector<int>{3, 1, 6, 4, 7, 5, 0, 2}));
}

TEST(SpaceCurve, IsAPermutation) {
  std::vector<int> order = order_along_curve(random_cloud(1000));
  std::sort(order.begin(), order.end());
  for (int k = 0; k < 1000; ++k) EXPECT_EQ(order[static_cast<std::size_t>(k)], k);
}

TEST(SpaceCurve, BringsNeighboursTogether) {
  std::vector<Vec3> points = random_cloud(4096);
  const auto mean_hop = [&] {
    double sum = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k) sum += norm(points[k] - points[k - 1]);
    return sum / static_cast<double>(points.size() - 1);
  };
  const double before = mean_hop();
  sort_along_curve(points, [](const Vec3& p) { return p; });
  EXPECT_NEAR(before, 0.66, 0.02);  // mean distance of two random points of a unit cube
  EXPECT_LT(mean_hop(), 0.12);      // spacing 1/16
}

TEST(SpaceCurve, SortsItemsAndSaysWhereTheyWere) {
  std::vector<Vec3> items = random_cloud(50);
  const std::vector<Vec3> old = items;
  const std::vector<int> order = sort_along_curve(items, [](const Vec3& p) { return p; });
  for (std::size_t k = 0; k < items.size(); ++k) EXPECT_EQ(items[k].x, old[static_cast<std::size_t>(order[k])].x);
}

TEST(SpaceCurve, KeepsTheOrderOfPointsInOnePlace) {
  EXPECT_EQ(order_along_curve(std::vector<Vec3>(4, Vec3{1, 2, 3})), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(order_along_curve({}).empty());
}

TEST(SpaceCurve, FlatCloudsAreSortedToo) {
  std::vector<Vec3> line;
  for (const int k : {3, 0, 2, 1}) line.push_back({static_cast<double>(k), 0.0, 0.0});
  EXPECT_EQ(order_along_curve(line), (std::vector<int>{1, 3, 2, 0}));
}

}  // namespace
