// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/packing_measures.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem4grm/verify/scenes.hpp"

namespace dem::verify {

namespace {

bool holds(const Bounds& b, const Vec3& p, double margin) {
  return p.x - margin >= b.low.x && p.x + margin <= b.high.x && p.y - margin >= b.low.y && p.y + margin <= b.high.y &&
         p.z - margin >= b.low.z && p.z + margin <= b.high.z;
}

/// Contacts that carry force: spheres i < j, or a wall when j < 0.
struct Touch {
  int i = 0, j = -1;
  double overlap = 0.0;  ///< m
};

std::vector<Touch> touches_of(const Simulation& s) {
  std::vector<Touch> touches;
  const ContactTable& t = s.contacts;
  for (std::size_t row = 0; row < t.n_rows(); ++row) {
    const Vec3 f = t.force(row);
    const bool at_wall = row >= t.n_pair_rows();
    if ((!at_wall && row >= t.n_pairs()) || dot(f, f) == 0.0) continue;
    const PairKey key = at_wall ? t.wall_pairs[row - t.n_pair_rows()] : t.pairs[row];
    touches.push_back({first_of(key), at_wall ? -1 : second_of(key), t.state[row].overlap});
  }
  return touches;
}

/// Contacts of each sphere after the rattlers are gone; 0 for a rattler.
std::vector<int> load_bearing_contacts(const std::vector<Touch>& touches, std::size_t n, int least) {
  std::vector<char> bears(n, 1);
  std::vector<int> count(n);
  for (bool changed = true; changed;) {
    changed = false;
    std::fill(count.begin(), count.end(), 0);
    for (const Touch& t : touches) {
      const auto i = static_cast<std::size_t>(t.i), j = static_cast<std::size_t>(std::max(t.j, 0));
      if (bears[i] == 0 || (t.j >= 0 && bears[j] == 0)) continue;
      ++count[i];
      if (t.j >= 0) ++count[j];
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (bears[k] == 0 || count[k] >= least) continue;
      bears[k] = 0;
      changed = true;
    }
  }
  return count;
}

}  // namespace

double volume_inside(const Vec3& centre, double radius, const Bounds& box) {
  if (holds(box, centre, radius)) return 4.0 / 3.0 * k_pi * radius * radius * radius;
  constexpr int n = 40;
  const double cell = 2.0 * radius / n;
  double volume = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double dx = (i + 0.5) * cell - radius, dy = (j + 0.5) * cell - radius;
      const double left = radius * radius - dx * dx - dy * dy;
      const double x = centre.x + dx, y = centre.y + dy;
      if (left <= 0.0 || x < box.low.x || x > box.high.x || y < box.low.y || y > box.high.y) continue;
      const double half = std::sqrt(left);
      const double low = std::max(centre.z - half, box.low.z), high = std::min(centre.z + half, box.high.z);
      if (high > low) volume += (high - low) * cell * cell;
    }
  }
  return volume;
}

PackingState packing_state(const Simulation& s, const Bounds& core, int least_contacts) {
  const std::vector<Touch> touches = touches_of(s);
  const auto n = static_cast<std::size_t>(s.balls.n_balls());
  const std::vector<int> count = load_bearing_contacts(touches, n, least_contacts);
  PackingState state;
  double solid = 0.0, contacts = 0.0, diameter = 0.0;
  int bearing = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto ball = static_cast<int>(k);
    const Vec3 p = s.balls.position(s.balls.index_of_id(ball));
    const double r = s.balls.radius_of_id(ball);
    diameter += 2.0 * r / static_cast<double>(n);
    if (holds(core, p, -r)) solid += volume_inside(p, r, core);
    if (!holds(core, p, 0.0)) continue;
    ++state.core_spheres;
    if (count[k] == 0) continue;
    ++bearing;
    contacts += count[k];
  }
  const Vec3 size = core.high - core.low;
  state.solid_fraction = solid / (size.x * size.y * size.z);
  state.coordination = bearing > 0 ? contacts / bearing : 0.0;
  state.rattlers = 1.0 - static_cast<double>(bearing) / std::max(state.core_spheres, 1);
  double overlap = 0.0;
  int pairs = 0;
  for (const Touch& t : touches) {
    if (t.j < 0) continue;
    overlap += t.overlap;
    ++pairs;
  }
  state.mean_overlap = pairs > 0 ? overlap / pairs / diameter : 0.0;
  return state;
}

}  // namespace dem::verify
