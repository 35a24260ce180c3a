// SPDX-License-Identifier: BSD-3-Clause
// Forces between bonded balls beside the bond and its frictionless spring: options of the rubber study, off by default,
// and therefore written for clarity, one pair at a time.
#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/rubber_parts.hpp"

namespace dem::DEM_TARGET {

namespace {

struct Companion {
  Vec3 force, shear;  // on ball i, N; the part of it that is remembered
  double slip = 0.0, dashpot = 0.0;
};

template <HertzOptions options>
Companion companion_of(const Simulation& s, const RubberSize& size, const HertzGeometry& g) {
  if (s.scene.bond.hertz_contact) {
    const HertzForce f = hertz_mindlin<options>(size.second_neighbour, g.motion, s.last_dt);
    return {f.shear_total - g.normal * f.normal_total, f.shear, f.slip_work, f.dashpot_work};
  }
  const SpringShear f = linear_spring_shear(size.bond, g.motion, s.last_dt);
  return {f.shear, f.shear, f.slip_work, 0.0};
}

template <HertzOptions options>
void add_companions(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t w = k_lanes;
  const GrainBlock g = grain_block(s.balls, block);
  const RubberSize& size = s.rubber_of_block(block);
  const double r = size.ball_radius;
  const bool can_break = s.scene.bond.form == BondForm::incremental;
  for (std::size_t k = 0; k < k_grain_bonds; ++k) {
    const SlotPair pair = k_bonds_of_grain[k];
    double* stored = s.grain_history.companion_shear.data() + (block * k_grain_bonds + k) * 3 * w;
    for (std::size_t lane = 0; lane < w; ++lane) {
      // A broken pair is a Hertz contact already.
      if (can_break && s.grain_history.bond_is_broken[(block * k_grain_bonds + k) * w + lane] != 0) continue;
      const std::size_t a = ball_at(pair.i, lane), b = ball_at(pair.j, lane);
      double* h = stored + lane;
      const HertzGeometry geometry = hertz_geometry({load3(g.x, g.y, g.z, b) - load3(g.x, g.y, g.z, a),
                                                     load3(g.vx, g.vy, g.vz, b) - load3(g.vx, g.vy, g.vz, a),
                                                     load3(g.wx, g.wy, g.wz, a),
                                                     load3(g.wx, g.wy, g.wz, b),
                                                     r,
                                                     r,
                                                     {h[0], h[w], h[2 * w]}},
                                                    s.last_dt);
      const Companion c = companion_of<options>(s, size, geometry);
      h[0] = c.shear.x, h[w] = c.shear.y, h[2 * w] = c.shear.z;
      const Vec3 couple = cross(geometry.normal, c.force);
      add_load(out, load_at(pair.i, lane), c.force, couple * geometry.lever_i);
      add_load(out, load_at(pair.j, lane), -c.force, couple * geometry.lever_j);
      losses.slip[lane] += c.slip;
      losses.dashpot[lane] += c.dashpot;
    }
  }
}

}  // namespace

void add_bond_companions(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  with_hertz_options(s.scene.contact,
                     [&](auto options) { add_companions<decltype(options)::value>(s, block, out, losses); });
}

}  // namespace dem::DEM_TARGET
