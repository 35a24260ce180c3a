// SPDX-License-Identifier: BSD-3-Clause
// Stage: ball-wall contacts, ball by ball, so that an edge shared by two rectangles counts once.
//
// A ball may see several rectangles. Contacts on a face count, once where two pieces of a flat wall meet. A contact at
// an edge or corner counts only if its point does not lie on a rectangle that the ball touches on its face (there it is
// no edge at all: a flat wall made of two pieces pushes like one), nor coincides with an edge contact already counted
// (a convex edge belongs to two rectangles).
#include <algorithm>
#include <array>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/engine/hertz_dispatch.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

constexpr std::size_t k_groups_ahead = 8;

/// One rectangle as the present ball sees it.
struct Touch {
  std::size_t row = 0;
  int wall = 0;
  WallView view;
  bool counts = false;
};

using Touches = std::array<Touch, k_most_walls_per_ball>;

bool touches(const WallView& view, double radius) {
  return view.distance < radius && (!view.on_face || view.distance > -radius);
}

/// Decides which of the n touches of one ball count.
void resolve(const std::vector<Wall>& walls, double radius, Touches& t, int n) {
  const double tolerance = 1e-6 * radius;
  for (int a = 0; a < n; ++a) {
    Touch& edge = t[static_cast<std::size_t>(a)];
    edge.counts = touches(edge.view, radius);
    if (!edge.counts) continue;
    for (int b = 0; b < n && edge.counts; ++b) {
      const Touch& other = t[static_cast<std::size_t>(b)];
      const bool other_touches = other.view.distance < radius;
      if (a == b || !other_touches) continue;
      if (edge.view.on_face) {
        // A centre exactly over a seam projects into both pieces of the flat wall.
        edge.counts = !(b < a && other.counts && other.view.on_face && dot(edge.view.away, other.view.away) > 0.5 &&
                        norm(edge.view.nearest - other.view.nearest) <= tolerance);
      } else if (other.view.on_face) {
        edge.counts = !lies_on(walls[static_cast<std::size_t>(other.wall)], edge.view.nearest, tolerance);
      } else if (b < a && other.counts) {
        edge.counts = norm(edge.view.nearest - other.view.nearest) > tolerance;
      }
    }
  }
}

/// A ball that rolls from one piece of a flat wall to the next takes its shear force along.
void hand_over(ContactTable& c, const Touches& t, int n) {
  for (int a = 0; a < n; ++a) {
    const Touch& to = t[static_cast<std::size_t>(a)];
    if (!to.counts || !to.view.on_face || dot(c.shear(to.row), c.shear(to.row)) > 0.0) continue;
    for (int b = 0; b < n; ++b) {
      const Touch& from = t[static_cast<std::size_t>(b)];
      if (from.counts || dot(from.view.away, to.view.away) < 0.0) continue;
      const Vec3 f = c.shear(from.row);
      if (!(dot(f, f) > 0.0)) continue;
      c.state[to.row].shear = f;
      break;
    }
  }
}

/// Brings the stored shear force to the present contact plane. On a face the normal never turns; at an edge it turns
/// with the ball, and projection at constant length follows it.
Vec3 carried_at_wall(const Vec3& f, const Vec3& n, double half_twist) {
  const Vec3 flat = perpendicular(f, n);
  const double before = dot(f, f), after = dot(flat, flat);
  const double stretch = after > 0.0 ? std::sqrt(before / after) : 0.0;
  return perpendicular(turned_about_normal(flat * stretch, n, half_twist), n);
}

/// Starts to load the ball of a row.
void prefetch_ball(const Simulation& s, std::size_t row) {
  const double* ball = s.balls.state.data() + s.contacts.index_i[row];
  for (std::size_t k = 0; k < k_pebble_components; ++k) __builtin_prefetch(ball + k * k_lanes);
}

struct Works {
  double slip = 0.0, dashpot = 0.0;
};

void set_damping(ContactTable& c, std::size_t row, const Vec3& f) {
  c.damping_x[row] = f.x;
  c.damping_y[row] = f.y;
  c.damping_z[row] = f.z;
}

