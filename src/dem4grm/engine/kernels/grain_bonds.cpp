// SPDX-License-Identifier: BSD-3-Clause
// The 64 bonds of k_lanes grains at once, in both forms.
#include <utility>

#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/rubber_parts.hpp"

namespace dem::DEM_TARGET {

namespace {

constexpr double k_inverse_root3 = 0.57735026918962576451;

/// The four cube diagonals of a ball's own frame, towards octants 4 (--+), 5 (+-+), 6 (-++), 7 (+++), for all lanes.
struct alignas(64) Diagonals {
  double x[4][k_lanes], y[4][k_lanes], z[4][k_lanes];
};

DEM_INLINE Quaternion load_orientation(const GrainBlock& g, std::size_t k) {
  return {g.qw[k], g.qx[k], g.qy[k], g.qz[k]};
}

/// The four diagonals of one ball.
struct BallDiagonals {
  Vec3 d4, d5, d6, d7;
};

DEM_INLINE BallDiagonals diagonals_of(const Quaternion& q) {
  const Frame f = frame_of(q);
  const Vec3 a = f.e1 * k_inverse_root3, b = f.e2 * k_inverse_root3, c = f.e3 * k_inverse_root3;
  const Vec3 plus = a + b, minus = a - b;
  return {c - plus, c + minus, c - minus, c + plus};
}

DEM_INLINE void fill_diagonals(const GrainBlock& g, std::size_t slot, Diagonals& d) {
#pragma omp simd
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const BallDiagonals b = diagonals_of(load_orientation(g, ball_at(slot, lane)));
    d.x[0][lane] = b.d4.x, d.y[0][lane] = b.d4.y, d.z[0][lane] = b.d4.z;
    d.x[1][lane] = b.d5.x, d.y[1][lane] = b.d5.y, d.z[1][lane] = b.d5.z;
    d.x[2][lane] = b.d6.x, d.y[2][lane] = b.d6.y, d.z[2][lane] = b.d6.z;
    d.x[3][lane] = b.d7.x, d.y[3][lane] = b.d7.y, d.z[3][lane] = b.d7.z;
  }
}

/// A cell centre of one lane and the sums of what its bonds do to it, in registers while its eight bonds are evaluated.
struct Centre {
  Vec3 position, velocity;
  Quaternion orientation;
  BallDiagonals diagonals;
  Vec3 force, torque;
  double dashpot_power = 0.0;
};

/// The bond of a cell centre with its corner at octant o, for one lane. Opposite octants share a diagonal.
template <std::size_t centre, std::size_t o>
DEM_INLINE void add_bond(const BondParameters& p, const GrainBlock& g, const Diagonals* corners, std::size_t lane,
                         Centre& c, BlockForces& out) {
  constexpr std::size_t corner = k_bonds_of_grain[8 * centre + o].j;
  constexpr std::size_t diagonal = o >= 4 ? o - 4 : 3 - o;
  constexpr double sign = o >= 4 ? 1.0 : -1.0;
  const std::size_t b = ball_at(corner, lane);
  const Diagonals& d = corners[corner];
  const Vec3& own = diagonal == 0   ? c.diagonals.d4
                    : diagonal == 1 ? c.diagonals.d5
                    : diagonal == 2 ? c.diagonals.d6
                                    : c.diagonals.d7;
  const Vec3 directions = (own + load3(d.x[diagonal], d.y[diagonal], d.z[diagonal], lane)) * sign;
  const BondForce f =
      history_free_bond(p, load3(g.x, g.y, g.z, b) - c.position, load3(g.vx, g.vy, g.vz, b) - c.velocity, directions,
                        c.orientation, load_orientation(g, b));
  c.force += f.force;
  c.torque += f.couple + f.moment;
  c.dashpot_power += f.dashpot_power;
  add_load(out, load_at(corner, lane), -f.force, f.couple - f.moment);
}

template <std::size_t centre, std::size_t... octants>
DEM_INLINE void add_bonds_of_lane(const BondParameters& p, const GrainBlock& g, const Diagonals* corners,
                                  std::size_t lane, double dt, BlockForces& out, BlockLosses& losses,
                                  std::index_sequence<octants...> /*eight*/) {
  constexpr std::size_t slot = k_grain_corners + centre;
  const std::size_t a = ball_at(slot, lane);
  Centre c;
  c.position = load3(g.x, g.y, g.z, a);
  c.velocity = load3(g.vx, g.vy, g.vz, a);
  c.orientation = load_orientation(g, a);
  c.diagonals = diagonals_of(c.orientation);
  (add_bond<centre, octants>(p, g, corners, lane, c, out), ...);
  add_load(out, load_at(slot, lane), c.force, c.torque);
  losses.dashpot[lane] += c.dashpot_power * dt;
}

/// Starts to load one eighth of the state of the next block, so that it is in the cache when its turn comes.
template <std::size_t share>
DEM_INLINE void prefetch_next_block(const GrainBlock& g) {
  constexpr std::size_t line = 64 / sizeof(double), lines = k_block_length / line;
  const double* next = g.x + k_block_length;
  for (std::size_t k = share * lines / k_grain_centres; k < (share + 1) * lines / k_grain_centres; ++k) {
    __builtin_prefetch(next + k * line, 1);
  }
}

template <std::size_t centre>
DEM_INLINE void add_bonds_of_centre(const BondParameters& p, const GrainBlock& g, const Diagonals* corners, double dt,
                                    BlockForces& out, BlockLosses& losses) {
  prefetch_next_block<centre>(g);
#pragma omp simd
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    add_bonds_of_lane<centre>(p, g, corners, lane, dt, out, losses, std::make_index_sequence<8>{});
  }
}

}  // namespace

