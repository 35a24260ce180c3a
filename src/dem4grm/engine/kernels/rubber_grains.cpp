// SPDX-License-Identifier: BSD-3-Clause
// Stage: rubber grains, one block of k_lanes grains at a time, from contact forces to new positions in one pass.
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/engine/kernels/contact_sums.hpp"
#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"
#include "dem4grm/engine/kernels/rubber_parts.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"

namespace dem::DEM_TARGET {

namespace {

/// Local damping, leapfrog and rotation of all balls of a block; returns the largest speed squared.
double integrate(Simulation& s, const GrainBlock& g, const BlockForces& load, double radius, const double* inverse_mass,
                 double* damping_work) {
  const double dt = s.dt, kick = s.kick_time(), alpha = s.scene.integration.local_damping;
  // Solid ball: I = 2/5 m r^2.
  const double inertia_factor = 2.5 / (radius * radius);
  alignas(64) double top[k_lanes] = {};
  alignas(64) double lost[k_lanes] = {};
  for (std::size_t slot = 0; slot < k_grain_balls; ++slot) {
#pragma omp simd
    for (std::size_t lane = 0; lane < k_lanes; ++lane) {
      const std::size_t k = ball_at(slot, lane);
      const double* of_ball = load.value + load_at(slot, lane);
      const Vec3 force{of_ball[0], of_ball[k_lanes], of_ball[2 * k_lanes]};
      const Vec3 torque{of_ball[3 * k_lanes], of_ball[4 * k_lanes], of_ball[5 * k_lanes]};
      const Vec3 v = load3(g.vx, g.vy, g.vz, k), w = load3(g.wx, g.wy, g.wz, k);
      const Vec3 damped_force = locally_damped(force, v, alpha), damped_torque = locally_damped(torque, w, alpha);
      const double per_mass = inverse_mass[lane] * kick;
      const Vec3 new_v = v + damped_force * per_mass;
      const Vec3 new_w = w + damped_torque * (per_mass * inertia_factor);
      g.vx[k] = new_v.x;
      g.vy[k] = new_v.y;
      g.vz[k] = new_v.z;
      g.wx[k] = new_w.x;
      g.wy[k] = new_w.y;
      g.wz[k] = new_w.z;
      g.x[k] += new_v.x * dt;
      g.y[k] += new_v.y * dt;
      g.z[k] += new_v.z * dt;
      const Quaternion q = turned_a_little({g.qw[k], g.qx[k], g.qy[k], g.qz[k]}, new_w, dt);
      g.qw[k] = q.w;
      g.qx[k] = q.x;
      g.qy[k] = q.y;
      g.qz[k] = q.z;
      const double speed2 = dot(new_v, new_v);
      top[lane] = speed2 > top[lane] ? speed2 : top[lane];
      lost[lane] += dot(force - damped_force, v + new_v) + dot(torque - damped_torque, w + new_w);
    }
  }
  double fastest = 0.0;
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    damping_work[lane] += 0.5 * kick * lost[lane];
    fastest = std::max(fastest, inverse_mass[lane] > 0.0 ? top[lane] : 0.0);
  }
  return fastest;
}

/// Adds the weight of every ball of a block to its load; lanes without a grain have none.
void add_weights(BlockForces& load, const Vec3& gravity, const double* inverse_mass) {
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const Vec3 weight = inverse_mass[lane] > 0.0 ? gravity * (1.0 / inverse_mass[lane]) : Vec3{};
    for (std::size_t slot = 0; slot < k_grain_balls; ++slot) add_load(load, load_at(slot, lane), weight, {});
  }
}

template <HertzOptions options>
void advance_block(Simulation& s, std::size_t block) {
  BlockForces load;
  ContactLoads contacts;
  BlockLosses losses;
  const GrainBlock g = grain_block(s.balls, block);
  gather_contacts<options.dashpots>(s, block, contacts);
  begin_loads(contacts, load);
  add_second_neighbours(s, block, g, load, losses);
  if (s.scene.bond.form == BondForm::incremental) {
    add_incremental_bonds(s, block, load, losses);
  } else {
    add_history_free_bonds(s.rubber_of_block(block).bond, g, s.last_dt, load, losses);
  }
  if (!s.grain_history.companion_shear.empty()) add_bond_companions(s, block, load, losses);
  const std::size_t first = block * k_lanes;
  if (has_gravity(s.scene)) add_weights(load, s.scene.gravity, s.lane_inverse_mass.data() + first);
  s.block_top_speed2[block] = integrate(s, g, load, s.rubber_of_block(block).ball_radius,
                                        s.lane_inverse_mass.data() + first, s.ledger.grain_damping.data() + first);
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    s.ledger.grain_slip[first + lane] += losses.slip[lane];
    s.ledger.grain_dashpot[first + lane] += losses.dashpot[lane];
  }
}

}  // namespace

void advance_rubber_grains(Simulation& s) {
  const auto blocks = static_cast<std::size_t>(s.balls.n_blocks);
  const auto part_length = static_cast<std::size_t>(s.rubber_batches.part_length);
  with_hertz_options(s.scene.contact, [&](auto options) {
    if (part_length == 0) {
      for_each_block(blocks, 1, [&](std::size_t block, std::size_t, std::size_t) {
        advance_block<decltype(options)::value>(s, block);
      });
      return;
    }
    for_each_block(blocks, part_length, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t block = begin; block < end; ++block) {
        evaluate_waiting_contacts(s, block);
        advance_block<decltype(options)::value>(s, block);
      }
    });
  });
  if (part_length > 0) add_works_of_rubber(s);
  s.rubber_batches.part_length = 0;
}

void evaluate_bonds_alone(Simulation& s, std::span<double> kept) {
  for_each_block(static_cast<std::size_t>(s.balls.n_blocks), 1, [&](std::size_t block, std::size_t, std::size_t) {
    BlockForces load;
    BlockLosses losses;
    begin_loads(ContactLoads{}, load);
    add_history_free_bonds(s.rubber_of_block(block).bond, grain_block(s.balls, block), s.dt, load, losses);
    kept[block] = load.value[0] + losses.dashpot[0];
  });
}

void sum_contacts_alone(Simulation& s, std::span<double> kept) {
  for_each_block(static_cast<std::size_t>(s.balls.n_blocks), 1, [&](std::size_t block, std::size_t, std::size_t) {
    ContactLoads contacts;
    if (s.contacts.has_dashpots()) {
      gather_contacts<true>(s, block, contacts);
    } else {
      gather_contacts<false>(s, block, contacts);
    }
    kept[block] = contacts.value[0][0];
  });
}

}  // namespace dem::DEM_TARGET
