// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/observe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem {

std::vector<Vec3> net_contact_forces(const Simulation& s) {
  std::vector<Vec3> net(static_cast<std::size_t>(s.n_bodies()));
  const ContactTable& t = s.contacts;
  for (std::size_t c = 0; c < t.n_pairs(); ++c) {
    const Vec3 f = t.force(c);
    net[static_cast<std::size_t>(s.body_of_ball(first_of(t.pairs[c])))] += f;
    net[static_cast<std::size_t>(s.body_of_ball(second_of(t.pairs[c])))] -= f;
  }
  for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) {
    net[static_cast<std::size_t>(s.body_of_ball(first_of(t.wall_pairs[c])))] += t.force(t.n_pair_rows() + c);
  }
  return net;
}

Balance balance(const Simulation& s) {
  const ContactTable& t = s.contacts;
  Balance b;
  double contact_sum = 0.0;
  std::vector<char> touched(static_cast<std::size_t>(s.n_bodies()), 0);
  const auto count = [&](std::size_t row, int first, int second) {
    const double f = norm(t.force(row));
    if (f == 0.0) return;
    contact_sum += f;
    ++b.active_contacts;
    touched[static_cast<std::size_t>(s.body_of_ball(first))] = 1;
    if (second >= 0) touched[static_cast<std::size_t>(s.body_of_ball(second))] = 1;
  };
  for (std::size_t c = 0; c < t.n_pairs(); ++c) count(c, first_of(t.pairs[c]), second_of(t.pairs[c]));
  for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) count(t.n_pair_rows() + c, first_of(t.wall_pairs[c]), -1);
  const std::vector<Vec3> net = net_contact_forces(s);
  double net_sum = 0.0;
  int bodies = 0;
  for (std::size_t k = 0; k < net.size(); ++k) {
    if (touched[k] == 0) continue;
    net_sum += norm(net[k]);
    ++bodies;
  }
  if (bodies > 0) b.mean_net_force = net_sum / bodies;
  if (b.active_contacts > 0) b.mean_contact_force = contact_sum / b.active_contacts;
  return b;
}

namespace {

double fourth_moments(const Frame& f) {
  double sum = 0.0;
  for (const Vec3& e : {f.e1, f.e2, f.e3}) {
    sum += e.x * e.x * e.x * e.x + e.y * e.y * e.y * e.y + e.z * e.z * e.z * e.z;
  }
  return sum / 3.0;
}

/// Axes of a deformed grain from the directions between opposite face balls.
Frame grain_axes(const Simulation& s, int grain) {
  const auto axis = [&](int from, int to) {
    const Vec3 d =
        s.balls.position(BallStore::rubber_index(grain, to)) - s.balls.position(BallStore::rubber_index(grain, from));
    return d * (1.0 / norm(d));
  };
  return {axis(12, 14), axis(10, 16), axis(4, 22)};
}

}  // namespace

double rubber_alignment(const Simulation& s) {
  double sum = 0.0;
  int n = 0;
  for (int g = 0; g < s.balls.n_grains; ++g, ++n) sum += fourth_moments(grain_axes(s, g));
  for (const Clump& c : s.clumps.clumps) {
    if (c.material != k_rubber) continue;
    sum += fourth_moments(frame_of(c.orientation));
    ++n;
  }
  return n > 0 ? sum / n : 0.0;
}

OverlapReport worst_overlap(const Simulation& s) {
  OverlapReport out;
  const ContactTable& t = s.contacts;
  for (std::size_t c = 0; c < t.n_pairs(); ++c) {
    const Vec3 d = s.balls.position(static_cast<int>(t.index_j[c])) - s.balls.position(static_cast<int>(t.index_i[c]));
    const double smaller = std::min(t.radius_i[c], t.radius_j[c]), larger = std::max(t.radius_i[c], t.radius_j[c]);
    const double length = norm(d), relative = (t.radius_i[c] + t.radius_j[c] - length) / smaller;
    if (length < larger) ++out.caught;
    if (relative > out.largest) {
      out.largest = relative;
      out.ball_i = first_of(t.pairs[c]);
      out.ball_j = second_of(t.pairs[c]);
    }
  }
  for (std::size_t c = 0; c < t.wall_pairs.size(); ++c) {
    const std::size_t row = t.n_pair_rows() + c;
    if (norm(t.force(row)) == 0.0) continue;
    const double relative = t.state[row].overlap / t.radius_i[row];
    if (relative > out.largest) {
      out.largest = relative;
      out.ball_i = first_of(t.wall_pairs[c]);
      out.ball_j = -1;
      out.wall = second_of(t.wall_pairs[c]);
    }
  }
  return out;
}

namespace {

bool is_in_one_of(std::span<const Bounds> rooms, const Vec3& p) {
  return std::any_of(rooms.begin(), rooms.end(), [&](const Bounds& room) { return is_inside(p, room); });
}

}  // namespace

