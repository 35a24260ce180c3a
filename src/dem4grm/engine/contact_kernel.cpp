// SPDX-License-Identifier: BSD-3-Clause
// Stage: ball-ball contacts, eight rows at a time.
#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/registers.hpp"
#include "dem4grm/engine/hertz_dispatch.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

constexpr std::size_t k_rows_per_block = 1024;

/// Plain pointers to everything a row reads and writes.
struct Rows {
  const double* balls;
  const int* __restrict index_i, * __restrict index_j;
  const double* __restrict radius_i, * __restrict radius_j;
  const double* __restrict hertz, * __restrict shear_ratio, * __restrict friction;
  const double* __restrict normal_dashpot, * __restrict shear_dashpot;
  double* __restrict state;  // ContactState by numbers
  double* __restrict dx, * __restrict dy, * __restrict dz;
};

Rows rows_of(Simulation& s) {
  BallStore& b = s.balls;
  ContactTable& c = s.contacts;
  return {b.state.data(),    c.index_i.data(),     c.index_j.data(),   c.radius_i.data(),       c.radius_j.data(),
          c.hertz.data(),    c.shear_ratio.data(), c.friction.data(),  c.normal_dashpot.data(), c.shear_dashpot.data(),
          c.state_numbers(), c.damping_x.data(),   c.damping_y.data(), c.damping_z.data()};
}

/// Rows ahead of the present batch whose balls are fetched into the cache meanwhile.
constexpr std::size_t k_rows_ahead = 4 * k_contact_batch;

/// Starts to load the second balls of the rows [c, c + k_contact_batch): nine neighbouring cache lines each. Rows are
/// sorted by their first balls, so those are in the cache already.
DEM_INLINE void prefetch_balls(const Rows& r, std::size_t c) {
  for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
    const double* ball = r.balls + r.index_j[c + lane];
    for (std::size_t k = 0; k < k_pebble_components; ++k) __builtin_prefetch(ball + k * k_lanes);
  }
}

/// Constants of one row.
struct RowConstants {
  double radius_i, radius_j;
  HertzParameters law;
};

/// Constants of eight rows, number by number.
struct alignas(64) BatchConstants {
  double radius_i[k_contact_batch], radius_j[k_contact_batch];
  double hertz[k_contact_batch], shear_ratio[k_contact_batch], friction[k_contact_batch];
  double normal_dashpot[k_contact_batch], shear_dashpot[k_contact_batch];
};

template <HertzOptions options>
DEM_INLINE void load_constants(const Rows& r, std::size_t c, BatchConstants& out) {
  store_eight(out.radius_i, load_eight(r.radius_i + c));
  store_eight(out.radius_j, load_eight(r.radius_j + c));
  store_eight(out.hertz, load_eight(r.hertz + c));
  store_eight(out.shear_ratio, load_eight(r.shear_ratio + c));
  store_eight(out.friction, load_eight(r.friction + c));
  if constexpr (options.dashpots) {
    store_eight(out.normal_dashpot, load_eight(r.normal_dashpot + c));
    store_eight(out.shear_dashpot, load_eight(r.shear_dashpot + c));
  }
}

/// The states of eight rows, number by number: number q of row `lane` at value[q][lane]. Numbers as in ContactState.
struct alignas(64) BatchState {
  double value[k_contact_numbers][k_contact_batch];
};

/// Position, velocity and spin of the balls of eight rows, number by number.
struct alignas(64) BatchBalls {
  double value[k_pebble_components][k_contact_batch];
};

/// Collects eight numbers from addresses a fixed distance apart from b[0] to b[7]. Eight loads put together in a
/// register are faster than a gather instruction (docs/performance.md).
DEM_INLINE Eight collect(const double* const (&b)[8], std::size_t at) {
  return Eight{b[0][at], b[1][at], b[2][at], b[3][at], b[4][at], b[5][at], b[6][at], b[7][at]};
}

DEM_INLINE void collect_balls(const double* balls, const int* index, BatchBalls& out) {
  static_assert(k_contact_batch == 8);
  const double* const b[8] = {balls + index[0], balls + index[1], balls + index[2], balls + index[3],
                              balls + index[4], balls + index[5], balls + index[6], balls + index[7]};
  for (std::size_t k = 0; k < k_pebble_components; ++k) store_eight(out.value[k], collect(b, k * k_lanes));
}

// Number by number: g++ 12 does not vectorise a loop in which a whole Vec3 is copied.
DEM_INLINE double take(const BatchBalls& balls, BallComponent component, std::size_t lane) {
  return balls.value[static_cast<std::size_t>(component)][lane];
}

