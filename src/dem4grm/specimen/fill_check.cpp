// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/fill_check.hpp"

#include <algorithm>
#include <cmath>

#include "dem4grm/grains/rubber_grain.hpp"

namespace dem {
namespace {

constexpr double k_margin = 0.5;  // of a ball radius

/// Is the point inside the rubber grain that this pebble belongs to?
bool is_inside_grain(const Clump& grain, const Vec3& point) {
  const Vec3 local = to_body(frame_of(grain.orientation), point - grain.position);
  const double reach = (k_grain_lattice + k_margin) * grain.size;
  return std::max({std::abs(local.x), std::abs(local.y), std::abs(local.z)}) < reach;
}

}  // namespace

int interlocked_balls(const Simulation& s, int rubber_shape) {
  const ContactTable& t = s.contacts;
  std::vector<char> is_caught(static_cast<std::size_t>(s.balls.n_balls()), 0);
  const auto look = [&](int grain_ball, int other) {
    const Clump& grain = s.clumps.clumps[static_cast<std::size_t>(s.body_of_ball(grain_ball) - s.balls.n_grains)];
    if (grain.shape != rubber_shape) return;
    if (is_inside_grain(grain, s.balls.position(s.balls.index_of_id(other))))
      is_caught[static_cast<std::size_t>(other)] = 1;
  };
  for (std::size_t c = 0; c < t.n_pairs(); ++c) {
    look(first_of(t.pairs[c]), second_of(t.pairs[c]));
    look(second_of(t.pairs[c]), first_of(t.pairs[c]));
  }
  return static_cast<int>(std::count(is_caught.begin(), is_caught.end(), 1));
}

int first_outside(const Simulation& s, const Vec3& size) {
  for (std::size_t k = 0; k < s.clumps.clumps.size(); ++k) {
    const Vec3& p = s.clumps.clumps[k].position;
    const bool is_in = p.x > 0.0 && p.x < size.x && p.y > 0.0 && p.y < size.y && p.z > 0.0 && p.z < size.z;
    if (!is_in) return static_cast<int>(k);
  }
  return -1;
}

}  // namespace dem
