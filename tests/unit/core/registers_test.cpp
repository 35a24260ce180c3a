// SPDX-License-Identifier: BSD-3-Clause
// Moves of data in registers.
#include <gtest/gtest.h>

#include "dem4grm/core/registers.hpp"
#include "dem4grm/core/vec3.hpp"

namespace {

using namespace dem;

TEST(Registers, TransposeSwapsRowsAndColumns) {
  double from[8][8], to[8][8];
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) from[row][column] = 10.0 * row + column;
  }
  transpose_eight(EightRows<const double>(from[0], 8).at, EightRows<double>(to[0], 8).at);
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

template <class Vector>
void expect_transposed_by_squares_of() {
  double from[8][8], to[8][8];
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) from[row][column] = 10.0 * row + column;
  }
  dem::detail::transpose_by_squares<Vector>(EightRows<const double>(from[0], 8).at, EightRows<double>(to[0], 8).at);
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) EXPECT_EQ(to[row][column], 10.0 * column + row);
  }
}

// Whatever this file is compiled for, the ways of all targets are tried.
TEST(Registers, TransposesBySquaresOfEveryWidth) {
  expect_transposed_by_squares_of<Two>();
  expect_transposed_by_squares_of<Four>();
  expect_transposed_by_squares_of<Eight>();
}

TEST(Registers, CollectsFromManyPlaces) {
  double places[8][5], to[k_register];
  const double* from[k_register];
  for (std::size_t k = 0; k < 8; ++k) {
    for (std::size_t n = 0; n < 5; ++n) places[k][n] = static_cast<double>(10 * k + n);
  }
  for (std::size_t k = 0; k < k_register; ++k) from[k] = places[k];
  collect(from, 3, to);
  for (std::size_t k = 0; k < k_register; ++k) EXPECT_EQ(to[k], places[k][3]);
}

}  // namespace
