// SPDX-License-Identifier: BSD-3-Clause
// Energies and the fingerprint of a state. Called when something is recorded, not in every step.
#include <cmath>

#include "dem4grm/core/state_hash.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

double kinetic_energy(const Simulation& s) {
  double energy = 0.0;
  for (int id = 0; id < s.balls.n_rubber_balls(); ++id) {
    const RubberSize& size = s.rubber_of_grain(id / k_grain_balls);
    const double m = size.ball_mass, r = size.ball_radius;
    const int i = s.balls.index_of_id(id);
    const Vec3 v = s.balls.velocity(i), w = s.balls.spin(i);
    energy += 0.5 * m * dot(v, v) + 0.2 * m * r * r * dot(w, w);
  }
  for (const Clump& c : s.clumps.clumps) {
    energy += 0.5 * c.mass * dot(c.velocity, c.velocity) + 0.5 * dot(c.angular_momentum, c.spin);
  }
  return energy;
}

double contact_energy(const Simulation& s) {
  const ContactTable& t = s.contacts;
  double energy = 0.0;
  for (std::size_t row = 0; row < t.n_rows(); ++row) {
    if (t.radius_i[row] <= 0.0 || dot(t.force(row), t.force(row)) == 0.0) continue;
    energy +=
        hertz_mindlin_energy({t.hertz[row], t.shear_ratio[row], 0.0, 0.0, 0.0}, t.state[row].overlap, t.shear(row));
  }
  return energy;
}

double second_neighbour_energy(const Simulation& s, int grain) {
  const std::size_t w = k_lanes, block = static_cast<std::size_t>(grain) / w,
                    lane = static_cast<std::size_t>(grain) % w;
  const RubberSize& size = s.rubber_of_grain(grain);
  double energy = 0.0;
  for (std::size_t q = 0; q < k_grain_second_neighbours; ++q) {
    const SlotPair pair = k_second_neighbours_of_grain[q];
    const Vec3 d = s.balls.position(BallStore::rubber_index(grain, pair.j)) -
                   s.balls.position(BallStore::rubber_index(grain, pair.i));
    const double* h =
        s.grain_history.second_neighbour_shear.data() + (block * k_grain_second_neighbours + q) * 3 * w + lane;
    energy += hertz_mindlin_energy(size.second_neighbour, 2.0 * size.ball_radius - norm(d), {h[0], h[w], h[2 * w]});
  }
  return energy;
}

/// Stored by what acts beside an unbroken bond and its frictionless spring.
double companion_energy(const Simulation& s, int grain, int bond_index, double length) {
  if (s.grain_history.companion_shear.empty()) return 0.0;
  const std::size_t w = k_lanes, block = static_cast<std::size_t>(grain) / w,
                    lane = static_cast<std::size_t>(grain) % w;
  const double* h = s.grain_history.companion_shear.data() +
                    (block * k_grain_bonds + static_cast<std::size_t>(bond_index)) * 3 * w + lane;
  const Vec3 shear{h[0], h[w], h[2 * w]};
  const RubberSize& size = s.rubber_of_grain(grain);
  if (s.scene.bond.hertz_contact) {
    return hertz_mindlin_energy(size.second_neighbour, 2.0 * size.ball_radius - length, shear);
  }
  const double stiffness = size.bond.linear_shear_stiffness;
  return stiffness > 0.0 ? 0.5 * dot(shear, shear) / stiffness : 0.0;
}

}  // namespace

BondReading read_bond(const Simulation& s, int grain, int bond_index) {
  const SlotPair pair = k_bonds_of_grain[static_cast<std::size_t>(bond_index)];
  const int a = BallStore::rubber_index(grain, pair.i), b = BallStore::rubber_index(grain, pair.j);
  const std::size_t w = k_lanes, block = static_cast<std::size_t>(grain) / w,
                    lane = static_cast<std::size_t>(grain) % w;
  const Vec3 branch = s.balls.position(b) - s.balls.position(a);
  const BondParameters& bond = s.rubber_of_grain(grain).bond;
  BondReading out;
  out.length = norm(branch);
  out.normal = branch * (1.0 / out.length);
  if (s.scene.bond.form == BondForm::incremental) {
    const std::size_t k = block * k_grain_bonds + static_cast<std::size_t>(bond_index);
    const double* h = s.grain_history.bond.data() + k * 6 * w + lane;
    out.is_broken = s.grain_history.bond_is_broken[k * w + lane] != 0;
    out.shear = {h[0], h[w], h[2 * w]};
    if (!out.is_broken) out.moment = {h[3 * w], h[4 * w], h[5 * w]};
  } else {
    const Vec3 direction =
        (grain_site(pair.j) - grain_site(pair.i)) * (1.0 / norm(grain_site(pair.j) - grain_site(pair.i)));
    const Quaternion qi = s.balls.orientation(a), qj = s.balls.orientation(b);
    const BondForce f = history_free_bond(bond, branch, {}, rotate(qi, direction) + rotate(qj, direction), qi, qj);
    out.shear = perpendicular(f.force, out.normal);
    out.moment = f.moment;
  }
  if (!out.is_broken) out.normal_force = bond_normal_force(bond, out.length, 0.0);
  return out;
}

