// SPDX-License-Identifier: BSD-3-Clause
// The same step as a straightforward programmer would write it: one grain after the other, one contact after the other,
// balls in arrays by number, forces added where they belong. Same laws, same candidates, same walls.
#pragma once

#include <vector>

#include "dem4grm/engine/simulation.hpp"

namespace bench {

/// Rubber grains in the history-free form without contact dashpots; throws InputError for anything else.
class NaiveStep {
 public:
  /// Takes positions, velocities, orientations, history and candidates from s. Wall contacts are evaluated by s itself.
  explicit NaiveStep(const dem::Simulation& s);

  /// Contacts, bonds, damping, integration of one step; the walls' forces are those that s holds.
  void run(const dem::Simulation& s);

  /// Largest distance to the balls of s, m.
  [[nodiscard]] double distance_to(const dem::Simulation& s) const;

 private:
  void add(int ball, const dem::Vec3& force, const dem::Vec3& torque);
  void add_contacts(const dem::Simulation& s);
  void add_walls(const dem::Simulation& s);
  void add_grain(const dem::Simulation& s, int grain);
  void move_ball(const dem::Simulation& s, int ball);

  std::vector<dem::Vec3> position_, velocity_, spin_, force_, torque_;  // [n_balls]
  std::vector<dem::Quaternion> orientation_;                            // [n_balls]
  std::vector<dem::Vec3> contact_shear_;                                // [n_pairs]
  std::vector<dem::Vec3> second_neighbour_shear_;                       // [n_grains * 66]
  double slip_ = 0.0;
};

}  // namespace bench
