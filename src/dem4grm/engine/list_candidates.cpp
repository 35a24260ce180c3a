// SPDX-License-Identifier: BSD-3-Clause
// A new list of candidates: from the search when grains have moved far, else picked from what the search found last.
#include <algorithm>
#include <array>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

namespace {

constexpr std::size_t k_few_blocks = 64;  // blocks of grains
constexpr std::size_t k_few_rows = 1024;
/// Of the largest margin: the pairs near a fast block grow with the cube of its wide margin.
constexpr double k_widest = 0.5;

/// Radii (m) with the margins (m, one for each block of grains) added, by ball id.
void widen(const Simulation& s, const std::vector<double>& margin, std::vector<double>& reach) {
  reach.resize(static_cast<std::size_t>(s.balls.n_balls()));
  for_each_block(margin.size(), k_few_blocks, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const IdRange ids = s.balls_of_block(block);
      for (int id = ids.first; id < ids.last; ++id) {
        reach[static_cast<std::size_t>(id)] = s.balls.radius_of_id(id) + margin[block];
      }
    }
  });
}

/// Notes where the balls are.
void note_positions(Simulation& s) {
  for (auto& a : s.built_at) a.resize(static_cast<std::size_t>(s.balls.n_balls()));
  for_each_block(s.built_at[0].size(), k_few_rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t id = begin; id < end; ++id) {
      const Vec3 p = s.balls.position(s.balls.index_of_id(static_cast<int>(id)));
      s.built_at[0][id] = p.x;
      s.built_at[1][id] = p.y;
      s.built_at[2][id] = p.z;
    }
  });
}

/// True when all pairs within the present margins are among the near ones (near_pairs.hpp).
bool near_pairs_hold(const Simulation& s) {
  const NearPairs& near = s.near;
  if (!near.is_valid) return false;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    if (norm(s.walls[w].corner - near.wall_found_at[w]) + s.margins.wall_margin > near.wall_margin) return false;
  }
  const std::size_t blocks = near.margin.size();
  std::vector<unsigned char> has_left(block_count(blocks, k_few_blocks), 0);
  for_each_block(blocks, k_few_blocks, [&](std::size_t part, std::size_t begin, std::size_t end) {
    for (std::size_t block = begin; block < end; ++block) {
      const double free = near.margin[block] - s.margins.margin[block];
      if (largest_displacement(s, block, near.found_at) > free) has_left[part] = 1;
    }
  });
  return std::none_of(has_left.begin(), has_left.end(), [](unsigned char left) { return left != 0; });
}

void find_near_pairs(Simulation& s) {
  NearPairs& near = s.near;
  const CandidateMargins& m = s.margins;
  near.margin.resize(m.margin.size());
  for (std::size_t b = 0; b < m.margin.size(); ++b) {
    near.margin[b] = std::max(m.margin[b], std::min(near.reserve * m.margin[b], k_widest * m.largest));
  }
  near.wall_margin = near.reserve * m.wall_margin;
  near.found_at = s.built_at;
  near.wall_found_at.clear();
  for (const Wall& w : s.walls) near.wall_found_at.push_back(w.corner);
  widen(s, near.margin, s.scratch_reach);
  const SearchBalls balls{near.found_at[0], near.found_at[1], near.found_at[2], s.scratch_reach, s.body_of};
  near.pairs = find_pairs(balls, 0.0);
  near.wall_pairs = find_wall_pairs(balls, s.walls, near.wall_margin);
  near.is_valid = true;
  ++near.searches;
}

/// What the materials of two sides make of a contact; every pair of materials once.
struct MixedMaterials {
  std::array<std::array<MixedElastic, k_materials>, k_materials> between_grains;
  std::array<MixedElastic, k_materials> against_walls;
};

