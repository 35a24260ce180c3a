// SPDX-License-Identifier: BSD-3-Clause
// Hertz-Mindlin contact of the 66 second-neighbour pairs within each rubber grain. Of the pairs of a block few touch at
// a time: their distances are tested for all lanes, then those that touch are brought together into full registers.
#include <cstdint>

#include "dem4grm/core/lane_vectors.hpp"
#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/rubber_parts.hpp"

namespace dem::DEM_TARGET {

namespace {

/// Pairs that have a force or a history, in the order of their numbers and, within one, of the lanes.
struct ClosedPairs {
  std::uint8_t pair[k_grain_second_neighbours * k_lanes];
  std::uint8_t lane[k_grain_second_neighbours * k_lanes];
  std::size_t count = 0;
};

/// Squared distance of a pair in every lane.
DEM_INLINE void squared_distances(const GrainBlock& g, std::size_t i, std::size_t j, double* d2) {
#pragma omp simd
  for (std::size_t lane = 0; lane < k_lanes; ++lane) {
    const Vec3 d = load3(g.x, g.y, g.z, j + lane) - load3(g.x, g.y, g.z, i + lane);
    d2[lane] = dot(d, d);
  }
}

DEM_INLINE bool any_below(const double* values, double limit) {
  std::int64_t any = 0;
#pragma omp simd reduction(| : any)
  for (std::size_t lane = 0; lane < k_lanes; ++lane) any |= values[lane] < limit ? 1 : 0;
  return any != 0;
}

/// Bit l is set when value l is below the limit.
unsigned lanes_below(const double* values, double limit) {
  unsigned bits = 0;
  for (std::size_t lane = 0; lane < k_lanes; ++lane) bits |= (values[lane] < limit ? 1U : 0U) << lane;
  return bits;
}

/// A pair that has just opened is listed once more, and the law then clears its history.
void find_closed_pairs(const GrainBlock& g, double reach2, unsigned char* touches, ClosedPairs& out) {
  for (std::size_t q = 0; q < k_grain_second_neighbours; ++q) {
    const SlotPair pair = k_second_neighbours_of_grain[q];
    alignas(64) double d2[k_lanes];
    squared_distances(g, ball_at(pair.i, 0), ball_at(pair.j, 0), d2);
    if (touches[q] == 0 && !any_below(d2, reach2)) continue;
    const unsigned now = lanes_below(d2, reach2);
    for (unsigned left = now | touches[q]; left != 0; left &= left - 1) {
      out.pair[out.count] = static_cast<std::uint8_t>(q);
      out.lane[out.count++] = static_cast<std::uint8_t>(__builtin_ctz(left));
    }
    touches[q] = static_cast<unsigned char>(now);
  }
}

/// What the law needs of up to k_contact_batch pairs, and what it gives: one component of all of them side by side.
struct alignas(64) PairBatch {
  using Vectors = LaneVectors<k_contact_batch>;
  Vectors branch, velocity, spin_i, spin_j, shear, force, torque_i, torque_j;
  double slip_work[k_contact_batch], dashpot_work[k_contact_batch];
};

/// Fetches pair k of a batch; h is its history of shear.
DEM_INLINE void fetch_pair(const GrainBlock& g, std::size_t a, std::size_t b, const double* h, std::size_t k,
                           PairBatch& out) {
  put(out.branch, k, load3(g.x, g.y, g.z, b) - load3(g.x, g.y, g.z, a));
  put(out.velocity, k, load3(g.vx, g.vy, g.vz, b) - load3(g.vx, g.vy, g.vz, a));
  put(out.spin_i, k, load3(g.wx, g.wy, g.wz, a));
  put(out.spin_j, k, load3(g.wx, g.wy, g.wz, b));
  put(out.shear, k, {h[0], h[k_lanes], h[2 * k_lanes]});
}

template <HertzOptions options>
DEM_INLINE void evaluate_batch(const HertzParameters& p, double radius, double dt, PairBatch& b) {
#pragma omp simd
  for (std::size_t k = 0; k < k_contact_batch; ++k) {
    const HertzGeometry geometry = hertz_geometry({taken(b.branch, k), taken(b.velocity, k), taken(b.spin_i, k),
                                                   taken(b.spin_j, k), radius, radius, taken(b.shear, k)},
                                                  dt);
    const HertzForce f = hertz_mindlin<options>(p, geometry.motion, dt);
    const Vec3 couple = cross(geometry.normal, f.shear_total);
    put(b.shear, k, f.shear);
    put(b.force, k, f.shear_total - geometry.normal * f.normal_total);
    put(b.torque_i, k, couple * geometry.lever_i);
    put(b.torque_j, k, couple * geometry.lever_j);
    b.slip_work[k] = f.slip_work;
    b.dashpot_work[k] = f.dashpot_work;
  }
}

template <HertzOptions options>
void add_closed_pairs(Simulation& s, std::size_t block, const GrainBlock& g, BlockForces& out, BlockLosses& losses) {
  constexpr std::size_t n = k_contact_batch;
  const RubberSize& size = s.rubber_of_block(block);
  const double r = size.ball_radius, dt = s.last_dt;
  const HertzParameters p = size.second_neighbour;
  double* histories = s.grain_history.second_neighbour_shear.data() + block * k_grain_second_neighbours * 3 * k_lanes;
  ClosedPairs closed;
  find_closed_pairs(g, 4.0 * r * r, s.grain_history.second_neighbour_touches.data() + block * k_grain_second_neighbours,
                    closed);
  PairBatch batch{};
  for (std::size_t first = 0; first < closed.count; first += n) {
    const std::size_t filled = closed.count - first < n ? closed.count - first : n;
    for (std::size_t k = 0; k < filled; ++k) {
      const std::size_t q = closed.pair[first + k], lane = closed.lane[first + k];
      const SlotPair pair = k_second_neighbours_of_grain[q];
      fetch_pair(g, ball_at(pair.i, lane), ball_at(pair.j, lane), histories + q * 3 * k_lanes + lane, k, batch);
    }
    // Places behind the last pair still hold those of an earlier batch, or zeros; what comes out for them is not read.
    evaluate_batch<options>(p, r, dt, batch);
    for (std::size_t k = 0; k < filled; ++k) {
      const std::size_t q = closed.pair[first + k], lane = closed.lane[first + k];
      const SlotPair pair = k_second_neighbours_of_grain[q];
      double* h = histories + q * 3 * k_lanes + lane;
      const Vec3 shear = taken(batch.shear, k), force = taken(batch.force, k);
      h[0] = shear.x, h[k_lanes] = shear.y, h[2 * k_lanes] = shear.z;
      add_load(out, load_at(pair.i, lane), force, taken(batch.torque_i, k));
      add_load(out, load_at(pair.j, lane), -force, taken(batch.torque_j, k));
      losses.slip[lane] += batch.slip_work[k];
      if constexpr (options.dashpots) losses.dashpot[lane] += batch.dashpot_work[k];
    }
  }
}

}  // namespace

void add_second_neighbours(Simulation& s, std::size_t block, const GrainBlock& g, BlockForces& out,
                           BlockLosses& losses) {
  with_hertz_options(s.scene.contact,
                     [&](auto options) { add_closed_pairs<decltype(options)::value>(s, block, g, out, losses); });
}

}  // namespace dem::DEM_TARGET
