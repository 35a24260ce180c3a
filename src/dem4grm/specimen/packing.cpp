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

std::vector<Vec3> contact_normals(const Simulation& s) {
  std::vector<Vec3> normals;
  const ContactTable& t = s.contacts;
  for (std::size_t row = 0; row < t.n_pairs(); ++row) {
    const Vec3 force = t.force(row);
    if (force.x == 0.0 && force.y == 0.0 && force.z == 0.0) continue;
    const Vec3 between = s.balls.position(s.balls.index_of_id(second_of(t.pairs[row]))) -
                         s.balls.position(s.balls.index_of_id(first_of(t.pairs[row])));
    normals.push_back(between * (1.0 / norm(between)));
  }
  return normals;
}

}  // namespace dem