MixedMaterials mixed_materials(const Scene& scene) {
  MixedMaterials mixed;
  for (const Material a : {k_gravel, k_rubber}) {
    const Elastic one = elastic(settings_of(scene, a));
    for (const Material b : {k_gravel, k_rubber}) {
      mixed.between_grains[a][b] = mix(one, elastic(settings_of(scene, b)));
    }
    mixed.against_walls[a] = mix(one, elastic(scene.walls));
  }
  return mixed;
}

/// Mass of the body of a ball that counts for its dashpots, kg.
double dashpot_mass(const Simulation& s, int id) {
  if (id < s.balls.n_rubber_balls()) return s.rubber_of_grain(id / k_grain_balls).ball_mass;
  const int c = s.clumps.clump_of_pebble[static_cast<std::size_t>(id - s.balls.n_rubber_balls())];
  return s.clumps.clumps[static_cast<std::size_t>(c)].mass;
}

HertzParameters parameters(const Simulation& s, const MixedMaterials& all, int ball_i, int ball_j, int wall) {
  const bool at_wall = wall >= 0;
  const Material mi = s.material_of_ball(ball_i), mj = at_wall ? mi : s.material_of_ball(ball_j);
  const MixedElastic& mixed = at_wall ? all.against_walls[mi] : all.between_grains[mi][mj];
  HertzParameters p;
  p.hertz = hertz_coefficient(mixed, s.balls.radius_of_id(ball_i), at_wall ? 0.0 : s.balls.radius_of_id(ball_j));
  p.shear_ratio = mindlin_ratio(mixed);
  p.friction = at_wall ? mix_friction(s.friction.against_walls[mi], s.walls[static_cast<std::size_t>(wall)].friction)
                       : s.friction.between_grains[mi][mj];
  const ContactSettings& contact = s.scene.contact;
  if (!has_dashpots(contact)) return p;
  const double a = dashpot_mass(s, ball_i), b = at_wall ? 0.0 : dashpot_mass(s, ball_j);
  const double mass = at_wall ? a : a * b / (a + b);
  p.normal_dashpot = dashpot_coefficient(contact.normal_damping_ratio, mass, 1.5 * p.hertz);
  p.shear_dashpot = dashpot_coefficient(contact.shear_damping_ratio, mass, 1.5 * p.hertz * p.shear_ratio);
  return p;
}

/// Constants of a row but those of its second body.
void fill_row(Simulation& s, std::size_t row, int ball, const HertzParameters& p) {
  ContactTable& t = s.contacts;
  t.index_i[row] = s.balls.index_of_id(ball);
  t.radius_i[row] = s.balls.radius_of_id(ball);
  t.hertz[row] = p.hertz;
  t.shear_ratio[row] = p.shear_ratio;
  t.friction[row] = p.friction;
  if (t.has_dashpots()) {
    t.normal_dashpot[row] = p.normal_dashpot;
    t.shear_dashpot[row] = p.shear_dashpot;
  }
}

void fill_pair_rows(Simulation& s, const MixedMaterials& mixed) {
  ContactTable& t = s.contacts;
  t.has_equal_rubber = s.rubber_sizes.size() == 1;
  t.between_rubber_balls = s.balls.n_grains > 0 ? parameters(s, mixed, 0, 0, -1) : HertzParameters{};
  for_each_block(t.n_pairs(), k_few_rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int i = first_of(t.pairs[row]), j = second_of(t.pairs[row]);
      const bool is_equal = row < t.n_rubber_pairs && t.has_equal_rubber;
      fill_row(s, row, i, is_equal ? t.between_rubber_balls : parameters(s, mixed, i, j, -1));
      t.index_j[row] = s.balls.index_of_id(j);
      t.radius_j[row] = s.balls.radius_of_id(j);
    }
  });
}

