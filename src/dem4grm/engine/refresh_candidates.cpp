// SPDX-License-Identifier: BSD-3-Clause
// Stage: the list of candidates, built anew before any pair outside it can touch.
#include <algorithm>
#include <cmath>

#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

/// A block whose true displacement is below this share of its margin is waited for.
constexpr double k_waiting_share = 0.7;
/// Work of a new list in evaluations of a row, per ball and per row, with its part of a search (bench_stage_times). The
/// sum is flat about its least: 1 and 8 give the same time of a step.
constexpr double k_search_cost = 8.0;
constexpr double k_shortest_horizon = 4.0, k_longest_horizon = 1e5;  // steps
constexpr double k_largest_change = 2.0;                             // of the horizon from one list to the next

/// The travels sum top speeds; true displacements are often smaller. True when the list still holds.
bool holds_by_true_displacements(Simulation& s) {
  CandidateMargins& m = s.margins;
  if (m.wall_travel > m.wall_margin) return false;
  for (std::size_t block = 0; block < m.travel.size(); ++block) {
    if (m.travel[block] <= m.margin[block]) continue;
    m.travel[block] = largest_displacement(s, block, s.built_at);
    if (m.travel[block] > k_waiting_share * m.margin[block]) return false;
  }
  m.is_used_up = false;
  return true;
}

/// formula:  horizon' = horizon sqrt(b / (life a))
///   a  rows of the old list that did not touch;   life  steps that it held;   b  cost of a search in rows
/// The rows that do not touch cost a per step and grow with the horizon T, the searches b / life and fall with it: the
/// sum is least where both are equal. All from the state, never from a clock: every machine takes the same lists.
double horizon_that_pays(const Simulation& s) {
  const ContactTable& t = s.contacts;
  double apart = 1.0;  // never 0
  for (std::size_t row = 0; row < t.n_rows(); ++row) apart += t.state[row].overlap > 0.0 ? 0.0 : 1.0;
  const auto life = static_cast<double>(s.steps - s.margins.built_at_step);
  const double search = k_search_cost * static_cast<double>(t.n_rows() + s.built_at[0].size());
  const double change = std::clamp(std::sqrt(search / (life * apart)), 1.0 / k_largest_change, k_largest_change);
  return std::clamp(s.margins.horizon * change, k_shortest_horizon, k_longest_horizon);
}

}  // namespace

double largest_displacement(const Simulation& s, std::size_t block, const BallPositions& since) {
  double largest2 = 0.0;
  const IdRange range = s.balls_of_block(block);
  for (int id = range.first; id < range.last; ++id) {
    const auto k = static_cast<std::size_t>(id);
    const Vec3 d = s.balls.position(s.balls.index_of_id(id)) - Vec3{since[0][k], since[1][k], since[2][k]};
    largest2 = std::max(largest2, dot(d, d));
  }
  return std::sqrt(largest2);
}

void choose_margins(Simulation& s) {
  CandidateMargins& m = s.margins;
  const std::size_t blocks = s.block_top_speed2.size();
  const auto life = static_cast<double>(s.steps - m.built_at_step);
  const auto rate = [&](double travel) { return life > 0.0 ? travel / life : 0.0; };  // m per step
  m.margin.resize(blocks);
  m.travel.resize(blocks);
  double mean = 0.0;
  for (std::size_t b = 0; b < blocks; ++b) {
    m.margin[b] = std::max(std::sqrt(s.block_top_speed2[b]) * s.dt, rate(m.travel[b]));
    mean += m.margin[b] / static_cast<double>(blocks);
  }
  for (double& margin : m.margin) margin = std::min(m.least + (margin + mean) * m.horizon, m.largest);
  double wall = rate(m.wall_travel);
  for (const Wall& w : s.walls) wall = std::max(wall, norm(w.velocity) * s.dt);
  m.wall_margin = m.least + (wall + mean) * m.horizon;
  m.travel.assign(blocks, 0.0);
  m.wall_travel = 0.0;
  m.is_used_up = false;
  m.built_at_step = s.steps;
}

void refresh_candidates(Simulation& s) {
  if (s.candidates_valid && (!s.margins.is_used_up || holds_by_true_displacements(s))) return;
  if (s.margins.tunes && s.steps > s.margins.built_at_step) s.margins.horizon = horizon_that_pays(s);
  s.rebuild_candidates();
}

}  // namespace dem
