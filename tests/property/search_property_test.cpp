// SPDX-License-Identifier: BSD-3-Clause
// Properties of the candidate search and of the contact table on drawn data.
#include <gtest/gtest.h>
// rapidcheck's own header needs gtest's first.
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/search/contact_table.hpp"

namespace {

using namespace dem;

std::vector<PairKey> drawn_keys() {
  const auto numbers = *rc::gen::container<std::set<int>>(rc::gen::inRange(0, 400));
  std::vector<PairKey> keys;
  for (const int n : numbers) keys.push_back(pair_key(n / 20, 20 + n % 20));  // sorted, since the set is
  return keys;
}

/// What the table holds of one key.
using Remembered = std::map<PairKey, Vec3>;

void remember(ContactTable& t, Remembered& pairs, Remembered& walls, RandomSequence& random) {
  const auto write = [&](PairKey key, std::size_t row, Remembered& out) {
    const Vec3 v{random.uniform(), random.uniform(), random.uniform()};
    t.state[row].shear = v;
    out[key] = v;
  };
  pairs.clear();
  walls.clear();
  for (std::size_t c = 0; c < t.n_pairs(); ++c) write(t.pairs[c], c, pairs);
  for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) write(t.wall_pairs[c], t.n_pair_rows() + c, walls);
}

RC_GTEST_PROP(ContactTableProperty, ReplaceCarriesHistoryExactly, ()) {
  RandomSequence random(*rc::gen::arbitrary<std::uint64_t>(), RandomStream::test, 0);
  ContactTable t;
  Remembered pairs, walls;
  for (int round = 0; round < 5; ++round) {
    t.replace(drawn_keys(), drawn_keys());
    const auto check = [&](PairKey key, std::size_t row, const Remembered& before) {
      const auto found = before.find(key);
      const Vec3 expected = found == before.end() ? Vec3{} : found->second;
      RC_ASSERT(norm(t.shear(row) - expected) == 0.0);
    };
    for (std::size_t c = 0; c < t.n_pairs(); ++c) check(t.pairs[c], c, pairs);
    for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) check(t.wall_pairs[c], t.n_pair_rows() + c, walls);
    remember(t, pairs, walls, random);
  }
}

RC_GTEST_PROP(ContactTableProperty, ReferencesHoldEveryRowTwiceAndWallsOnce, ()) {
  ContactTable t;
  t.replace(drawn_keys(), drawn_keys());
  const int owners = *rc::gen::inRange(1, 8);
  std::vector<int> owner(40), place(40);
  for (int b = 0; b < 40; ++b) {
    owner[static_cast<std::size_t>(b)] = b % owners;
    place[static_cast<std::size_t>(b)] = b;
  }
  ContactReferences r;
  r.build(t, owner, place, owners);
  RC_ASSERT(r.row.size() == 2 * t.n_pairs() + t.wall_pairs.size());
  std::multiset<std::pair<int, int>> listed;  // (row, ball with side)
  for (int o = 0; o < owners; ++o) {
    for (int k = r.start[static_cast<std::size_t>(o)]; k < r.start[static_cast<std::size_t>(o) + 1]; ++k) {
      const int p = r.place[static_cast<std::size_t>(k)];
      RC_ASSERT(owner[static_cast<std::size_t>(p & ~ContactReferences::k_second)] == o);
      if (k > r.start[static_cast<std::size_t>(o)]) {
        RC_ASSERT(r.row[static_cast<std::size_t>(k)] >= r.row[static_cast<std::size_t>(k) - 1]);
      }
      listed.insert({r.row[static_cast<std::size_t>(k)], p});
    }
  }
  for (std::size_t c = 0; c < t.n_pairs(); ++c) {
    RC_ASSERT(listed.count({static_cast<int>(c), first_of(t.pairs[c])}) == 1U);
    RC_ASSERT(listed.count({static_cast<int>(c), second_of(t.pairs[c]) | ContactReferences::k_second}) == 1U);
  }
  for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) {
    RC_ASSERT(listed.count({static_cast<int>(t.n_pair_rows() + c), first_of(t.wall_pairs[c])}) == 1U);
  }
}

/// Up to 250 balls of several bodies, at random in a cube.
struct DrawnBalls {
  std::vector<double> x, y, z, radius;
  std::vector<int> body;
};

DrawnBalls drawn_balls(RandomSequence& random) {
  const int n = *rc::gen::inRange(0, 250);
  const double side = *rc::gen::element(0.0, 1e-3, 0.01, 1.0), ratio = *rc::gen::element(1.0, 3.0, 10.0, 60.0);
  DrawnBalls b;
  for (int i = 0; i < n; ++i) {
    b.x.push_back(random.uniform(-side, side));
    b.y.push_back(random.uniform(-side, side));
    b.z.push_back(random.uniform(-side, side));
    b.radius.push_back(1e-3 / random.uniform(1.0, ratio));
    b.body.push_back(static_cast<int>(random.uniform(0, n)));
  }
  return b;
}

RC_GTEST_PROP(FindPairsProperty, PickingFromWideMarginsAfterMotionIsASearch, ()) {
  RandomSequence random(*rc::gen::arbitrary<std::uint64_t>(), RandomStream::test, 0);
  DrawnBalls b = drawn_balls(random);
  const double wide = *rc::gen::element(1e-5, 3e-4, 2e-3), narrow = wide * random.uniform(0.0, 1.0);
  const std::vector<Wall> walls{make_wall("floor", {-1e-3, -1e-3, 0}, {2e-3, 0, 0}, {0, 2e-3, 0})};
  const auto widened = [&](double margin) {
    std::vector<double> reach = b.radius;
    for (double& r : reach) r += margin;
    return reach;
  };
  std::vector<double> reach = widened(wide);
  const std::vector<PairKey> near = find_pairs({b.x, b.y, b.z, reach, b.body}, 0.0);
  const std::vector<PairKey> near_walls = find_wall_pairs({b.x, b.y, b.z, reach, b.body}, walls, 0.0);
  const double step = 0.999 * (wide - narrow) / std::sqrt(3.0);  // a ball may move by wide - narrow
  for (auto* axis : {&b.x, &b.y, &b.z}) {
    for (double& value : *axis) value += random.uniform(-step, step);
  }
  reach = widened(narrow);
  const SearchBalls now{b.x, b.y, b.z, reach, b.body};
  RC_ASSERT(pick_pairs(now, near) == find_pairs(now, 0.0));
  RC_ASSERT(pick_wall_pairs(now, walls, 0.0, near_walls) == find_wall_pairs(now, walls, 0.0));
}

RC_GTEST_PROP(FindPairsProperty, AgreesWithBruteForce, ()) {
  RandomSequence random(*rc::gen::arbitrary<std::uint64_t>(), RandomStream::test, 0);
  const double skin = *rc::gen::element(0.0, 1e-5, 1e-3);
  const auto [x, y, z, radius, body] = drawn_balls(random);
  std::vector<PairKey> expected;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = i + 1; j < x.size(); ++j) {
      const Vec3 d{x[j] - x[i], y[j] - y[i], z[j] - z[i]};
      const double reach = radius[i] + skin + radius[j], other = radius[j] + skin + radius[i];
      RC_PRE((dot(d, d) < reach * reach) == (dot(d, d) < other * other));  // not a matter of the last bit
      if (body[i] != body[j] && dot(d, d) < reach * reach) {
        expected.push_back(pair_key(static_cast<int>(i), static_cast<int>(j)));
      }
    }
  }
  RC_ASSERT(find_pairs({x, y, z, radius, body}, skin) == expected);
}

}  // namespace