void fill_wall_rows(Simulation& s, const MixedMaterials& mixed) {
  ContactTable& t = s.contacts;
  for_each_block(t.wall_pairs.size(), k_few_rows, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t w = begin; w < end; ++w) {
      const std::size_t row = t.n_pair_rows() + w;
      const int ball = first_of(t.wall_pairs[w]), wall = second_of(t.wall_pairs[w]);
      fill_row(s, row, ball, parameters(s, mixed, ball, -1, wall));
      t.index_j[row] = wall;
    }
  });
}

void group_wall_rows(Simulation& s) {
  const std::vector<PairKey>& pairs = s.contacts.wall_pairs;
  s.wall_group.clear();
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (c == 0 || first_of(pairs[c]) != first_of(pairs[c - 1])) s.wall_group.push_back(static_cast<int>(c));
  }
  s.wall_group.push_back(static_cast<int>(pairs.size()));
  s.wall_block.clear();
  for (int id = 0; id < s.balls.n_balls() + k_wall_block; id += k_wall_block) {
    const auto end = std::partition_point(s.wall_group.begin(), s.wall_group.end() - 1,
                                          [&](int row) { return first_of(pairs[static_cast<std::size_t>(row)]) < id; });
    s.wall_block.push_back(static_cast<int>(end - s.wall_group.begin()));
  }
  for (std::size_t g = 0; g + 1 < s.wall_group.size(); ++g) {
    require(s.wall_group[g + 1] - s.wall_group[g] <= k_most_walls_per_ball,
            "a ball is near more walls than the wall stage holds");
  }
}

void group_rubber_rows(Simulation& s) {
  const ContactTable& t = s.contacts;
  RubberBatches& b = s.rubber_batches;
  const std::size_t batches = t.n_rubber_pairs / k_contact_batch;
  const auto block_of = [&](int ball) { return s.owner_of[static_cast<std::size_t>(ball)]; };
  b.first.assign(static_cast<std::size_t>(s.balls.n_blocks) + 1, 0);
  b.last_block.assign(batches, 0);
  b.slip.assign(batches, 0.0);
  b.dashpot.assign(batches, 0.0);
  b.part_length = 0;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    const std::size_t row = batch * k_contact_batch;
    ++b.first[static_cast<std::size_t>(block_of(first_of(t.pairs[row]))) + 1];
    for (std::size_t k = row; k < row + k_contact_batch; ++k) {
      b.last_block[batch] = std::max(b.last_block[batch], block_of(second_of(t.pairs[k])));
    }
  }
  for (std::size_t block = 1; block < b.first.size(); ++block) b.first[block] += b.first[block - 1];
}

}  // namespace

HertzParameters Simulation::contact_parameters(int ball_i, int ball_j, int wall) const {
  return parameters(*this, mixed_materials(scene), ball_i, ball_j, wall);
}

void Simulation::rebuild_candidates() {
  choose_margins(*this);
  note_positions(*this);
  if (!candidates_valid || !near_pairs_hold(*this)) find_near_pairs(*this);
  widen(*this, margins.margin, scratch_reach);
  const SearchBalls here{built_at[0], built_at[1], built_at[2], scratch_reach, body_of};
  contacts.replace(pick_pairs(here, near.pairs), pick_wall_pairs(here, walls, margins.wall_margin, near.wall_pairs),
                   balls.n_rubber_balls());
  prepare_rows();
  candidates_valid = true;
  ++rebuilds;
}

void Simulation::prepare_rows() {
  const std::size_t rows = has_dashpots(scene.contact) ? contacts.n_rows() : 0;
  for (auto* column : {&contacts.normal_dashpot, &contacts.shear_dashpot, &contacts.damping_x, &contacts.damping_y,
                       &contacts.damping_z}) {
    column->resize(rows);
  }
  const MixedMaterials mixed = mixed_materials(scene);
  fill_pair_rows(*this, mixed);
  fill_wall_rows(*this, mixed);
  group_wall_rows(*this);
  group_rubber_rows(*this);
  references.build(contacts, owner_of, place_of, balls.n_blocks + static_cast<int>(clumps.clumps.size()));
}

}  // namespace dem