/// One row, with constants of its own or those of two rubber balls; adds the dissipated works to slip and dashpot.
template <HertzOptions options, bool equal_balls>
DEM_INLINE void evaluate_row(const Rows& r, std::size_t c, const BatchBalls& i, const BatchBalls& j,
                             const BatchConstants& own, const RowConstants& of_rubber, double dt, BatchState& state,
                             std::size_t lane, double& slip, double& dashpot) {
  const HertzParameters law{equal_balls ? of_rubber.law.hertz : own.hertz[lane],
                            equal_balls ? of_rubber.law.shear_ratio : own.shear_ratio[lane],
                            equal_balls ? of_rubber.law.friction : own.friction[lane],
                            !options.dashpots ? 0.0
                            : equal_balls     ? of_rubber.law.normal_dashpot
                                              : own.normal_dashpot[lane],
                            !options.dashpots ? 0.0
                            : equal_balls     ? of_rubber.law.shear_dashpot
                                              : own.shear_dashpot[lane]};
  using C = BallComponent;
  auto& v = state.value;
  const HertzGeometry g =
      hertz_geometry({{take(j, C::x, lane) - take(i, C::x, lane), take(j, C::y, lane) - take(i, C::y, lane),
                       take(j, C::z, lane) - take(i, C::z, lane)},
                      {take(j, C::vx, lane) - take(i, C::vx, lane), take(j, C::vy, lane) - take(i, C::vy, lane),
                       take(j, C::vz, lane) - take(i, C::vz, lane)},
                      {take(i, C::wx, lane), take(i, C::wy, lane), take(i, C::wz, lane)},
                      {take(j, C::wx, lane), take(j, C::wy, lane), take(j, C::wz, lane)},
                      equal_balls ? of_rubber.radius_i : own.radius_i[lane],
                      equal_balls ? of_rubber.radius_j : own.radius_j[lane],
                      {v[k_shear_at][lane], v[k_shear_at + 1][lane], v[k_shear_at + 2][lane]}},
                     dt);
  const HertzForce f = hertz_mindlin<options>(law, g.motion, dt);
  v[k_normal_at][lane] = g.normal.x, v[k_normal_at + 1][lane] = g.normal.y, v[k_normal_at + 2][lane] = g.normal.z;
  v[k_normal_force_at][lane] = f.normal_total;
  v[k_shear_at][lane] = f.shear.x, v[k_shear_at + 1][lane] = f.shear.y, v[k_shear_at + 2][lane] = f.shear.z;
  v[k_overlap_at][lane] = g.motion.overlap;
  if constexpr (options.dashpots) {
    const Vec3 damping = f.shear_total - f.shear;
    r.dx[c] = damping.x;
    r.dy[c] = damping.y;
    r.dz[c] = damping.z;
  }
  slip += f.slip_work;
  dashpot += f.dashpot_work;
}

DEM_INLINE void load_shear(const double* rows, BatchState& state) {
  constexpr std::size_t n = k_contact_numbers;
  const double* const b[8] = {rows,         rows + n,     rows + 2 * n, rows + 3 * n,
                              rows + 4 * n, rows + 5 * n, rows + 6 * n, rows + 7 * n};
  for (std::size_t q = k_shear_at; q < k_shear_at + 3; ++q) store_eight(state.value[q], collect(b, q));
}

DEM_INLINE void store(const BatchState& state, double* rows) {
  Eight r[8];
  for (std::size_t q = 0; q < 8; ++q) r[q] = load_eight(state.value[q]);
  transpose(r);
  for (std::size_t lane = 0; lane < 8; ++lane) store_eight(rows + lane * k_contact_numbers, r[lane]);
}

/// Eight rows; with `equal_balls` all are pairs of rubber balls and share their constants.
template <HertzOptions options, bool equal_balls>
DEM_INLINE void evaluate_batch(const Rows& r, std::size_t c, const RowConstants& of_rubber, double dt, double* slip,
                               double* dashpot) {
  BatchBalls i, j;
  collect_balls(r.balls, r.index_i + c, i);
  collect_balls(r.balls, r.index_j + c, j);
  BatchState state;
  double* rows = r.state + c * k_contact_numbers;
  load_shear(rows, state);
  BatchConstants own;
  if constexpr (!equal_balls) load_constants<options>(r, c, own);
#pragma omp simd
  for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
    evaluate_row<options, equal_balls>(r, c + lane, i, j, own, of_rubber, dt, state, lane, slip[lane], dashpot[lane]);
  }
  store(state, rows);
}

template <HertzOptions options>
void evaluate(Simulation& s) {
  const Rows rows = rows_of(s);
  const double ball_radius = s.scene.rubber_ball_radius;
  const RowConstants rubber{ball_radius, ball_radius, s.contacts.between_rubber_balls};
  const std::size_t rubber_rows = s.contacts.n_equal_rows();
  const double dt = s.last_dt;
  const std::size_t n = s.contacts.n_pair_rows();
  std::vector<double>& slip_of_block = s.scratch_slip;
  std::vector<double>& dashpot_of_block = s.scratch_dashpot;
  slip_of_block.assign(block_count(n, k_rows_per_block), 0.0);
  dashpot_of_block.assign(slip_of_block.size(), 0.0);
  for_each_block(n, k_rows_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    const Rows r = rows;
    const RowConstants of_rubber = rubber;
    alignas(64) double slip[k_contact_batch] = {}, dashpot[k_contact_batch] = {};
    for (std::size_t c = begin; c < end; c += k_contact_batch) {
      if (c + k_rows_ahead < end) prefetch_balls(r, c + k_rows_ahead);
      if (c < rubber_rows) {
        evaluate_batch<options, true>(r, c, of_rubber, dt, slip, dashpot);
      } else {
        evaluate_batch<options, false>(r, c, of_rubber, dt, slip, dashpot);
      }
    }
    for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
      slip_of_block[block] += slip[lane];
      dashpot_of_block[block] += dashpot[lane];
    }
  });
  for (std::size_t b = 0; b < slip_of_block.size(); ++b) {
    s.ledger.contact_slip += slip_of_block[b];
    s.ledger.contact_dashpot += dashpot_of_block[b];
  }
}

}  // namespace

void evaluate_ball_contacts(Simulation& s) {
  with_hertz_options(s.scene.contact, [&](auto options) { evaluate<decltype(options)::value>(s); });
}

}  // namespace dem
