// SPDX-License-Identifier: BSD-3-Clause
// Stage: clumps. Adds up the forces on each body, damps, moves, and carries its pebbles along.
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/lane_vectors.hpp"
#include "dem4grm/core/registers.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"

namespace dem::DEM_TARGET {

namespace {

/// Three numbers of a vector in one register; the fourth lane holds whatever lies beside them, and nobody reads it.
struct Load {
  Four force{}, torque{};
};

/// Net force and torque about the centroid of clump c, over its contact rows in order.
///   force = sign (F_s - n F_n),   torque = (ball - centroid + sign lever n) x force     (ContactTable)
template <bool dashpots>
DEM_INLINE Load gather(const Simulation& s, std::size_t c) {
  const Vec3& at = s.clumps.clumps[c].position;
  const Four centroid{at.x, at.y, at.z, 0.0};
  const ContactTable& t = s.contacts;
  const ContactState* const states = t.state.data();
  const double* const balls = s.balls.state.data();
  const int* const rows = s.references.row.data();
  const int* const places = s.references.place.data();
  const std::size_t owner = static_cast<std::size_t>(s.balls.n_blocks) + c;
  const int end = s.references.start[owner + 1], last = s.references.start.back() - 1;
  // The second body of a row feels the opposite force. A table, because a branch would be guessed wrong half of the time.
  constexpr double sign_of_side[2] = {1.0, -1.0};
  Load load;
  for (int k = s.references.start[owner]; k < end; ++k) {
    // Beyond the end lie the references of the next clump.
    __builtin_prefetch(states + rows[std::min(k + k_references_ahead, last)]);
    const auto row = static_cast<std::size_t>(rows[k]);
    const ContactState& contact = states[row];
    const double* const ball = balls + (places[k] & ~ContactReferences::k_second);
    const double sign = sign_of_side[(places[k] & ContactReferences::k_second) != 0 ? 1 : 0];
    const double lever = ball[k_pebble_radius_at] - 0.5 * contact.overlap;
    const Four n = dem::load<Four>(&contact.normal.x);
    Four shear = dem::load<Four>(&contact.shear.x);
    if constexpr (dashpots) shear += Four{t.damping_x[row], t.damping_y[row], t.damping_z[row], 0.0};
    const Four force = (shear - n * contact.normal_force) * sign;
    const Four arm = dem::load<Four>(ball) - centroid + n * (sign * lever);
    load.force += force;
    load.torque += cross(arm, force);
  }
  return load;
}

DEM_INLINE Four in_register(const Vec3& v, double fourth = 0.0) { return Four{v.x, v.y, v.z, fourth}; }

/// Places the pebbles; their velocity is their displacement over the step, which the contact law relies on. Three numbers
/// of a record are written by a register of four, so the next ones follow at once.
double carry_pebbles(Simulation& s, const Clump& body, double inverse_dt) {
  const Frame frame = frame_of(body.orientation);
  const Four e1 = in_register(frame.e1), e2 = in_register(frame.e2), e3 = in_register(frame.e3);
  const Four centroid = in_register(body.position);
  const auto first = static_cast<std::size_t>(body.first_pebble);
  double* record = s.balls.state.data() + s.balls.pebble_index(body.first_pebble);
  double top_speed2 = 0.0;
  for (std::size_t p = first; p < first + static_cast<std::size_t>(body.n_pebbles); ++p, record += k_pebble_record) {
    const Vec3& offset = s.clumps.pebble_offset[p];
    const Four spin = in_register(body.spin, record[k_pebble_radius_at]);
    const Four to = centroid + (e1 * offset.x + e2 * offset.y + e3 * offset.z);
    const Four v = (to - dem::load<Four>(record)) * inverse_dt;
    dem::store(record, to);
    dem::store(record + 3, v);
    dem::store(record + 6, spin);
    top_speed2 = std::max(top_speed2, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  return top_speed2;
}

/// Clumps that move side by side, one in each lane.
constexpr std::size_t k_clump_lanes = 8;
static_assert(k_clump_block % k_clump_lanes == 0);

struct alignas(64) ClumpLanes {
  LaneVectors<k_clump_lanes> position, velocity, momentum, spin, force, torque, inertia;
  double orientation[4][k_clump_lanes], mass[k_clump_lanes], lost[k_clump_lanes];
};

void load(const Clump& body, const Load& load, ClumpLanes& c, std::size_t lane) {
  put(c.position, lane, body.position);
  put(c.velocity, lane, body.velocity);
  put(c.momentum, lane, body.angular_momentum);
  put(c.spin, lane, body.spin);
  put(c.force, lane, {load.force[0], load.force[1], load.force[2]});
  put(c.torque, lane, {load.torque[0], load.torque[1], load.torque[2]});
  put(c.inertia, lane, body.inertia);
  c.orientation[0][lane] = body.orientation.w, c.orientation[1][lane] = body.orientation.x;
  c.orientation[2][lane] = body.orientation.y, c.orientation[3][lane] = body.orientation.z;
  c.mass[lane] = body.mass;
}

void store(const ClumpLanes& c, std::size_t lane, Clump& body) {
  body.position = taken(c.position, lane);
  body.velocity = taken(c.velocity, lane);
  body.angular_momentum = taken(c.momentum, lane);
  body.spin = taken(c.spin, lane);
  body.orientation = {c.orientation[0][lane], c.orientation[1][lane], c.orientation[2][lane], c.orientation[3][lane]};
}

/// Adds the weight of every lane's clump to its force.
void add_weights(ClumpLanes& c, const Vec3& gravity) {
  for (std::size_t lane = 0; lane < k_clump_lanes; ++lane) {
    put(c.force, lane, taken(c.force, lane) + gravity * c.mass[lane]);
  }
}

/// Damping, leapfrog and rotation of one lane.
DEM_INLINE void move(ClumpLanes& c, std::size_t lane, double dt, double kick, double alpha) {
  const Vec3 velocity_before = taken(c.velocity, lane), spin_before = taken(c.spin, lane);
  const Vec3 all_force = taken(c.force, lane), all_torque = taken(c.torque, lane);
  const Vec3 force = locally_damped(all_force, velocity_before, alpha);
  const Vec3 torque = locally_damped(all_torque, spin_before, alpha);
  const Vec3 velocity = velocity_before + force * (kick / c.mass[lane]);
  const Vec3 momentum = taken(c.momentum, lane) + torque * kick;
  const Vec3 inertia = taken(c.inertia, lane);
  const Quaternion before{c.orientation[0][lane], c.orientation[1][lane], c.orientation[2][lane],
                          c.orientation[3][lane]};
  const FreeRotation turn = rotate_freely(before, momentum, {1.0 / inertia.x, 1.0 / inertia.y, 1.0 / inertia.z}, dt);
  put(c.position, lane, taken(c.position, lane) + velocity * dt);
  put(c.velocity, lane, velocity);
  put(c.momentum, lane, momentum);
  put(c.spin, lane, turn.spin);
  c.orientation[0][lane] = turn.orientation.w, c.orientation[1][lane] = turn.orientation.x;
  c.orientation[2][lane] = turn.orientation.y, c.orientation[3][lane] = turn.orientation.z;
  c.lost[lane] =
      0.5 * kick *
      (dot(all_force - force, velocity + velocity_before) + dot(all_torque - torque, turn.spin + spin_before));
}

/// Clumps [begin, end), at most k_clump_lanes of them; returns the largest speed of a pebble squared.
template <bool dashpots>
double advance(Simulation& s, std::size_t begin, std::size_t end) {
  const double dt = s.dt, kick = s.kick_time(), alpha = s.scene.integration.local_damping;
  ClumpLanes c;
  for (std::size_t lane = 0; lane < k_clump_lanes; ++lane) {
    // Lanes without a clump move the first one again, and nobody looks.
    const std::size_t k = begin + lane < end ? begin + lane : begin;
    load(s.clumps.clumps[k], gather<dashpots>(s, k), c, lane);
  }
  if (has_gravity(s.scene)) add_weights(c, s.scene.gravity);
#pragma omp simd
  for (std::size_t lane = 0; lane < k_clump_lanes; ++lane) move(c, lane, dt, kick, alpha);
  double top_speed2 = 0.0;
  for (std::size_t k = begin; k < end; ++k) {
    store(c, k - begin, s.clumps.clumps[k]);
    s.ledger.clump_damping[k] += c.lost[k - begin];
    top_speed2 = std::max(top_speed2, carry_pebbles(s, s.clumps.clumps[k], 1.0 / dt));
  }
  return top_speed2;
}

template <bool dashpots>
void advance_all(Simulation& s) {
  const auto first = static_cast<std::size_t>(s.balls.n_blocks);
  for_each_block(s.clumps.clumps.size(), k_clump_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    double top_speed2 = 0.0;
    for (std::size_t c = begin; c < end; c += k_clump_lanes) {
      top_speed2 = std::max(top_speed2, advance<dashpots>(s, c, std::min(c + k_clump_lanes, end)));
    }
    s.block_top_speed2[first + block] = top_speed2;
  });
}

}  // namespace

void advance_clumps(Simulation& s) {
  if (s.contacts.has_dashpots()) {
    advance_all<true>(s);
  } else {
    advance_all<false>(s);
  }
}

}  // namespace dem::DEM_TARGET
