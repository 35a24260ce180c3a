// SPDX-License-Identifier: BSD-3-Clause
// The 64 bonds of k_lanes grains at once, in both forms.
#include "dem4grm/engine/grain_block.hpp"
#include "dem4grm/engine/hertz_dispatch.hpp"

namespace dem {

namespace {

constexpr double k_inverse_root3 = 0.57735026918962576451;

/// The four cube diagonals of a ball's own frame, towards octants 4 (--+), 5 (+-+), 6 (-++), 7 (+++), for all lanes.
struct alignas(64) Diagonals {
  double x[4][k_lanes], y[4][k_lanes], z[4][k_lanes];
};

DEM_INLINE Quaternion load_orientation(const GrainBlock& g, std::size_t k) {
  return {g.qw[k], g.qx[k], g.qy[k], g.qz[k]};
}

DEM_INLINE void fill_diagonals(const GrainBlock& g, int slot, Diagonals& d) {
  const std::size_t base = static_cast<std::size_t>(slot) * k_lanes;
#pragma omp simd
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const Frame f = frame_of(load_orientation(g, base + lane));
    const Vec3 a = f.e1 * k_inverse_root3, b = f.e2 * k_inverse_root3, c = f.e3 * k_inverse_root3;
    const Vec3 plus = a + b, minus = a - b;
    const Vec3 d4 = c - plus, d5 = c + minus, d6 = c - minus, d7 = c + plus;
    d.x[0][lane] = d4.x, d.y[0][lane] = d4.y, d.z[0][lane] = d4.z;
    d.x[1][lane] = d5.x, d.y[1][lane] = d5.y, d.z[1][lane] = d5.z;
    d.x[2][lane] = d6.x, d.y[2][lane] = d6.y, d.z[2][lane] = d6.z;
    d.x[3][lane] = d7.x, d.y[3][lane] = d7.y, d.z[3][lane] = d7.z;
  }
}

/// One bond of all lanes: centre slot i, corner slot j; `sign` turns the stored diagonal into the bond's direction.
DEM_INLINE void add_bond(const BondParameters& p, const GrainBlock& g, const SlotPair& bond, int diagonal, double sign,
                         const Diagonals& di, const Diagonals& dj, double dt, BlockForces& out, BlockLosses& losses) {
  const std::size_t i = bond.i * k_lanes, j = bond.j * k_lanes;
#pragma omp simd
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const std::size_t a = i + lane, b = j + lane;
    const Vec3 branch = load3(g.x, g.y, g.z, b) - load3(g.x, g.y, g.z, a);
    const Vec3 relative = load3(g.vx, g.vy, g.vz, b) - load3(g.vx, g.vy, g.vz, a);
    const Vec3 directions{(di.x[diagonal][lane] + dj.x[diagonal][lane]) * sign,
                          (di.y[diagonal][lane] + dj.y[diagonal][lane]) * sign,
                          (di.z[diagonal][lane] + dj.z[diagonal][lane]) * sign};
    const BondForce f =
        history_free_bond(p, branch, relative, directions, load_orientation(g, a), load_orientation(g, b));
    add_load(out, a, f.force, f.couple + f.moment);
    add_load(out, b, -f.force, f.couple - f.moment);
    losses.dashpot[lane] += f.dashpot_power * dt;
  }
}

}  // namespace

void add_history_free_bonds(const BondParameters& parameters, const GrainBlock& g, double dt, BlockForces& out,
                            BlockLosses& losses) {
  const BondParameters p = parameters;
  Diagonals corner[k_grain_corners];
  for (int slot = 0; slot < k_grain_corners; ++slot) fill_diagonals(g, slot, corner[slot]);
  for (int c = 0; c < k_grain_centres; ++c) {
    Diagonals centre;
    fill_diagonals(g, k_grain_corners + c, centre);
    for (int o = 0; o < 8; ++o) {
      const SlotPair bond = k_bonds_of_grain[static_cast<std::size_t>(8 * c + o)];
      const bool stored = o >= 4;
      add_bond(p, g, bond, stored ? o - 4 : 3 - o, stored ? 1.0 : -1.0, centre, corner[bond.j], dt, out, losses);
    }
  }
}

namespace {

/// Motion of slot pair (i, j) of one lane.
BondMotion motion_of(const GrainBlock& g, std::size_t a, std::size_t b) {
  return {load3(g.x, g.y, g.z, b) - load3(g.x, g.y, g.z, a), load3(g.vx, g.vy, g.vz, b) - load3(g.vx, g.vy, g.vz, a),
          load3(g.wx, g.wy, g.wz, a), load3(g.wx, g.wy, g.wz, b)};
}

/// A pair whose bond is gone: an ordinary Hertz contact with its shear history in the first three places.
template <HertzOptions options>
void add_broken_pair(const Simulation& s, const BondMotion& m, double* history, std::size_t a, std::size_t b,
                     std::size_t lane, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t w = k_lanes;
  const double r = s.scene.rubber_ball_radius;
  const HertzGeometry geometry = hertz_geometry(
      {m.branch, m.relative_velocity, m.spin_i, m.spin_j, r, r, {history[0], history[w], history[2 * w]}}, s.dt);
  const HertzForce f = hertz_mindlin<options>(s.second_neighbour, geometry.motion, s.dt);
  history[0] = f.shear.x;
  history[w] = f.shear.y;
  history[2 * w] = f.shear.z;
  const Vec3 force = f.shear_total - geometry.normal * f.normal_total;
  const Vec3 couple = cross(geometry.normal, f.shear_total);
  add_load(out, a, force, couple * geometry.lever_i);
  add_load(out, b, -force, couple * geometry.lever_j);
  losses.slip[lane] += f.slip_work;
  losses.dashpot[lane] += f.dashpot_work;
}

template <HertzOptions options>
void add_incremental(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t w = k_lanes;
  const GrainBlock g = grain_block(s.balls, block);
  for (std::size_t k = 0; k < k_grain_bonds; ++k) {
    const SlotPair pair = k_bonds_of_grain[k];
    double* stored = s.grain_history.bond.data() + (block * k_grain_bonds + k) * 6 * w;
    unsigned char* broken = s.grain_history.bond_is_broken.data() + (block * k_grain_bonds + k) * w;
    for (std::size_t lane = 0; lane < w; ++lane) {
      const std::size_t a = pair.i * w + lane, b = pair.j * w + lane;
      const BondMotion m = motion_of(g, a, b);
      double* h = stored + lane;
      if (broken[lane] == 0) {
        BondHistory history{{h[0], h[w], h[2 * w]}, {h[3 * w], h[4 * w], h[5 * w]}};
        bool breaks = false;
        const BondForce f = incremental_bond(s.bond, m, s.dt, history, breaks);
        if (!breaks) {
          h[0] = history.shear.x, h[w] = history.shear.y, h[2 * w] = history.shear.z;
          h[3 * w] = history.moment.x, h[4 * w] = history.moment.y, h[5 * w] = history.moment.z;
          add_load(out, a, f.force, f.couple + f.moment);
          add_load(out, b, -f.force, f.couple - f.moment);
          losses.dashpot[lane] += f.dashpot_power * s.dt;
          continue;
        }
        broken[lane] = 1;
        for (std::size_t c = 0; c < 6; ++c) h[c * w] = 0.0;
      }
      add_broken_pair<options>(s, m, h, a, b, lane, out, losses);
    }
  }
}

}  // namespace

void add_incremental_bonds(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  with_hertz_options(s.scene.contact,
                     [&](auto options) { add_incremental<decltype(options)::value>(s, block, out, losses); });
}

}  // namespace dem
