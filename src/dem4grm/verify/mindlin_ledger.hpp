// SPDX-License-Identifier: BSD-3-Clause
// The energy that the shear springs gain or lose while the normal force changes their stiffness.
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "dem4grm/engine/simulation.hpp"

namespace dem::verify {

/// A shear spring keeps its force F (N) when its stiffness goes from k_old to k (N/m); by unloading rule 1 the force
/// falls with the stiffness. Its energy changes by F^2/2 (1/k - 1/k_old), or with the smaller force, without work. To
/// be asked after each step.
class MindlinLedger {
 public:
  /// J, since the start.
  [[nodiscard]] double gained() const { return gained_; }

  void add_step(const Simulation& s) {
    Springs now;
    const ContactTable& t = s.contacts;
    for (std::size_t row = 0; row < t.n_rows(); ++row) {
      const bool at_wall = row >= t.n_pair_rows();
      if (!at_wall && row >= t.n_pairs()) continue;
      const Vec3 f = t.force(row);
      const double overlap = dot(f, f) > 0.0 ? t.state[row].overlap : 0.0;
      add(s, now, at_wall ? t.wall_pairs[row - t.n_pair_rows()] : t.pairs[row], at_wall,
          stiffness_of(t.hertz[row] * t.shear_ratio[row], overlap), t.shear(row));
    }
    add_second_neighbours(s, now);
    springs_ = std::move(now);
  }

 private:
  struct Spring {
    double stiffness = 0.0, shear2 = 0.0;  // N/m; N2
  };
  using Springs = std::unordered_map<std::uint64_t, Spring>;

  static double stiffness_of(double coefficient, double overlap) {
    return overlap > 0.0 ? 1.5 * coefficient * std::sqrt(overlap) : 0.0;
  }

  void add(const Simulation& s, Springs& now, PairKey pair, bool at_wall, double stiffness, const Vec3& shear) {
    const std::uint64_t key = pair * 2 + (at_wall ? 1 : 0);
    const auto found = springs_.find(key);
    if (found != springs_.end()) {
      const Spring& old = found->second;
      const double quotient = stiffness / old.stiffness;
      const double kept = s.scene.contact.hz_mode == 1 && quotient < 1.0 ? quotient * quotient : 1.0;
      gained_ += 0.5 * old.shear2 * ((stiffness > 0.0 ? kept / stiffness : 0.0) - 1.0 / old.stiffness);
    }
    if (stiffness > 0.0) now[key] = {stiffness, dot(shear, shear)};
  }

  /// The forces of a step belong to the positions before it, so the overlaps wait here for a step.
  void add_second_neighbours(const Simulation& s, Springs& now) {
    const std::size_t n = static_cast<std::size_t>(s.balls.n_grains) * k_grain_second_neighbours;
    overlaps_.resize(n);
    constexpr std::size_t w = k_lanes;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t grain = k / k_grain_second_neighbours, q = k % k_grain_second_neighbours;
      const auto g = static_cast<int>(grain);
      const SlotPair slots = k_second_neighbours_of_grain[q];
      const double* h = s.grain_history.second_neighbour_shear.data() +
                        ((grain / w) * k_grain_second_neighbours + q) * 3 * w + grain % w;
      add(s, now, pair_key(g * k_grain_balls + slots.i, g * k_grain_balls + slots.j), false,
          stiffness_of(s.rubber().second_neighbour.hertz * s.rubber().second_neighbour.shear_ratio, overlaps_[k]),
          {h[0], h[w], h[2 * w]});
      overlaps_[k] = 2.0 * s.scene.rubber_ball_radius - norm(s.balls.position(BallStore::rubber_index(g, slots.j)) -
                                                             s.balls.position(BallStore::rubber_index(g, slots.i)));
    }
  }

  Springs springs_;
  std::vector<double> overlaps_;  // m, of the second neighbours inside the grains
  double gained_ = 0.0;
};

}  // namespace dem::verify
