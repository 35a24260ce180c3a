// SPDX-License-Identifier: BSD-3-Clause
// Stage: clumps. Adds up the forces on each body, damps, moves, and carries its pebbles along.
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"

namespace dem {

namespace {

struct Load {
  Vec3 force, torque;
};

/// Net force and torque about the centroid of clump c, over its contact rows in order.
Load gather(const Simulation& s, std::size_t c) {
  const Vec3 centroid = s.clumps.clumps[c].position;
  const ContactTable& t = s.contacts;
  const std::size_t owner = static_cast<std::size_t>(s.balls.n_blocks) + c;
  Load load;
  for (int k = s.references.start[owner]; k < s.references.start[owner + 1]; ++k) {
    const auto row = static_cast<std::size_t>(s.references.row[static_cast<std::size_t>(k)]);
    const int place = s.references.place[static_cast<std::size_t>(k)];
    const bool second = (place & ContactReferences::k_second) != 0;
    const double sign = second ? -1.0 : 1.0;
    const double lever = second ? t.lever_j[row] : t.lever_i[row];
    const Vec3 f = t.force(row) * sign;
    const Vec3 arm = s.balls.position(place & ~ContactReferences::k_second) - centroid;
    load.force += f;
    load.torque += cross(arm, f) + Vec3{t.couple_x[row], t.couple_y[row], t.couple_z[row]} * lever;
  }
  return load;
}

/// Places the pebbles; their velocity is their displacement over the step, which the contact law relies on.
double carry_pebbles(Simulation& s, const Clump& body, double inverse_dt) {
  const Frame frame = frame_of(body.orientation);
  double top_speed2 = 0.0;
  for (int p = body.first_pebble; p < body.first_pebble + body.n_pebbles; ++p) {
    const int i = s.balls.pebble_index(p);
    const Vec3 to = body.position + to_space(frame, s.clumps.pebble_offset[static_cast<std::size_t>(p)]);
    const Vec3 v = (to - s.balls.position(i)) * inverse_dt;
    s.balls.set_position(i, to);
    s.balls.set_velocity(i, v);
    s.balls.set_spin(i, body.spin);
    top_speed2 = std::max(top_speed2, dot(v, v));
  }
  return top_speed2;
}

double advance(Simulation& s, std::size_t c) {
  Clump& body = s.clumps.clumps[c];
  const double dt = s.dt, alpha = s.scene.integration.local_damping;
  const Load load = gather(s, c);
  const Vec3 force = locally_damped(load.force, body.velocity, alpha);
  const Vec3 torque = locally_damped(load.torque, body.spin, alpha);
  const Vec3 velocity_before = body.velocity, spin_before = body.spin;
  body.velocity += force * (dt / body.mass);
  body.angular_momentum += torque * dt;
  body.position += body.velocity * dt;
  const Vec3 inverse_inertia{1.0 / body.inertia.x, 1.0 / body.inertia.y, 1.0 / body.inertia.z};
  const FreeRotation turn = rotate_freely(body.orientation, body.angular_momentum, inverse_inertia, dt);
  body.orientation = turn.orientation;
  body.spin = turn.spin;
  s.ledger.clump_damping[c] +=
      0.5 * dt *
      (dot(load.force - force, body.velocity + velocity_before) + dot(load.torque - torque, body.spin + spin_before));
  return carry_pebbles(s, body, 1.0 / dt);
}

}  // namespace

void advance_clumps(Simulation& s) {
  const auto first = static_cast<std::size_t>(s.balls.n_blocks);
  for_each_block(s.clumps.clumps.size(), k_clump_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    double top_speed2 = 0.0;
    for (std::size_t c = begin; c < end; ++c) top_speed2 = std::max(top_speed2, advance(s, c));
    s.block_top_speed2[first + block] = top_speed2;
  });
}

}  // namespace dem
