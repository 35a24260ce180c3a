// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/packing.hpp"

namespace dem {

Packing packing_of(const Simulation& s) {
  Packing packing;
  const auto n = static_cast<std::size_t>(s.balls.n_balls());
  packing.position.reserve(n);
  packing.radius.reserve(n);
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    packing.position.push_back(s.balls.position(s.balls.index_of_id(id)));
    packing.radius.push_back(s.balls.radius_of_id(id));
  }
  packing.body = s.body_of;
  packing.n_rubber_grains = s.balls.n_grains;
  return packing;
}

}  // namespace dem
