// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/search/candidates.hpp"

namespace dem {

namespace {

constexpr std::size_t k_pick_block = 4096;  // pairs

Vec3 centre_of(const SearchBalls& b, int id) {
  const auto k = static_cast<std::size_t>(id);
  return {b.x[k], b.y[k], b.z[k]};
}

/// The keys that pass, in their order.
template <class Test>
std::vector<PairKey> picked(std::span<const PairKey> keys, Test&& passes) {
  std::vector<PairKey> kept(keys.size());
  std::vector<std::size_t> count(block_count(keys.size(), k_pick_block));
  for_each_block(keys.size(), k_pick_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    std::size_t to = begin;
    for (std::size_t k = begin; k < end; ++k) {
      kept[to] = keys[k];
      to += passes(keys[k]) ? 1 : 0;
    }
    count[block] = to - begin;
  });
  std::size_t total = 0;
  for (std::size_t block = 0; block < count.size(); ++block) {
    const auto from = kept.begin() + static_cast<std::ptrdiff_t>(block * k_pick_block);
    std::copy_n(from, count[block], kept.begin() + static_cast<std::ptrdiff_t>(total));
    total += count[block];
  }
  kept.resize(total);
  return kept;
}

}  // namespace

std::vector<PairKey> pick_pairs(const SearchBalls& balls, std::span<const PairKey> pairs) {
  return picked(pairs, [&](PairKey key) {
    const int i = first_of(key), j = second_of(key);
    const Vec3 d = centre_of(balls, j) - centre_of(balls, i);
    const double r = balls.radius[static_cast<std::size_t>(i)] + balls.radius[static_cast<std::size_t>(j)];
    return dot(d, d) < r * r;
  });
}

std::vector<PairKey> pick_wall_pairs(const SearchBalls& balls, std::span<const Wall> walls, double skin,
                                     std::span<const PairKey> wall_pairs) {
  return picked(wall_pairs, [&](PairKey key) {
    const double reach = balls.radius[static_cast<std::size_t>(first_of(key))] + skin;
    return comes_within(walls[static_cast<std::size_t>(second_of(key))], centre_of(balls, first_of(key)), reach);
  });
}

}  // namespace dem