template <HertzOptions options>
void evaluate_touch(Simulation& s, std::size_t row, int wall, const WallView& view, WallReaction& reaction,
                    Works& works) {
  ContactTable& c = s.contacts;
  const auto i = static_cast<int>(c.index_i[row]);
  const double radius = c.radius_i[row];
  const Vec3 n = -view.away;  // from the ball to the wall
  const Vec3 spin = s.balls.spin(i);
  const Vec3 relative = s.last_wall_velocity[static_cast<std::size_t>(wall)] - s.balls.velocity(i);

  HertzMotion m;
  m.overlap = radius - view.distance;
  m.normal_speed = dot(relative, n);
  m.old_overlap = m.overlap + m.normal_speed * s.last_dt;
  const double lever = radius - 0.5 * m.overlap;
  m.shear_velocity = perpendicular(relative - cross(spin, n * lever), n);
  m.carried_shear = carried_at_wall(c.shear(row), n, 0.25 * s.last_dt * dot(spin, n));
  const HertzParameters p{c.hertz[row], c.shear_ratio[row], c.friction[row],
                          options.dashpots ? c.normal_dashpot[row] : 0.0,
                          options.dashpots ? c.shear_dashpot[row] : 0.0};
  const HertzForce f = hertz_mindlin<options>(p, m, s.last_dt);
  const Vec3 force = f.shear_total - n * f.normal_total;
  c.state[row] = {n, f.normal_total, f.shear, m.overlap};
  if constexpr (options.dashpots) set_damping(c, row, f.shear_total - f.shear);
  reaction.force -= force;
  reaction.stiffness += 1.5 * p.hertz * std::sqrt(m.overlap);
  ++reaction.contacts;
  works.slip += f.slip_work;
  works.dashpot += f.dashpot_work;
}

void clear_row(ContactTable& c, std::size_t row) {
  c.state[row] = {};
  if (!c.damping_x.empty()) set_damping(c, row, {});
}

/// A ball near one rectangle only, as most are.
template <HertzOptions options>
void evaluate_lone_touch(Simulation& s, std::size_t row, WallReaction* reactions, Works& works) {
  ContactTable& c = s.contacts;
  const auto wall = static_cast<int>(c.index_j[row]);
  const WallView view = look_at(s.walls[static_cast<std::size_t>(wall)], s.balls.position(c.index_i[row]));
  if (touches(view, c.radius_i[row])) {
    evaluate_touch<options>(s, row, wall, view, reactions[wall], works);
  } else {
    clear_row(c, row);
  }
}

template <HertzOptions options>
void evaluate_ball(Simulation& s, int first, int last, WallReaction* reactions, Works& works) {
  ContactTable& c = s.contacts;
  const std::size_t base = c.n_pair_rows();
  Touches touches;
  const int n = last - first;
  const auto ball = static_cast<int>(c.index_i[base + static_cast<std::size_t>(first)]);
  const Vec3 centre = s.balls.position(ball);
  for (int k = 0; k < n; ++k) {
    Touch& t = touches[static_cast<std::size_t>(k)];
    t.row = base + static_cast<std::size_t>(first + k);
    t.wall = static_cast<int>(c.index_j[t.row]);
    t.view = look_at(s.walls[static_cast<std::size_t>(t.wall)], centre);
  }
  resolve(s.walls, c.radius_i[touches[0].row], touches, n);
  if (n > 1) hand_over(c, touches, n);
  for (int k = 0; k < n; ++k) {
    const Touch& t = touches[static_cast<std::size_t>(k)];
    if (t.counts) {
      evaluate_touch<options>(s, t.row, t.wall, t.view, reactions[t.wall], works);
    } else {
      clear_row(c, t.row);
    }
  }
}

/// The balls of one block of ids, in order.
template <HertzOptions options>
void evaluate_block(Simulation& s, std::size_t block) {
  const auto groups = static_cast<std::size_t>(s.wall_block[block + 1]);
  const std::size_t base = s.contacts.n_pair_rows();
  WallReaction* reactions = s.scratch_reactions.data() + block * s.walls.size();
  Works works;
  for (auto g = static_cast<std::size_t>(s.wall_block[block]); g < groups; ++g) {
    if (g + k_groups_ahead < groups) {
      prefetch_ball(s, base + static_cast<std::size_t>(s.wall_group[g + k_groups_ahead]));
    }
    const int first = s.wall_group[g], last = s.wall_group[g + 1];
    if (last - first == 1) {
      evaluate_lone_touch<options>(s, base + static_cast<std::size_t>(first), reactions, works);
    } else {
      evaluate_ball<options>(s, first, last, reactions, works);
    }
  }
  s.scratch_slip[block] = works.slip;
  s.scratch_dashpot[block] = works.dashpot;
}

template <HertzOptions options>
void evaluate(Simulation& s) {
  const std::size_t blocks = s.wall_block.empty() ? 0 : s.wall_block.size() - 1, n_walls = s.walls.size();
  auto& partial = s.scratch_reactions;
  partial.assign(blocks * n_walls, WallReaction{});
  s.scratch_slip.assign(blocks, 0.0);
  s.scratch_dashpot.assign(blocks, 0.0);
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
}

}  // namespace

void evaluate_wall_contacts(Simulation& s) {
  with_hertz_options(s.scene.contact, [&](auto options) { evaluate<decltype(options)::value>(s); });
}

}  // namespace dem
