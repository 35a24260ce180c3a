// SPDX-License-Identifier: BSD-3-Clause
// The grains of a state as plain geometry, from a live simulation or from a file: what a laboratory could measure.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/grains/clump_template.hpp"

namespace dem {

/// Balls in the order of their ids: 35 for each rubber grain, then the pebbles of the clumps. Bodies count rubber grains
/// first, then clumps; balls of one body stand together.
struct Packing {
  std::vector<Vec3> position;  ///< [n_balls] m
  std::vector<double> radius;  ///< [n_balls] m
  std::vector<int> body;       ///< [n_balls]
  int n_rubber_grains = 0;

  [[nodiscard]] int n_rubber_balls() const { return n_rubber_grains * k_grain_balls; }
};

/// Throws nothing; reads only.
Packing packing_of(const Simulation& s);

/// The clumps one after the other: calls use(pebbles) with the pebbles [n_pebbles of the clump, m].
template <class Use>
void for_each_clump(const Packing& packing, const Use& use) {
  std::vector<Pebble> pebbles;
  const std::size_t n = packing.position.size();
  for (auto k = static_cast<std::size_t>(packing.n_rubber_balls()); k < n; ++k) {
    pebbles.push_back({packing.position[k], packing.radius[k]});
    if (k + 1 < n && packing.body[k + 1] == packing.body[k]) continue;
    use(std::span<const Pebble>(pebbles));
    pebbles.clear();
  }
}

}  // namespace dem
