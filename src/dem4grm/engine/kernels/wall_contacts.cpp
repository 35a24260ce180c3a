// SPDX-License-Identifier: BSD-3-Clause
// Stage: ball-wall contacts. Ball by ball it is decided which rectangles push (wall_touches.hpp); those contacts are
// brought together and evaluated k_contact_batch at a time, and the walls add up what they feel in the order of the
// rows.
#include <algorithm>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/lane_vectors.hpp"
#include "dem4grm/engine/kernels/hertz_dispatch.hpp"
#include "dem4grm/engine/kernels/kernels.hpp"
#include "dem4grm/engine/wall_touches.hpp"

namespace dem::DEM_TARGET {

namespace {

constexpr std::size_t k_groups_ahead = 8;

/// Brings the stored shear force to the present contact plane. On a face the normal never turns; at an edge it turns
/// with the ball, and projection at constant length follows it.
DEM_INLINE Vec3 carried_at_wall(const Vec3& f, const Vec3& n, double half_twist) {
  const Vec3 flat = perpendicular(f, n);
  const double before = dot(f, f), after = dot(flat, flat);
  const double stretch = after > 0.0 ? std::sqrt(before / after) : 0.0;
  return perpendicular(turned_about_normal(flat * stretch, n, half_twist), n);
}

/// Starts to load the ball of a row.
void prefetch_ball(const Simulation& s, std::size_t row) {
  const int index = s.contacts.index_i[row];
  const double* ball = s.balls.state.data() + index;
  const std::size_t stride = s.balls.stride_of(index);
  for (std::size_t k = 0; k < k_pebble_components; ++k) __builtin_prefetch(ball + k * stride);
}

struct Works {
  double slip = 0.0, dashpot = 0.0;
};

void set_damping(ContactTable& c, std::size_t row, const Vec3& f) {
  c.damping_x[row] = f.x;
  c.damping_y[row] = f.y;
  c.damping_z[row] = f.z;
}

/// Contacts that wait to be evaluated, and what the law makes of them: one number of all of them side by side.
struct alignas(64) TouchBatch {
  static constexpr std::size_t n = k_contact_batch;
  LaneVectors<n> normal, relative, spin, shear, damping, force;
  double radius[n], overlap[n], hertz[n], shear_ratio[n], friction[n], normal_dashpot[n], shear_dashpot[n];
  double normal_force[n], stiffness[n], slip[n], dashpot[n];
  std::size_t row[n];
  int wall[n];
  std::size_t count;
};

/// The law for all places of a batch; what comes out for places beyond its count is not read.
template <HertzOptions options>
DEM_INLINE void evaluate_batch(TouchBatch& b, double dt) {
#pragma omp simd
  for (std::size_t k = 0; k < TouchBatch::n; ++k) {
    const Vec3 n = taken(b.normal, k), relative = taken(b.relative, k), spin = taken(b.spin, k);
    HertzMotion m;
    m.overlap = b.overlap[k];
    m.normal_speed = dot(relative, n);
    m.old_overlap = m.overlap + m.normal_speed * dt;
    const double lever = b.radius[k] - 0.5 * m.overlap;
    m.shear_velocity = perpendicular(relative - cross(spin, n * lever), n);
    m.carried_shear = carried_at_wall(taken(b.shear, k), n, 0.25 * dt * dot(spin, n));
    const HertzParameters p{b.hertz[k], b.shear_ratio[k], b.friction[k], options.dashpots ? b.normal_dashpot[k] : 0.0,
                            options.dashpots ? b.shear_dashpot[k] : 0.0};
    const HertzForce f = hertz_mindlin<options>(p, m, dt);
    put(b.shear, k, f.shear);
    put(b.damping, k, f.shear_total - f.shear);
    put(b.force, k, f.shear_total - n * f.normal_total);
    b.normal_force[k] = f.normal_total;
    b.stiffness[k] = 1.5 * p.hertz * std::sqrt(m.overlap);
    b.slip[k] = f.slip_work;
    b.dashpot[k] = f.dashpot_work;
  }
}

/// Evaluates the contacts of a batch, stores them in their rows and adds them to the reactions; the batch is empty then.
template <HertzOptions options>
void flush(Simulation& s, TouchBatch& b, WallReaction* reactions, Works& works) {
  if (b.count == 0) return;
  ContactTable& c = s.contacts;
  evaluate_batch<options>(b, s.last_dt);
  for (std::size_t k = 0; k < b.count; ++k) {
    c.state[b.row[k]] = {taken(b.normal, k), b.normal_force[k], taken(b.shear, k), b.overlap[k]};
    if constexpr (options.dashpots) set_damping(c, b.row[k], taken(b.damping, k));
    WallReaction& reaction = reactions[b.wall[k]];
    reaction.force -= taken(b.force, k);
    reaction.stiffness += b.stiffness[k];
    ++reaction.contacts;
    works.slip += b.slip[k];
    works.dashpot += b.dashpot[k];
  }
  b.count = 0;
}

void clear_row(ContactTable& c, std::size_t row) {
  c.state[row] = {};
  if (!c.damping_x.empty()) set_damping(c, row, {});
}

/// Adds a contact that counts to the batch; true when that is full.
template <HertzOptions options>
bool fetch_touch(const Simulation& s, std::size_t row, int wall, const WallView& view, TouchBatch& b) {
  const ContactTable& c = s.contacts;
  const auto i = static_cast<int>(c.index_i[row]);
  const std::size_t k = b.count++;
  b.row[k] = row;
  b.wall[k] = wall;
  put(b.normal, k, -view.away);  // from the ball to the wall
  put(b.relative, k, s.last_wall_velocity[static_cast<std::size_t>(wall)] - s.balls.velocity(i));
  put(b.spin, k, s.balls.spin(i));
  put(b.shear, k, c.shear(row));
  b.radius[k] = c.radius_i[row];
  b.overlap[k] = c.radius_i[row] - view.distance;
  b.hertz[k] = c.hertz[row];
  b.shear_ratio[k] = c.shear_ratio[row];
  b.friction[k] = c.friction[row];
  if constexpr (options.dashpots) {
    b.normal_dashpot[k] = c.normal_dashpot[row];
    b.shear_dashpot[k] = c.shear_dashpot[row];
  }
  return b.count == TouchBatch::n;
}

/// What the ball of rows [first, last), near several rectangles, touches.
int find_touches(Simulation& s, std::size_t first, std::size_t last, Touches& out) {
  ContactTable& c = s.contacts;
  const Vec3 centre = s.balls.position(c.index_i[first]);
  int n = 0;
  for (std::size_t row = first; row < last; ++row, ++n) {
    Touch& t = out[static_cast<std::size_t>(n)];
    t.row = row;
    t.wall = static_cast<int>(c.index_j[row]);
    t.view = look_at(s.walls[static_cast<std::size_t>(t.wall)], centre);
  }
  resolve_touches(s.walls, c.radius_i[first], out, n);
  hand_over_shear(c, out, n);
  return n;
}

/// The balls of one block of ids, in order.
template <HertzOptions options>
void evaluate_block(Simulation& s, std::size_t block) {
  const auto groups = static_cast<std::size_t>(s.wall_block[block + 1]);
  const std::size_t base = s.contacts.n_pair_rows();
  WallReaction* reactions = s.scratch_reactions.data() + block * s.walls.size();
  const auto row_of = [&](std::size_t g) { return base + static_cast<std::size_t>(s.wall_group[g]); };
  Works works;
  TouchBatch batch{};
  Touches found;
  const auto take = [&](std::size_t row, int wall, const WallView& view, bool counts) {
    if (!counts) {
      clear_row(s.contacts, row);
    } else if (fetch_touch<options>(s, row, wall, view, batch)) {
      flush<options>(s, batch, reactions, works);
    }
  };
  for (auto g = static_cast<std::size_t>(s.wall_block[block]); g < groups; ++g) {
    if (g + k_groups_ahead < groups) prefetch_ball(s, row_of(g + k_groups_ahead));
    const std::size_t first = row_of(g), last = row_of(g + 1);
    if (last - first == 1) {  // as most are
      const int wall = s.contacts.index_j[first];
      const WallView view =
          look_at(s.walls[static_cast<std::size_t>(wall)], s.balls.position(s.contacts.index_i[first]));
      take(first, wall, view, touches(view, s.contacts.radius_i[first]));
      continue;
    }
    const int n = find_touches(s, first, last, found);
    for (int k = 0; k < n; ++k) {
      const Touch& t = found[static_cast<std::size_t>(k)];
      take(t.row, t.wall, t.view, t.counts);
    }
  }
  flush<options>(s, batch, reactions, works);
  s.scratch_slip[block] = works.slip;
  s.scratch_dashpot[block] = works.dashpot;
}

template <HertzOptions options>
void evaluate(Simulation& s) {
  const std::size_t blocks = s.wall_block.empty() ? 0 : s.wall_block.size() - 1, n_walls = s.walls.size();
  const std::vector<WallReaction>& partial = s.scratch_reactions;
  prepare_partial_reactions(s, blocks * n_walls);
  prepare_partial_works(s, blocks);
  for_each_block(blocks, 1, [&](std::size_t block, std::size_t, std::size_t) { evaluate_block<options>(s, block); });
  std::fill(s.reactions.begin(), s.reactions.end(), WallReaction{});
  for (std::size_t block = 0; block < blocks; ++block) {
    for (std::size_t w = 0; w < n_walls; ++w) {
      const WallReaction& p = partial[block * n_walls + w];
      s.reactions[w].force += p.force;
      s.reactions[w].stiffness += p.stiffness;
      s.reactions[w].contacts += p.contacts;
    }
    s.ledger.contact_slip += s.scratch_slip[block];
    s.ledger.contact_dashpot += s.scratch_dashpot[block];
  }
  add_to_carriers(s);
}

}  // namespace

void evaluate_wall_contacts(Simulation& s) {
  with_hertz_options(s.scene.contact, [&](auto options) { evaluate<decltype(options)::value>(s); });
}

}  // namespace dem::DEM_TARGET
