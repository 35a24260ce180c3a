// SPDX-License-Identifier: BSD-3-Clause
// Numbers that describe a state: how far from rest, how deep the overlaps, whether anything is lost.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "dem4grm/core/bounds.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Contact force on each body, N: rubber grains first, then clumps. Forces inside a grain cancel.
std::vector<Vec3> net_contact_forces(const Simulation& s);

struct Balance {
  double mean_net_force = 0.0;      ///< N, mean over the bodies that touch something
  double mean_contact_force = 0.0;  ///< N, mean over the active contacts
  int active_contacts = 0;
  /// mean_net_force / mean_contact_force, 0 when nothing touches
  [[nodiscard]] double ratio() const { return mean_contact_force > 0.0 ? mean_net_force / mean_contact_force : 0.0; }
};
Balance balance(const Simulation& s);

/// Mean of nx^4 + ny^4 + nz^4 over the axes of the rubber grains (bonded or clumps of rubber): 0.6 at random, 1 when
/// every grain stands square to the box. 0 without rubber.
double rubber_alignment(const Simulation& s);

struct OverlapReport {
  double largest = 0.0;  ///< overlap over the smaller radius
  int ball_i = -1, ball_j = -1;
  int wall = -1;   ///< instead of ball_j
  int caught = 0;  ///< pairs of different bodies with a ball centre inside the other ball
};
OverlapReport worst_overlap(const Simulation& s);

enum class TroubleKind : std::uint8_t { none, no_number, outside, runaway, overlap };

/// What a watchdog found first.
struct Trouble {
  TroubleKind kind = TroubleKind::none;
  std::string text;  ///< one sentence that names the worst offender; empty when all is well
  Vec3 place;        ///< m, of a ball outside
};

/// Is every number of the balls, walls and works finite? Forces and histories that are not, reach the velocities within a step. As fast
/// as memory is read, so it can be asked often.
bool has_only_numbers(const Simulation& s);

/// A ball that moves by more than this share of its radius in one step has been thrown by an unstable step: in a healthy test, fills
/// and breaking force chains included, it is a hundredth of it.
inline constexpr double k_longest_move = 0.1;

/// A value that is no number, a ball whose centre lies in none of the rooms, a ball that moves too far in a step, an overlap beyond
/// the limit (over the smaller radius).
Trouble find_trouble(const Simulation& s, std::span<const Bounds> rooms, double overlap_limit);

/// Number of bodies with a ball whose centre lies in none of the rooms.
int count_lost_bodies(const Simulation& s, std::span<const Bounds> rooms);

/// formula:  -sum m g . x, J: potential energy of the grains in the gravity of the scene, zero at the origin.
double gravity_energy(const Simulation& s);

/// Centre of a rubber grain (mean of its balls) and of a clump.
Vec3 body_position(const Simulation& s, int body);

}  // namespace dem
