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
  evaluate_early_contacts(*this);
  evaluate_wall_contacts(*this);
  advance_rubber_grains(*this);
  advance_clumps(*this);
  move_walls(*this);
  time += dt;
  last_dt = dt;
  ++steps;
}

namespace {

/// Sets the velocity of the servo plate along its normal; other components stay as prescribed.
void steer_plate(Simulation& s, const PlateServo& servo) {
  if (servo.wall < 0) return;
  const auto w = static_cast<std::size_t>(servo.wall);
  Wall& plate = s.walls[w];
  const double force = -dot(s.reactions[w].force, plate.normal);
  const double inward =
      servo_velocity(servo.target_force - force, s.reactions[w].stiffness, s.dt, servo.gain, servo.speed_cap);
  plate.velocity = perpendicular(plate.velocity, plate.normal) + plate.normal * inward;
}

}  // namespace

void move_walls(Simulation& s) {
  steer_plate(s, s.servo);
  for (const PlateServo& servo : s.more_servos) steer_plate(s, servo);
  double fastest_wall2 = 0.0;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    Wall& wall = s.walls[w];
    if (wall.carrier >= 0) {  // behind its carrier in the list, whose work holds that of its forces
      wall.velocity = s.walls[static_cast<std::size_t>(wall.carrier)].velocity;
      wall.corner += wall.velocity * s.dt;
      s.last_wall_velocity[w] = wall.velocity;
      continue;
    }
    // Work of the force of this instant over half the step before and half the step after it.
    const Vec3 both_halves = wall.velocity + s.last_wall_velocity[w] * (s.last_dt / s.dt);
    s.ledger.boundary -= dot(s.reactions[w].force, both_halves) * (0.5 * s.dt);
    wall.corner += wall.velocity * s.dt;
    s.last_wall_velocity[w] = wall.velocity;
    fastest_wall2 = std::max(fastest_wall2, dot(wall.velocity, wall.velocity));
  }
  CandidateMargins& m = s.margins;
  m.wall_travel += std::sqrt(fastest_wall2) * s.dt;
  bool is_used_up = m.wall_travel > m.wall_margin;
  for (std::size_t b = 0; b < m.travel.size(); ++b) {
    m.travel[b] += std::sqrt(s.block_top_speed2[b]) * s.dt;
    is_used_up |= m.travel[b] > m.margin[b];
  }
  m.is_used_up = is_used_up;
}

}  // namespace dem
