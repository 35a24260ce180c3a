// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/search/contact_table.hpp"

#include <algorithm>

#include "dem4grm/core/blocks.hpp"

namespace dem {

namespace {

constexpr std::size_t k_block = 4096;  // rows

/// For every new key the position of the same key in the old list: in every block one pass over two sorted lists.
void match(std::span<const PairKey> old_keys, std::span<const PairKey> new_keys, std::size_t old_base,
           std::span<std::ptrdiff_t> source) {
  for_each_block(new_keys.size(), k_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    auto old = std::lower_bound(old_keys.begin(), old_keys.end(), new_keys[begin]);
    for (std::size_t n = begin; n < end; ++n) {
      while (old != old_keys.end() && *old < new_keys[n]) ++old;
      if (old == old_keys.end()) return;
      if (*old == new_keys[n]) source[n] = old - old_keys.begin() + static_cast<std::ptrdiff_t>(old_base);
    }
  });
}

/// Brings the values of rows that stay to their new rows; the others become zero.
template <class Value>
void carry_over(const std::vector<std::ptrdiff_t>& source, AlignedArray<Value>& values, AlignedArray<Value>& spare) {
  spare.resize(source.size());
  for_each_block(source.size(), k_block, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      spare[r] = source[r] >= 0 ? values[static_cast<std::size_t>(source[r])] : Value{};
    }
  });
  values.swap(spare);
}

}  // namespace

void ContactTable::replace(std::vector<PairKey> new_pairs, std::vector<PairKey> new_wall_pairs, int n_rubber_balls) {
  const auto others = std::stable_partition(new_pairs.begin(), new_pairs.end(),
                                            [&](PairKey key) { return second_of(key) < n_rubber_balls; });
  const auto new_rubber_pairs = static_cast<std::size_t>(others - new_pairs.begin());
  const std::size_t old_pair_rows = n_pair_rows();
  const std::size_t new_pair_rows = (new_pairs.size() + k_contact_batch - 1) / k_contact_batch * k_contact_batch;
  const std::size_t rows = new_pair_rows + new_wall_pairs.size();
  std::vector<std::ptrdiff_t> source(rows, -1);
  const std::span old_keys(pairs), new_keys(new_pairs);
  const std::span into(source);
  match(old_keys.first(n_rubber_pairs), new_keys.first(new_rubber_pairs), 0, into);
  match(old_keys.subspan(n_rubber_pairs), new_keys.subspan(new_rubber_pairs), n_rubber_pairs,
        into.subspan(new_rubber_pairs));
  match(wall_pairs, new_wall_pairs, old_pair_rows, into.subspan(new_pair_rows));

  // Forces are carried too, so that a reader of the table between two steps sees the last evaluation.
  carry_over(source, state, spare_state);
  if (!damping_x.empty()) {
    for (auto* a : {&damping_x, &damping_y, &damping_z}) carry_over(source, *a, spare_damping);
  }
  pairs = std::move(new_pairs);
  n_rubber_pairs = new_rubber_pairs;
  wall_pairs = std::move(new_wall_pairs);
  clear_constants();
}

void ContactTable::clear_constants() {
  const auto clear = [rows = n_rows()](auto& column) {
    column.resize(0);
    column.resize(rows);
  };
  for (auto* column : {&radius_i, &radius_j, &hertz, &shear_ratio, &friction}) clear(*column);
  for (auto* column : {&index_i, &index_j}) clear(*column);
}

void ContactReferences::build(const ContactTable& table, std::span<const int> owner_of, std::span<const int> place_of,
                              int n_owners) {
  start.assign(static_cast<std::size_t>(n_owners) + 1, 0);
  const auto owner = [&](int ball) { return static_cast<std::size_t>(owner_of[static_cast<std::size_t>(ball)]); };
  for (const PairKey key : table.pairs) {
    ++start[owner(first_of(key)) + 1];
    ++start[owner(second_of(key)) + 1];
  }
  for (const PairKey key : table.wall_pairs) ++start[owner(first_of(key)) + 1];
  for (std::size_t o = 0; o < static_cast<std::size_t>(n_owners); ++o) start[o + 1] += start[o];

  row.resize(static_cast<std::size_t>(start.back()));
  place.resize(row.size());
  std::vector<int> next(start.begin(), start.end() - 1);
  const auto add = [&](int ball, std::size_t r, int side) {
    const auto k = static_cast<std::size_t>(next[owner(ball)]++);
    row[k] = static_cast<int>(r);
    place[k] = place_of[static_cast<std::size_t>(ball)] | side;
  };
  for (std::size_t p = 0; p < table.pairs.size(); ++p) {
    add(first_of(table.pairs[p]), p, 0);
    add(second_of(table.pairs[p]), p, k_second);
  }
  const std::size_t base = table.n_pair_rows();
  for (std::size_t p = 0; p < table.wall_pairs.size(); ++p) add(first_of(table.wall_pairs[p]), base + p, 0);
}

}  // namespace dem
