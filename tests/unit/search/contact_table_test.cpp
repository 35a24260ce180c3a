// SPDX-License-Identifier: BSD-3-Clause
// The contact table: what survives when the candidate list is replaced, and which rows act on which body.
#include <gtest/gtest.h>

#include <vector>

#include "dem4grm/search/contact_table.hpp"

namespace {

using namespace dem;

TEST(PairKeys, SortByFirstThenSecond) {
  EXPECT_LT(pair_key(1, 900000), pair_key(2, 3));
  EXPECT_LT(pair_key(2, 3), pair_key(2, 4));
  EXPECT_EQ(first_of(pair_key(123456, 654321)), 123456);
  EXPECT_EQ(second_of(pair_key(123456, 654321)), 654321);
}

TEST(ContactTable, KeepsHistoryOfPairsAndWallsApart) {
  ContactTable t;
  t.replace({pair_key(0, 3), pair_key(1, 2)}, {pair_key(0, 0), pair_key(3, 1)});
  ASSERT_EQ(t.n_pair_rows(), k_contact_batch);
  ASSERT_EQ(t.n_rows(), k_contact_batch + 2);
  t.state[0].shear.x = 1;
  t.state[1].shear.y = 2;
  t.state[k_contact_batch].shear.z = 3;
  t.state[k_contact_batch + 1].normal_force = 4;
  t.state[1].overlap = 5;
  // (0,3) goes, (1,2) stays, (0,1) comes; the wall pair (0,0) must not be taken for a ball pair.
  t.replace({pair_key(0, 1), pair_key(1, 2)}, {pair_key(0, 0), pair_key(1, 2), pair_key(3, 1)});
  EXPECT_EQ(t.state[0].shear.x, 0.0);
  EXPECT_EQ(t.state[1].shear.y, 2.0);
  EXPECT_EQ(t.state[1].overlap, 5.0);
  EXPECT_EQ(t.state[k_contact_batch].shear.z, 3.0);
  EXPECT_EQ(t.state[k_contact_batch + 1].shear.y, 0.0);  // wall pair (1,2) is new although the ball pair (1,2) is old
  EXPECT_EQ(t.state[k_contact_batch + 2].normal_force, 4.0);
}

TEST(ContactTable, PaddingRowsNeverTouch) {
  ContactTable t;
  std::vector<PairKey> keys;
  for (int i = 0; i < 11; ++i) keys.push_back(pair_key(i, i + 1));
  t.replace(keys, {});
  t.radius_i.fill(1.0);
  for (ContactState& s : t.state) s.shear.x = 7.0;
  keys.resize(3);
  t.replace(keys, {pair_key(5, 0)});
  ASSERT_EQ(t.n_pair_rows(), 8U);
  for (std::size_t row = 3; row < 8; ++row) {
    EXPECT_EQ(t.radius_i[row], 0.0);
    EXPECT_EQ(t.radius_j[row], 0.0);
    EXPECT_EQ(t.hertz[row], 0.0);
    EXPECT_EQ(t.state[row].shear.x, 0.0);
  }
}

TEST(ContactReferences, ListEveryRowOnBothBodiesInOrder) {
  // Balls 0, 1 belong to owner 0 (places 10, 11), ball 2 to owner 1 (place 12).
  ContactTable t;
  t.replace({pair_key(0, 2), pair_key(1, 2)}, {pair_key(1, 0), pair_key(2, 4)});
  ContactReferences r;
  const std::vector<int> owner{0, 0, 1}, place{10, 11, 12};
  r.build(t, owner, place, 2);
  const int wall = static_cast<int>(t.n_pair_rows());
  EXPECT_EQ(r.start, (std::vector<int>{0, 3, 6}));
  EXPECT_EQ(r.row, (std::vector<int>{0, 1, wall, 0, 1, wall + 1}));
  const int second = ContactReferences::k_second;
  EXPECT_EQ(r.place, (std::vector<int>{10, 11, 11, 12 | second, 12 | second, 12}));
}

}  // namespace
