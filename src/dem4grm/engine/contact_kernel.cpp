// SPDX-License-Identifier: BSD-3-Clause
// Stage: ball-ball contacts, eight rows at a time.
#include "dem4grm/core/blocks.hpp"
#include "dem4grm/engine/hertz_dispatch.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

constexpr std::size_t k_rows_per_block = 1024;

/// Plain pointers to everything a row reads and writes.
struct Rows {
  const double* __restrict x, * __restrict y, * __restrict z;
  const double* __restrict vx, * __restrict vy, * __restrict vz;
  const double* __restrict wx, * __restrict wy, * __restrict wz;
  const std::int64_t* __restrict index_i, * __restrict index_j;
  const double* __restrict radius_i, * __restrict radius_j;
  const double* __restrict hertz, * __restrict shear_ratio, * __restrict friction;
  const double* __restrict normal_dashpot, * __restrict shear_dashpot;
  double* __restrict sx, * __restrict sy, * __restrict sz;
  double* __restrict fx, * __restrict fy, * __restrict fz;
  double* __restrict cx, * __restrict cy, * __restrict cz;
  double* __restrict lever_i, * __restrict lever_j;
};

Rows rows_of(Simulation& s) {
  BallStore& b = s.balls;
  ContactTable& c = s.contacts;
  return {b.x.data(),
          b.y.data(),
          b.z.data(),
          b.vx.data(),
          b.vy.data(),
          b.vz.data(),
          b.wx.data(),
          b.wy.data(),
          b.wz.data(),
          c.index_i.data(),
          c.index_j.data(),
          c.radius_i.data(),
          c.radius_j.data(),
          c.hertz.data(),
          c.shear_ratio.data(),
          c.friction.data(),
          c.normal_dashpot.data(),
          c.shear_dashpot.data(),
          c.shear_x.data(),
          c.shear_y.data(),
          c.shear_z.data(),
          c.force_x.data(),
          c.force_y.data(),
          c.force_z.data(),
          c.couple_x.data(),
          c.couple_y.data(),
          c.couple_z.data(),
          c.lever_i.data(),
          c.lever_j.data()};
}

/// One row; returns the dissipated works through slip and dashpot.
template <HertzOptions options>
DEM_INLINE void evaluate_row(const Rows& r, std::size_t c, double dt, double& slip, double& dashpot) {
  const std::int64_t i = r.index_i[c], j = r.index_j[c];
  const HertzGeometry g = hertz_geometry({{r.x[j] - r.x[i], r.y[j] - r.y[i], r.z[j] - r.z[i]},
                                          {r.vx[j] - r.vx[i], r.vy[j] - r.vy[i], r.vz[j] - r.vz[i]},
                                          {r.wx[i], r.wy[i], r.wz[i]},
                                          {r.wx[j], r.wy[j], r.wz[j]},
                                          r.radius_i[c],
                                          r.radius_j[c],
                                          {r.sx[c], r.sy[c], r.sz[c]}},
                                         dt);
  const Vec3 n = g.normal;
  const HertzParameters p{r.hertz[c], r.shear_ratio[c], r.friction[c], options.dashpots ? r.normal_dashpot[c] : 0.0,
                          options.dashpots ? r.shear_dashpot[c] : 0.0};
  const HertzForce f = hertz_mindlin<options>(p, g.motion, dt);
  const Vec3 couple = cross(n, f.shear_total);
  r.sx[c] = f.shear.x;
  r.sy[c] = f.shear.y;
  r.sz[c] = f.shear.z;
  r.fx[c] = f.shear_total.x - n.x * f.normal_total;
  r.fy[c] = f.shear_total.y - n.y * f.normal_total;
  r.fz[c] = f.shear_total.z - n.z * f.normal_total;
  r.cx[c] = couple.x;
  r.cy[c] = couple.y;
  r.cz[c] = couple.z;
  r.lever_i[c] = g.lever_i;
  r.lever_j[c] = g.lever_j;
  slip += f.slip_work;
  dashpot += f.dashpot_work;
}

template <HertzOptions options>
void evaluate(Simulation& s) {
  const Rows rows = rows_of(s);
  const double dt = s.dt;
  const std::size_t n = s.contacts.n_pair_rows();
  std::vector<double>& slip_of_block = s.scratch_slip;
  std::vector<double>& dashpot_of_block = s.scratch_dashpot;
  slip_of_block.assign(block_count(n, k_rows_per_block), 0.0);
  dashpot_of_block.assign(slip_of_block.size(), 0.0);
  for_each_block(n, k_rows_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
    const Rows r = rows;
    alignas(64) double slip[k_contact_batch] = {}, dashpot[k_contact_batch] = {};
    for (std::size_t c = begin; c < end; c += k_contact_batch) {
#pragma omp simd
      for (std::size_t lane = 0; lane < k_contact_batch; ++lane) {
        evaluate_row<options>(r, c + lane, dt, slip[lane], dashpot[lane]);
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