EnergyReport Simulation::energy() const {
  EnergyReport e;
  e.kinetic = kinetic_energy(*this);
  e.contact_strain = contact_energy(*this);
  for (int g = 0; g < balls.n_grains; ++g) {
    const RubberSize& size = rubber_of_grain(g);
    for (int k = 0; k < k_grain_bonds; ++k) {
      const BondReading r = read_bond(*this, g, k);
      e.bond_strain +=
          r.is_broken
              ? hertz_mindlin_energy(size.second_neighbour, 2.0 * size.ball_radius - r.length, r.shear)
              : bond_energy(size.bond, r.length, r.shear, r.moment, r.normal) + companion_energy(*this, g, k, r.length);
    }
    e.contact_strain += second_neighbour_energy(*this, g);
  }
  e.boundary_work = ledger.boundary;
  e.slip = ledger.contact_slip;
  e.dashpot = ledger.contact_dashpot;
  for (int g = 0; g < balls.n_grains; ++g) {
    const auto k = static_cast<std::size_t>(g);
    e.slip += ledger.grain_slip[k];
    e.dashpot += ledger.grain_dashpot[k];
    e.local_damping += ledger.grain_damping[k];
    e.breakage += ledger.grain_breakage[k];
  }
  for (const double w : ledger.clump_damping) e.local_damping += w;
  return e;
}

std::string Simulation::state_hash() const {
  StateHash h;
  h.add(steps);
  h.add(time);
  h.add(dt);
  for (int id = 0; id < balls.n_rubber_balls(); ++id) {
    const double* ball = balls.state.data() + balls.index_of_id(id);
    for (std::size_t c = 0; c < k_rubber_components; ++c) h.add(ball[c * k_lanes]);
  }
  const std::size_t w = k_lanes;
  for (int g = 0; g < balls.n_grains; ++g) {
    const std::size_t block = static_cast<std::size_t>(g) / w, lane = static_cast<std::size_t>(g) % w;
    for (std::size_t k = 0; k < k_grain_second_neighbours * 3; ++k) {
      // Adding zero drops the sign of -0, which an open pair keeps or not depending on the lanes beside it.
      h.add(grain_history.second_neighbour_shear[(block * k_grain_second_neighbours * 3 + k) * w + lane] + 0.0);
    }
    if (!grain_history.companion_shear.empty()) {
      for (std::size_t k = 0; k < k_grain_bonds * 3; ++k) {
        h.add(grain_history.companion_shear[(block * k_grain_bonds * 3 + k) * w + lane]);
      }
    }
    if (scene.bond.form != BondForm::incremental) continue;
    for (std::size_t k = 0; k < k_grain_bonds * 6; ++k) {
      h.add(grain_history.bond[(block * k_grain_bonds * 6 + k) * w + lane]);
    }
    for (std::size_t k = 0; k < k_grain_bonds; ++k) {
      h.add(grain_history.bond_is_broken[(block * k_grain_bonds + k) * w + lane]);
    }
  }
  for (const Clump& c : clumps.clumps) {
    for (const Vec3& v : {c.position, c.velocity, c.angular_momentum, c.spin}) h.add(v);
    h.add(c.orientation);
  }
  // Only rows with history: which further candidates are listed is no part of the state.
  const auto add_row = [&](PairKey key, std::size_t row) {
    const Vec3 f = contacts.shear(row);
    if (f.x == 0.0 && f.y == 0.0 && f.z == 0.0) return;
    h.add(key);
    h.add(f);
  };
  for (std::size_t c = 0; c < contacts.n_pairs(); ++c) add_row(contacts.pairs[c], c);
  for (std::size_t c = 0; c < contacts.wall_pairs.size(); ++c)
    add_row(contacts.wall_pairs[c], contacts.n_pair_rows() + c);
  for (const Wall& wall : walls) {
    h.add(wall.corner);
    h.add(wall.velocity);
  }
  return h.text();
}

}  // namespace dem