void add_history_free_bonds(const BondParameters& parameters, const GrainBlock& g, double dt, BlockForces& out,
                            BlockLosses& losses) {
  const BondParameters p = parameters;
  Diagonals corners[k_grain_corners];
  for (std::size_t slot = 0; slot < k_grain_corners; ++slot) fill_diagonals(g, slot, corners[slot]);
  const auto all_centres = [&]<std::size_t... centres>(std::index_sequence<centres...> /*eight*/) {
    (add_bonds_of_centre<centres>(p, g, corners, dt, out, losses), ...);
  };
  all_centres(std::make_index_sequence<k_grain_centres>{});
}

namespace {

/// Motion of the pair of balls at a and b (ball_at).
BondMotion motion_of(const GrainBlock& g, std::size_t a, std::size_t b) {
  return {load3(g.x, g.y, g.z, b) - load3(g.x, g.y, g.z, a), load3(g.vx, g.vy, g.vz, b) - load3(g.vx, g.vy, g.vz, a),
          load3(g.wx, g.wy, g.wz, a), load3(g.wx, g.wy, g.wz, b)};
}

/// A pair whose bond is gone: an ordinary Hertz contact with its shear history in the first three places.
template <HertzOptions options>
void add_broken_pair(const Simulation& s, const RubberSize& size, const BondMotion& m, double* history,
                     const SlotPair& pair, std::size_t lane, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t w = k_lanes;
  const double r = size.ball_radius;
  const HertzGeometry geometry = hertz_geometry(
      {m.branch, m.relative_velocity, m.spin_i, m.spin_j, r, r, {history[0], history[w], history[2 * w]}}, s.last_dt);
  const HertzForce f = hertz_mindlin<options>(size.second_neighbour, geometry.motion, s.last_dt);
  history[0] = f.shear.x;
  history[w] = f.shear.y;
  history[2 * w] = f.shear.z;
  const Vec3 force = f.shear_total - geometry.normal * f.normal_total;
  const Vec3 couple = cross(geometry.normal, f.shear_total);
  add_load(out, load_at(pair.i, lane), force, couple * geometry.lever_i);
  add_load(out, load_at(pair.j, lane), -force, couple * geometry.lever_j);
  losses.slip[lane] += f.slip_work;
  losses.dashpot[lane] += f.dashpot_work;
}

/// Energy that leaves with a bond, J (EnergyReport::breakage). The contact that takes its place begins without shear.
DEM_INLINE double energy_of_breaking(const Simulation& s, const RubberSize& size, std::size_t bond_row,
                                     const Vec3& branch, const BondHistory& history) {
  constexpr std::size_t w = k_lanes;
  const double length = std::sqrt(dot(branch, branch)), overlap = 2.0 * size.ball_radius - length;
  const double taken_over = hertz_mindlin_energy(size.second_neighbour, overlap, {});
  double held = bond_energy(size.bond, length, history.shear, history.moment, branch * (1.0 / length));
  if (!s.grain_history.companion_shear.empty()) {
    const double* h = s.grain_history.companion_shear.data() + bond_row;
    const Vec3 shear{h[0], h[w], h[2 * w]};
    if (s.scene.bond.hertz_contact) {
      held += hertz_mindlin_energy(size.second_neighbour, overlap, shear);
    } else if (size.bond.linear_shear_stiffness > 0.0) {
      held += 0.5 * dot(shear, shear) / size.bond.linear_shear_stiffness;
    }
  }
  return held - taken_over;
}

template <HertzOptions options>
void add_incremental(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t w = k_lanes;
  const GrainBlock g = grain_block(s.balls, block);
  const RubberSize& size = s.rubber_of_block(block);
  for (std::size_t k = 0; k < k_grain_bonds; ++k) {
    const SlotPair pair = k_bonds_of_grain[k];
    double* stored = s.grain_history.bond.data() + (block * k_grain_bonds + k) * 6 * w;
    unsigned char* broken = s.grain_history.bond_is_broken.data() + (block * k_grain_bonds + k) * w;
    for (std::size_t lane = 0; lane < w; ++lane) {
      const BondMotion m = motion_of(g, ball_at(pair.i, lane), ball_at(pair.j, lane));
      double* h = stored + lane;
      if (broken[lane] == 0) {
        BondHistory history{{h[0], h[w], h[2 * w]}, {h[3 * w], h[4 * w], h[5 * w]}};
        bool breaks = false;
        const BondForce f = incremental_bond(size.bond, m, s.last_dt, history, breaks);
        if (!breaks) {
          h[0] = history.shear.x, h[w] = history.shear.y, h[2 * w] = history.shear.z;
          h[3 * w] = history.moment.x, h[4 * w] = history.moment.y, h[5 * w] = history.moment.z;
          add_load(out, load_at(pair.i, lane), f.force, f.couple + f.moment);
          add_load(out, load_at(pair.j, lane), -f.force, f.couple - f.moment);
          losses.dashpot[lane] += f.dashpot_power * s.last_dt;
          continue;
        }
        broken[lane] = 1;
        s.ledger.grain_breakage[block * w + lane] +=
            energy_of_breaking(s, size, (block * k_grain_bonds + k) * 3 * w + lane, m.branch, history);
        for (std::size_t c = 0; c < 6; ++c) h[c * w] = 0.0;
      }
      add_broken_pair<options>(s, size, m, h, pair, lane, out, losses);
    }
  }
}

}  // namespace

void add_incremental_bonds(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses) {
  with_hertz_options(s.scene.contact,
                     [&](auto options) { add_incremental<decltype(options)::value>(s, block, out, losses); });
}

}  // namespace dem::DEM_TARGET
