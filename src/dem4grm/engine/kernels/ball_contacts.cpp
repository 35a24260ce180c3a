// SPDX-License-Identifier: BSD-3-Clause
// Stage: ball-ball contacts, eight rows at a time.
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/registers.hpp"
#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"
#include "dem4grm/engine/kernels/rubber_parts.hpp"

namespace dem::DEM_TARGET {

namespace {

constexpr std::size_t k_rows_per_block = 1024;
/// Parts of the rubber: more let a thread that is done help a slow one, and leave fewer contacts for the moment when
/// their grains are in the cache.
constexpr int k_parts_per_thread = 8;
constexpr int k_short_part = 12;  // blocks

/// Plain pointers to everything a row reads and writes.
struct Rows {
  const double* balls;
  int first_pebble;  // index in the ball store: from there on numbers lie side by side
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
  return {b.state.data(),     b.first_pebble_index(),  c.index_i.data(),       c.index_j.data(),
          c.radius_i.data(),  c.radius_j.data(),       c.hertz.data(),         c.shear_ratio.data(),
          c.friction.data(),  c.normal_dashpot.data(), c.shear_dashpot.data(), c.state_numbers(),
          c.damping_x.data(), c.damping_y.data(),      c.damping_z.data()};
}

/// Rows ahead of the present batch whose balls are fetched into the cache meanwhile.
constexpr int k_batches_ahead = 2;
constexpr std::size_t k_rows_ahead = k_batches_ahead * k_contact_batch;

/// Starts to load the second balls of the rows [c, c + k_contact_batch). Rows are sorted by their first balls, so those
/// are in the cache already.
DEM_INLINE void prefetch_balls(const Rows& r, std::size_t c) {
  for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
    const int index = r.index_j[c + lane];
    const double* ball = r.balls + index;
    if (index < r.first_pebble) {
      for (std::size_t k = 0; k < k_pebble_components; ++k) __builtin_prefetch(ball + k * k_lanes);
    } else {
      __builtin_prefetch(ball);
      __builtin_prefetch(ball + k_pebble_components - 1);
    }
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
  copy_eight(out.radius_i, r.radius_i + c);
  copy_eight(out.radius_j, r.radius_j + c);
  copy_eight(out.hertz, r.hertz + c);
  copy_eight(out.shear_ratio, r.shear_ratio + c);
  copy_eight(out.friction, r.friction + c);
  if constexpr (options.dashpots) {
    copy_eight(out.normal_dashpot, r.normal_dashpot + c);
    copy_eight(out.shear_dashpot, r.shear_dashpot + c);
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

/// Balls of rubber: a number of eight balls is collected from eight places.
DEM_INLINE void collect_from_lanes(const double* balls, const int* index, BatchBalls& out) {
  DEM_UNROLL
  for (std::size_t first = 0; first < k_contact_batch; first += k_register) {
    const double* ball[k_register];
    DEM_UNROLL
    for (std::size_t k = 0; k < k_register; ++k) ball[k] = balls + index[first + k];
    DEM_UNROLL
    for (std::size_t c = 0; c < k_pebble_components; ++c) collect(ball, c * k_lanes, out.value[c] + first);
  }
}

/// Pebbles: the first eight numbers of eight records are transposed, the ninth is collected.
DEM_INLINE void collect_from_records(const double* balls, const int* index, BatchBalls& out) {
  static_assert(k_contact_batch == 8 && k_pebble_components == 9);
  const double* const record[8] = {balls + index[0], balls + index[1], balls + index[2], balls + index[3],
                                   balls + index[4], balls + index[5], balls + index[6], balls + index[7]};
  const EightRows<double> numbers(out.value[0], k_contact_batch);
  transpose_eight(record, numbers.at);
  DEM_UNROLL
  for (std::size_t k = 0; k < k_contact_batch; ++k) out.value[8][k] = record[k][8];
}

/// Both kinds in one batch, as there are few.
void collect_from_both(const Rows& r, const int* index, BatchBalls& out) {
  for (std::size_t k = 0; k < k_contact_batch; ++k) {
    const double* ball = r.balls + index[k];
    const std::size_t stride = index[k] < r.first_pebble ? k_lanes : 1;
    for (std::size_t c = 0; c < k_pebble_components; ++c) out.value[c][k] = ball[c * stride];
  }
}

DEM_INLINE void collect_balls(const Rows& r, const int* index, BatchBalls& out) {
  std::size_t pebbles = 0;
  for (std::size_t k = 0; k < k_contact_batch; ++k) pebbles += index[k] < r.first_pebble ? 0 : 1;
  if (pebbles == 0) {
    collect_from_lanes(r.balls, index, out);
  } else if (pebbles == k_contact_batch) {
    collect_from_records(r.balls, index, out);
  } else {
    collect_from_both(r, index, out);
  }
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
  const HertzPair pair{{take(j, C::x, lane) - take(i, C::x, lane), take(j, C::y, lane) - take(i, C::y, lane),
                        take(j, C::z, lane) - take(i, C::z, lane)},
                       {take(j, C::vx, lane) - take(i, C::vx, lane), take(j, C::vy, lane) - take(i, C::vy, lane),
                        take(j, C::vz, lane) - take(i, C::vz, lane)},
                       {take(i, C::wx, lane), take(i, C::wy, lane), take(i, C::wz, lane)},
                       {take(j, C::wx, lane), take(j, C::wy, lane), take(j, C::wz, lane)},
                       equal_balls ? of_rubber.radius_i : own.radius_i[lane],
                       equal_balls ? of_rubber.radius_j : own.radius_j[lane],
                       {v[k_shear_at][lane], v[k_shear_at + 1][lane], v[k_shear_at + 2][lane]}};
  // The row still holds the normal of the last step; it is zero in a new row, which has no shear force to carry.
  const HertzBefore before{
      {v[k_normal_at][lane], v[k_normal_at + 1][lane], v[k_normal_at + 2][lane]}, 1.0, v[k_overlap_at][lane]};
  const HertzGeometry g = hertz_geometry(pair, before, dt);
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

DEM_INLINE void load_rows(const double* rows, BatchState& state) {
  static_assert(k_contact_numbers == 8);
  const EightRows<const double> from(rows, k_contact_numbers);
  const EightRows<double> numbers(state.value[0], k_contact_batch);
  transpose_eight(from.at, numbers.at);
}

DEM_INLINE void store_rows(const BatchState& state, double* rows) {
  static_assert(k_contact_numbers == 8);
  const EightRows<const double> numbers(state.value[0], k_contact_batch);
  const EightRows<double> to(rows, k_contact_numbers);
  transpose_eight(numbers.at, to.at);
}

/// Eight rows; with `equal_balls` all are pairs of rubber balls and share their constants.
template <HertzOptions options, bool equal_balls>
DEM_INLINE void evaluate_batch(const Rows& r, std::size_t c, const RowConstants& of_rubber, double dt, double* slip,
                               double* dashpot) {
  BatchBalls i, j;
  if constexpr (equal_balls) {
    collect_from_lanes(r.balls, r.index_i + c, i);
    collect_from_lanes(r.balls, r.index_j + c, j);
  } else {
    collect_balls(r, r.index_i + c, i);
    collect_balls(r, r.index_j + c, j);
  }
  BatchState state;
  double* rows = r.state + c * k_contact_numbers;
  load_rows(rows, state);
  BatchConstants own;
  if constexpr (!equal_balls) load_constants<options>(r, c, own);
#pragma omp simd
  for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
    evaluate_row<options, equal_balls>(r, c + lane, i, j, own, of_rubber, dt, state, lane, slip[lane], dashpot[lane]);
  }
  store_rows(state, rows);
}

/// The sum of eight lanes, by halves.
DEM_INLINE double sum_of(const double* v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

// ---- rows with a pebble, and the last rows of two rubber balls, which do not fill a batch

template <HertzOptions options>
void evaluate_other_rows(Simulation& s) {
  const Rows rows = rows_of(s);
  const double dt = s.last_dt;
  const std::size_t first = static_cast<std::size_t>(s.rubber_batches.n_batches()) * k_contact_batch;
  const std::size_t n = s.contacts.n_pair_rows() - first;
  const std::size_t blocks = block_count(n, k_rows_per_block);
  prepare_partial_works(s, blocks);
  double* const slip_of_block = s.scratch_slip.data();
  double* const dashpot_of_block = s.scratch_dashpot.data();
  for_each_block(n, k_rows_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    const Rows r = rows;
    alignas(64) double slip[k_contact_batch] = {}, dashpot[k_contact_batch] = {};
    for (std::size_t c = first + begin; c < first + end; c += k_contact_batch) {
      if (c + k_rows_ahead < first + end) prefetch_balls(r, c + k_rows_ahead);
      evaluate_batch<options, false>(r, c, RowConstants{}, dt, slip, dashpot);
    }
    slip_of_block[block] = sum_of(slip);
    dashpot_of_block[block] = sum_of(dashpot);
  });
  for (std::size_t b = 0; b < blocks; ++b) {
    s.ledger.contact_slip += slip_of_block[b];
    s.ledger.contact_dashpot += dashpot_of_block[b];
  }
}

// ---- batches of two rubber balls

enum class Share : unsigned char { all, early, waiting };

/// Those batches of a block that belong to the share.
template <HertzOptions options, bool equal_balls>
void evaluate_rubber_rows(Simulation& s, std::size_t block, Share share) {
  const Rows r = rows_of(s);
  const double ball_radius = s.scene.rubber_ball_radius, dt = s.last_dt;
  const RowConstants of_rubber{ball_radius, ball_radius, s.contacts.between_rubber_balls};
  RubberBatches& batches = s.rubber_batches;
  const int* const last_block = batches.last_block.data();
  double* const slip_of_batch = batches.slip.data();
  double* const dashpot_of_batch = batches.dashpot.data();
  const int end = batches.first[block + 1], of_all = batches.n_batches();
  const int part_end = share == Share::all ? 0 : batches.end_of_part(static_cast<int>(block));
  for (int batch = batches.first[block]; batch < end; ++batch) {
    if (share != Share::all && (last_block[batch] >= part_end) != (share == Share::early)) continue;
    const std::size_t c = static_cast<std::size_t>(batch) * k_contact_batch;
    if (batch + k_batches_ahead < of_all) prefetch_balls(r, c + k_rows_ahead);
    alignas(64) double slip[k_contact_batch] = {}, dashpot[k_contact_batch] = {};
    evaluate_batch<options, equal_balls>(r, c, of_rubber, dt, slip, dashpot);
    slip_of_batch[batch] = sum_of(slip);
    if constexpr (options.dashpots) dashpot_of_batch[batch] = sum_of(dashpot);
  }
}

void evaluate_rubber_block(Simulation& s, std::size_t block, Share share) {
  with_hertz_options(s.scene.contact, [&](auto options) {
    if (s.contacts.has_equal_rubber) {
      evaluate_rubber_rows<decltype(options)::value, true>(s, block, share);
    } else {
      evaluate_rubber_rows<decltype(options)::value, false>(s, block, share);
    }
  });
}

void evaluate_rubber(Simulation& s, Share share) {
  if (s.rubber_batches.n_batches() == 0) return;
  for_each_block(static_cast<std::size_t>(s.balls.n_blocks), 1,
                 [&](std::size_t block, std::size_t, std::size_t) { evaluate_rubber_block(s, block, share); });
}

/// Blocks of one part. Short parts are lengthened, but not so far that a thread would have none.
int part_length(int blocks, int threads) {
  const auto share = [blocks](int parts) { return (blocks + parts - 1) / parts; };
  if (threads == 1) return blocks;
  return std::max(share(threads * k_parts_per_thread), std::min(k_short_part, share(threads)));
}

void evaluate_others(Simulation& s) {
  with_hertz_options(s.scene.contact, [&](auto options) { evaluate_other_rows<decltype(options)::value>(s); });
}

}  // namespace

void evaluate_ball_contacts(Simulation& s) {
  s.rubber_batches.part_length = 0;
  evaluate_others(s);
  evaluate_rubber(s, Share::all);
  add_works_of_rubber(s);
}

void evaluate_early_contacts(Simulation& s) {
  evaluate_others(s);
  if (s.rubber_batches.n_batches() == 0) return;
  const int threads = omp_get_max_threads();
  s.rubber_batches.part_length = part_length(s.balls.n_blocks, threads);
  if (threads > 1) evaluate_rubber(s, Share::early);
}

void evaluate_waiting_contacts(Simulation& s, std::size_t block) { evaluate_rubber_block(s, block, Share::waiting); }

void add_works_of_rubber(Simulation& s) {
  const RubberBatches& b = s.rubber_batches;
  for (const double work : b.slip) s.ledger.contact_slip += work;
  if (!s.contacts.has_dashpots()) return;
  for (const double work : b.dashpot) s.ledger.contact_dashpot += work;
}

}  // namespace dem::DEM_TARGET
