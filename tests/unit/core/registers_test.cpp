// SPDX-License-Identifier: BSD-3-Clause
// Moves of data in registers.
#include <gtest/gtest.h>

#include "dem4grm/core/registers.hpp"
#include "dem4grm/core/vec3.hpp"

namespace {

using namespace dem;

TEST(Registers, TransposeSwapsRowsAndColumns) {
  double from[8][8], to[8][8];
  Eight r[8];
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) from[row][column] = 10.0 * row + column;
    r[row] = load_eight(from[row]);
  }
  transpose(r);
  for (int row = 0; row < 8; ++row) store_eight(to[row], r[row]);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) EXPECT_EQ(to[row][column], 10.0 * column + row);
  }
}

TEST(Registers, CrossProductIsThatOfVectors) {
  const Vec3 a{1.25, -2.5, 3.125}, b{-0.75, 5.0, 0.3};
  const Vec3 expected = cross(a, b);
  const Four c = cross(Four{a.x, a.y, a.z, 7.0}, Four{b.x, b.y, b.z, 9.0});
  EXPECT_EQ(c[0], expected.x);
  EXPECT_EQ(c[1], expected.y);
  EXPECT_EQ(c[2], expected.z);
  EXPECT_EQ(c[3], 0.0);
}

TEST(Registers, AddsInPlace) {
  double sum[4] = {1, 2, 3, 4};
  add_four(sum, Four{10, 20, 30, 40});
  EXPECT_EQ(sum[0], 11.0);
  EXPECT_EQ(sum[3], 44.0);
}

}  // namespace
