// SPDX-License-Identifier: BSD-3-Clause
#include "naive_step.hpp"

#include <algorithm>

#include "dem4grm/core/error.hpp"
#include "dem4grm/laws/local_damping.hpp"
#include "dem4grm/laws/rigid_rotation.hpp"

namespace bench {

using namespace dem;

namespace {

constexpr HertzOptions k_plain{};

void add_atomically(double& to, double value) {
#pragma omp atomic
  to += value;
}

Vec3 bond_direction(const SlotPair& pair) {
  const Vec3 d = grain_site(pair.j) - grain_site(pair.i);
  return d * (1.0 / norm(d));
}

}  // namespace

NaiveStep::NaiveStep(const Simulation& s) {
  if (!s.clumps.clumps.empty() || s.scene.bond.form == BondForm::incremental || s.contacts.has_dashpots() ||
      !s.grain_history.companion_shear.empty() || s.scene.contact.hz_mode != 0) {
    throw InputError("the naive step knows rubber grains with history-free bonds and contacts without dashpots only");
  }
  const auto n = static_cast<std::size_t>(s.balls.n_balls());
  force_.resize(n);
  torque_.resize(n);
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const int i = s.balls.index_of_id(id);
    position_.push_back(s.balls.position(i));
    velocity_.push_back(s.balls.velocity(i));
    spin_.push_back(s.balls.spin(i));
    orientation_.push_back(s.balls.orientation(i));
  }
  for (std::size_t row = 0; row < s.contacts.n_pairs(); ++row) contact_shear_.push_back(s.contacts.shear(row));
  for (int g = 0; g < s.balls.n_grains; ++g) {
    const auto block = static_cast<std::size_t>(g) / k_lanes, lane = static_cast<std::size_t>(g) % k_lanes;
    for (std::size_t q = 0; q < k_grain_second_neighbours; ++q) {
      const double* h =
          s.grain_history.second_neighbour_shear.data() + (block * k_grain_second_neighbours + q) * 3 * k_lanes + lane;
      second_neighbour_shear_.push_back({h[0], h[k_lanes], h[2 * k_lanes]});
    }
  }
}

void NaiveStep::add(int ball, const Vec3& force, const Vec3& torque) {
  Vec3& f = force_[static_cast<std::size_t>(ball)];
  Vec3& t = torque_[static_cast<std::size_t>(ball)];
  add_atomically(f.x, force.x), add_atomically(f.y, force.y), add_atomically(f.z, force.z);
  add_atomically(t.x, torque.x), add_atomically(t.y, torque.y), add_atomically(t.z, torque.z);
}

void NaiveStep::add_contacts(const Simulation& s) {
  const double r = s.scene.rubber_ball_radius;
  const auto n = static_cast<std::ptrdiff_t>(s.contacts.n_pairs());
  double slip = 0.0;
#pragma omp parallel for reduction(+ : slip)
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const int i = first_of(s.contacts.pairs[row]), j = second_of(s.contacts.pairs[row]);
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const Vec3 branch = position_[b] - position_[a];
    if (dot(branch, branch) >= 4.0 * r * r) {
      contact_shear_[row] = {};
      continue;
    }
    const HertzGeometry g =
        hertz_geometry({branch, velocity_[b] - velocity_[a], spin_[a], spin_[b], r, r, contact_shear_[row]}, s.dt);
    const HertzForce f = hertz_mindlin<k_plain>(s.contacts.between_rubber_balls, g.motion, s.dt);
    contact_shear_[row] = f.shear;
    slip += f.slip_work;
    const Vec3 force = f.shear - g.normal * f.normal, couple = cross(g.normal, f.shear);
    add(i, force, couple * g.lever_i);
    add(j, -force, couple * g.lever_j);
  }
  slip_ += slip;
}

void NaiveStep::add_walls(const Simulation& s) {
  const ContactTable& t = s.contacts;
  for (std::size_t k = 0; k < t.wall_pairs.size(); ++k) {
    const std::size_t row = t.n_pair_rows() + k;
    add(first_of(t.wall_pairs[k]), t.force(row), t.couple(row) * t.lever_i(row));
  }
}

void NaiveStep::add_grain(const Simulation& s, int grain) {
  const int base = grain * k_grain_balls;
  const double r = s.scene.rubber_ball_radius;
  for (std::size_t q = 0; q < k_grain_second_neighbours; ++q) {
    const SlotPair pair = k_second_neighbours_of_grain[q];
    const auto a = static_cast<std::size_t>(base + pair.i), b = static_cast<std::size_t>(base + pair.j);
    const Vec3 branch = position_[b] - position_[a];
    Vec3& shear = second_neighbour_shear_[static_cast<std::size_t>(grain) * k_grain_second_neighbours + q];
    if (dot(branch, branch) >= 4.0 * r * r) {
      shear = {};
      continue;
    }
    const HertzGeometry g =
        hertz_geometry({branch, velocity_[b] - velocity_[a], spin_[a], spin_[b], r, r, shear}, s.dt);
    const HertzForce f = hertz_mindlin<k_plain>(s.rubber().second_neighbour, g.motion, s.dt);
    shear = f.shear;
    const Vec3 force = f.shear - g.normal * f.normal, couple = cross(g.normal, f.shear);
    force_[a] += force, torque_[a] += couple * g.lever_i;
    force_[b] += -force, torque_[b] += couple * g.lever_j;
  }
  for (const SlotPair& pair : k_bonds_of_grain) {
    const auto a = static_cast<std::size_t>(base + pair.i), b = static_cast<std::size_t>(base + pair.j);
    const Vec3 direction = bond_direction(pair);
    const Vec3 directions = rotate(orientation_[a], direction) + rotate(orientation_[b], direction);
    const BondForce f = history_free_bond(s.rubber().bond, position_[b] - position_[a], velocity_[b] - velocity_[a],
                                          directions, orientation_[a], orientation_[b]);
    force_[a] += f.force, torque_[a] += f.couple + f.moment;
    force_[b] += -f.force, torque_[b] += f.couple - f.moment;
  }
}

void NaiveStep::move_ball(const Simulation& s, int ball) {
  const auto b = static_cast<std::size_t>(ball);
  const double r = s.scene.rubber_ball_radius, alpha = s.scene.integration.local_damping;
  const double per_mass = s.dt / s.rubber().ball_mass;
  velocity_[b] += locally_damped(force_[b], velocity_[b], alpha) * per_mass;
  spin_[b] += locally_damped(torque_[b], spin_[b], alpha) * (per_mass * 2.5 / (r * r));
  position_[b] += velocity_[b] * s.dt;
  orientation_[b] = turned(orientation_[b], spin_[b], s.dt);
}

void NaiveStep::run(const Simulation& s) {
  const int balls = s.balls.n_balls(), grains = s.balls.n_grains;
#pragma omp parallel for
  for (int b = 0; b < balls; ++b) force_[static_cast<std::size_t>(b)] = torque_[static_cast<std::size_t>(b)] = {};
  add_contacts(s);
  add_walls(s);
#pragma omp parallel for
  for (int g = 0; g < grains; ++g) add_grain(s, g);
#pragma omp parallel for
  for (int b = 0; b < balls; ++b) move_ball(s, b);
}

double NaiveStep::distance_to(const Simulation& s) const {
  double largest = 0.0;
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const Vec3 d = s.balls.position(s.balls.index_of_id(id)) - position_[static_cast<std::size_t>(id)];
    largest = std::max(largest, norm(d));
  }
  return largest;
}

}  // namespace bench