bool has_only_numbers(const Simulation& s) {
  // 0 x is 0 for a finite x and no number for all others.
  constexpr std::size_t k_lines = 8;
  const std::span<const double> state = s.balls.state.span();
  double zero[k_lines] = {};
  const std::size_t whole = state.size() - state.size() % k_lines;
  for (std::size_t k = 0; k < whole; k += k_lines) {
    for (std::size_t lane = 0; lane < k_lines; ++lane) zero[lane] += 0.0 * state[k + lane];
  }
  double sum = s.ledger.boundary + s.ledger.contact_slip + s.ledger.contact_dashpot;
  for (std::size_t k = whole; k < state.size(); ++k) sum += 0.0 * state[k];
  for (const double z : zero) sum += z;
  for (const Wall& wall : s.walls) {
    const Vec3 at = wall.corner + wall.velocity;
    sum += at.x + at.y + at.z;
  }
  return std::isfinite(sum);
}

namespace {

Trouble find_runaway(const Simulation& s) {
  double farthest = k_longest_move;
  int thrown = -1;
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const double move = norm(s.balls.velocity(s.balls.index_of_id(id))) * s.dt / s.balls.radius_of_id(id);
    if (move <= farthest) continue;
    farthest = move;
    thrown = id;
  }
  if (thrown < 0) return {};
  return {
      TroubleKind::runaway,
      fmt::format(
          "{} moves at {:.3g} m/s, {:.2g} of its radius in one time step of {:.3g} s (limit {:g}): the calculation is "
          "unstable",
          s.name_of_ball(thrown), norm(s.balls.velocity(s.balls.index_of_id(thrown))), farthest, s.dt, k_longest_move),
      {}};
}

}  // namespace

Trouble find_trouble(const Simulation& s, std::span<const Bounds> rooms, double overlap_limit) {
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const int i = s.balls.index_of_id(id);
    const Vec3 p = s.balls.position(i), v = s.balls.velocity(i), w = s.balls.spin(i);
    const Quaternion q = id < s.balls.n_rubber_balls() ? s.balls.orientation(i) : Quaternion{};
    if (!std::isfinite(p.x + p.y + p.z + v.x + v.y + v.z + w.x + w.y + w.z + q.w + q.x + q.y + q.z)) {
      return {TroubleKind::no_number,
              fmt::format("{} has a position or velocity that is no number", s.name_of_ball(id)), p};
    }
    if (!is_in_one_of(rooms, p)) {
      return {TroubleKind::outside,
              fmt::format("{} left the box: its centre is at ({:.2f}, {:.2f}, {:.2f}) mm", s.name_of_ball(id),
                          p.x * 1e3, p.y * 1e3, p.z * 1e3),
              p};
    }
  }
  if (Trouble thrown = find_runaway(s); thrown.kind != TroubleKind::none) return thrown;
  for (const Wall& wall : s.walls) {
    const Vec3 at = wall.corner + wall.velocity;
    if (!std::isfinite(at.x + at.y + at.z)) {
      return {
          TroubleKind::no_number, fmt::format("the {} has a position or velocity that is no number", wall.name), {}};
    }
  }
  if (!std::isfinite(s.ledger.boundary + s.ledger.contact_slip + s.ledger.contact_dashpot)) {
    return {TroubleKind::no_number, "the work of the walls or of slip is no number", {}};
  }
  const OverlapReport o = worst_overlap(s);
  if (o.largest <= overlap_limit) return {};
  const std::string partner = o.wall >= 0 ? s.walls[static_cast<std::size_t>(o.wall)].name : s.name_of_ball(o.ball_j);
  return {TroubleKind::overlap,
          fmt::format("the overlap of {} and {} is {:.2f} of the smaller radius (limit {:.2f})",
                      s.name_of_ball(o.ball_i), partner, o.largest, overlap_limit),
          {}};
}

int count_lost_bodies(const Simulation& s, std::span<const Bounds> rooms) {
  std::vector<char> lost(static_cast<std::size_t>(s.n_bodies()), 0);
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const Vec3 p = s.balls.position(s.balls.index_of_id(id));
    if (!is_in_one_of(rooms, p)) lost[static_cast<std::size_t>(s.body_of_ball(id))] = 1;
  }
  return static_cast<int>(std::count(lost.begin(), lost.end(), 1));
}

double gravity_energy(const Simulation& s) {
  Vec3 moment;  // kg m
  for (int id = 0; id < s.balls.n_rubber_balls(); ++id) {
    moment += s.balls.position(s.balls.index_of_id(id)) * s.rubber_of_grain(id / k_grain_balls).ball_mass;
  }
  for (const Clump& c : s.clumps.clumps) moment += c.position * c.mass;
  return -dot(s.scene.gravity, moment);
}

Vec3 body_position(const Simulation& s, int body) {
  if (body >= s.balls.n_grains) return s.clumps.clumps[static_cast<std::size_t>(body - s.balls.n_grains)].position;
  Vec3 sum;
  for (int slot = 0; slot < k_grain_balls; ++slot) sum += s.balls.position(BallStore::rubber_index(body, slot));
  return sum * (1.0 / k_grain_balls);
}

}  // namespace dem
