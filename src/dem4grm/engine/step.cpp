// SPDX-License-Identifier: BSD-3-Clause
// One time step, as a list of stages.
#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/walls/servo.hpp"

namespace dem {

void Simulation::step() {
  require(dt > 0.0, "the time step was never set");
  refresh_candidates(*this);
  evaluate_ball_contacts(*this);
  evaluate_wall_contacts(*this);
  advance_rubber_grains(*this);
  advance_clumps(*this);
  move_walls(*this);
  time += dt;
  ++steps;
}

void refresh_candidates(Simulation& s) {
  if (s.candidates_valid && 2.0 * s.travel < s.skin) return;
  if (s.candidates_valid) {
    // The bound sums the top speeds of all steps; the true displacement since the last build is often smaller.
    double largest2 = 0.0;
    for (std::size_t id = 0; id < s.built_at[0].size(); ++id) {
      const Vec3 d = s.balls.position(s.balls.index_of_id(static_cast<int>(id))) -
                     Vec3{s.built_at[0][id], s.built_at[1][id], s.built_at[2][id]};
      largest2 = std::max(largest2, dot(d, d));
    }
    const double largest = std::sqrt(largest2) + s.wall_travel;
    if (2.0 * largest < 0.7 * s.skin) {
      s.travel = largest;
      return;
    }
  }
  s.rebuild_candidates();
}

namespace {

/// Sets the velocity of the servo plate along its normal; other components stay as prescribed.
void steer_plate(Simulation& s) {
  if (s.servo.wall < 0) return;
  const auto w = static_cast<std::size_t>(s.servo.wall);
  Wall& plate = s.walls[w];
  const double force = -dot(s.reactions[w].force, plate.normal);
  const double inward =
      servo_velocity(s.servo.target_force - force, s.reactions[w].stiffness, s.dt, s.servo.gain, s.servo.speed_cap);
  plate.velocity = perpendicular(plate.velocity, plate.normal) + plate.normal * inward;
}

}  // namespace

void move_walls(Simulation& s) {
  steer_plate(s);
  double fastest2 = 0.0;
  for (const double v2 : s.block_top_speed2) fastest2 = std::max(fastest2, v2);
  double fastest_wall2 = 0.0;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    Wall& wall = s.walls[w];
    // Work of the force of this instant over half the step before and half the step after it.
    s.ledger.boundary -= dot(s.reactions[w].force, wall.velocity + s.last_wall_velocity[w]) * (0.5 * s.dt);
    wall.corner += wall.velocity * s.dt;
    s.last_wall_velocity[w] = wall.velocity;
    fastest_wall2 = std::max(fastest_wall2, dot(wall.velocity, wall.velocity));
  }
  s.wall_travel += std::sqrt(fastest_wall2) * s.dt;
  s.travel += (std::sqrt(fastest2) + std::sqrt(fastest_wall2)) * s.dt;
}

}  // namespace dem
