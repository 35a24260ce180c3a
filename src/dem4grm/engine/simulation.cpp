// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/laws/mixing.hpp"

namespace dem {

namespace {

Elastic elastic(const MaterialSettings& m) { return {m.shear_modulus, m.poisson_ratio}; }

const MaterialSettings& settings_of(const Scene& scene, Material m) {
  return m == k_rubber ? scene.rubber : scene.gravel;
}

double ball_mass(double radius, double density) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}

BondDescription describe_bond(const Scene& scene, double radius, double mass) {
  const BondSettings& b = scene.bond;
  return {radius,
          mass,
          b.modulus,
          b.stiffness_ratio,
          b.radius_multiplier,
          b.moment_scale,
          b.damping_ratio,
          b.tensile_strength,
          b.shear_strength,
          b.linear_spring,
          b.spring_friction};
}

/// Constants of grains whose balls have that radius. Balls smaller than those of the reference size weigh so much that
/// every stiffness over its mass is that of the reference: stiffnesses go as r (at equal strain), so m goes as r and
/// the density as 1/r^2. Then all grains up to the reference size have one stability limit, larger ones a longer one.
RubberSize rubber_size(const Scene& scene, double r) {
  const double reference = scene.rubber_ball_radius;
  RubberSize size;
  size.ball_radius = r;
  size.ball_mass =
      r < reference ? ball_mass(reference, scene.rubber.density) * (r / reference) : ball_mass(r, scene.rubber.density);
  size.bond = bond_parameters(describe_bond(scene, r, size.ball_mass));
  const MixedElastic mixed = mix(elastic(scene.rubber), elastic(scene.rubber));
  const double h = r > 0.0 ? hertz_coefficient(mixed, r, r) : 0.0;
  size.second_neighbour = {
      h, mindlin_ratio(mixed), scene.rubber.friction,
      dashpot_coefficient(scene.contact.normal_damping_ratio, 0.5 * size.ball_mass, 1.5 * h),
      dashpot_coefficient(scene.contact.shear_damping_ratio, 0.5 * size.ball_mass, 1.5 * h * mindlin_ratio(mixed))};
  return size;
}

}  // namespace

Simulation::Simulation(const Scene& description) : scene(description), walls(description.wall_list) {
  int pebbles = 0;
  for (const PlacedClump& c : scene.clumps) {
    pebbles += static_cast<int>(scene.shapes.at(static_cast<std::size_t>(c.shape)).pebbles.size());
  }
  if (!scene.grains.empty() && !(scene.rubber_ball_radius > 0.0)) throw InputError("rubber grains need a ball radius");
  if (scene.grains.empty() && pebbles == 0) throw InputError("a simulation needs at least one grain");
  balls.allocate(static_cast<int>(scene.grains.size()), pebbles);
  const auto n = static_cast<std::size_t>(balls.n_balls());
  body_of.resize(n);
  owner_of.resize(n);
  place_of.resize(n);
  material_of.resize(n);
  choose_rubber_sizes();
  place_grains();
  place_clumps();

  friction = material_friction();
  reactions.resize(walls.size());
  last_wall_velocity.resize(walls.size());
  block_top_speed2.assign(
      static_cast<std::size_t>(balls.n_blocks) + (clumps.clumps.size() + k_clump_block - 1) / k_clump_block, 0.0);
  double smallest = 1e300;
  for (int id = 0; id < balls.n_balls(); ++id) smallest = std::min(smallest, balls.radius_of_id(id));
  margins.least = 0.01 * smallest;
  margins.largest = 2.0 * smallest;
}

void Simulation::choose_rubber_sizes() {
  rubber_sizes = {rubber_size(scene, scene.rubber_ball_radius)};
  size_of_block.assign(static_cast<std::size_t>(balls.n_blocks), 0);
  const std::vector<double>& radii = scene.rubber_ball_radii;
  if (radii.empty()) {
    balls.grain_radius.assign(scene.grains.size(), scene.rubber_ball_radius);
    return;
  }
  if (radii.size() != scene.grains.size()) throw InputError("every rubber grain needs a ball radius, or none has one");
  balls.grain_radius = radii;
  for (std::size_t g = 0; g < radii.size(); ++g) {
    if (g % k_grains_of_one_size != 0) {
      if (radii[g] != radii[g - 1]) throw InputError("rubber grains of one size must come in runs of eight");
      continue;
    }
    if (!(radii[g] > 0.0)) throw InputError("rubber grains need a ball radius");
    const bool is_known = rubber_sizes.back().ball_radius == radii[g];
    if (!is_known) rubber_sizes.push_back(rubber_size(scene, radii[g]));
    const std::size_t end = std::min(radii.size(), g + k_grains_of_one_size);
    for (std::size_t block = g / k_lanes; block * k_lanes < end; ++block) {
      size_of_block[block] = static_cast<int>(rubber_sizes.size()) - 1;
    }
  }
}

void Simulation::place_grains() {
  constexpr std::size_t w = k_lanes;
  const auto blocks = static_cast<std::size_t>(balls.n_blocks);
  lane_inverse_mass.resize(blocks * w);
  ledger.grain_damping.resize(blocks * w);
  ledger.grain_dashpot.resize(blocks * w);
  ledger.grain_slip.resize(blocks * w);
  grain_history.second_neighbour_shear.resize(blocks * k_grain_second_neighbours * 3 * w);
  grain_history.second_neighbour_touches.resize(blocks * k_grain_second_neighbours);
  if (scene.bond.spring_friction > 0.0 && scene.bond.hertz_contact) {
    throw InputError("bonded balls are either in Hertz contact or have a linear spring with friction, not both");
  }
  if (scene.bond.spring_friction > 0.0 || scene.bond.hertz_contact) {
    grain_history.companion_shear.resize(blocks * k_grain_bonds * 3 * w);
  }
  if (scene.bond.form == BondForm::incremental) {
    grain_history.bond.resize(blocks * k_grain_bonds * 6 * w);
    grain_history.bond_is_broken.resize(blocks * k_grain_bonds * w);
  }
  const int lanes = balls.n_blocks * static_cast<int>(w);
  for (int g = 0; g < lanes; ++g) {
    const bool real = g < balls.n_grains;
    // Unused lanes hold a resting grain far below the scene; nothing moves it.
    const Pose pose = real ? scene.grains[static_cast<std::size_t>(g)] : Pose{{0, 0, -1.0}, {}};
    const RubberSize& size = rubber_of_grain(g);
    const double a = k_grain_lattice * size.ball_radius;
    lane_inverse_mass[static_cast<std::size_t>(g)] = real ? 1.0 / size.ball_mass : 0.0;
    const Frame frame = frame_of(pose.orientation);
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const int i = BallStore::rubber_index(g, slot);
      balls.set_position(i, pose.position + to_space(frame, grain_site(slot) * a));
      balls.set_orientation(i, pose.orientation);
      if (!real) continue;
      const auto id = static_cast<std::size_t>(g * k_grain_balls + slot);
      body_of[id] = g;
      owner_of[id] = g / static_cast<int>(w);
      place_of[id] = slot * static_cast<int>(w) + g % static_cast<int>(w);
      material_of[id] = k_rubber;
    }
  }
}

void Simulation::place_clumps() {
  int pebble = 0;
  for (std::size_t c = 0; c < scene.clumps.size(); ++c) {
    const PlacedClump& placed = scene.clumps[c];
    const ClumpTemplate& shape = scene.shapes[static_cast<std::size_t>(placed.shape)];
    const double d = placed.size, density = settings_of(scene, placed.material).density;
    Clump body;
    body.position = placed.pose.position;
    body.orientation = placed.pose.orientation;
    body.volume = shape.volume * d * d * d;
    body.mass = density * body.volume;
    body.inertia = shape.moment_of_inertia * (density * d * d * d * d * d);
    body.size = d;
    body.first_pebble = pebble;
    body.n_pebbles = static_cast<int>(shape.pebbles.size());
    body.shape = placed.shape;
    body.material = placed.material;
    const Frame frame = frame_of(body.orientation);
    for (const Pebble& p : shape.pebbles) {
      const int i = balls.pebble_index(pebble);
      const auto id = static_cast<std::size_t>(balls.n_rubber_balls() + pebble);
      const Vec3 offset = p.position * d;
      clumps.pebble_offset.push_back(offset);
      clumps.clump_of_pebble.push_back(static_cast<int>(c));
      balls.set_position(i, body.position + to_space(frame, offset));
      balls.pebble_radius[static_cast<std::size_t>(pebble)] = p.radius * d;
      body_of[id] = balls.n_grains + static_cast<int>(c);
      owner_of[id] = balls.n_blocks + static_cast<int>(c);
      place_of[id] = i;
      material_of[id] = placed.material;
      ++pebble;
    }
    clumps.clumps.push_back(body);
  }
  ledger.clump_damping.assign(clumps.clumps.size(), 0.0);
}

std::size_t Simulation::speed_block_of(int id) const {
  const auto owner = static_cast<std::size_t>(owner_of[static_cast<std::size_t>(id)]);
  const auto rubber_blocks = static_cast<std::size_t>(balls.n_blocks);
  return owner < rubber_blocks ? owner : rubber_blocks + (owner - rubber_blocks) / k_clump_block;
}

Material Simulation::material_of_ball(int id) const {
  return static_cast<Material>(material_of[static_cast<std::size_t>(id)]);
}

std::string Simulation::name_of_ball(int id) const {
  if (id < balls.n_rubber_balls()) {
    return fmt::format("rubber grain {}, ball {}", id / k_grain_balls, id % k_grain_balls);
  }
  const int pebble = id - balls.n_rubber_balls();
  const int c = clumps.clump_of_pebble[static_cast<std::size_t>(pebble)];
  return fmt::format("clump {}, pebble {}", c, pebble - clumps.clumps[static_cast<std::size_t>(c)].first_pebble);
}

FrictionTable Simulation::material_friction() const {
  FrictionTable t;
  for (int a = 0; a < k_materials; ++a) {
    const double fa = settings_of(scene, static_cast<Material>(a)).friction;
    for (int b = 0; b < k_materials; ++b) {
      t.between_grains[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] =
          mix_friction(fa, settings_of(scene, static_cast<Material>(b)).friction);
    }
    t.against_walls[static_cast<std::size_t>(a)] = fa;
  }
  return t;
}

HertzParameters Simulation::contact_parameters(int ball_i, int ball_j, int wall) const {
  const Material mi = material_of_ball(ball_i);
  const bool at_wall = wall >= 0;
  const Material mj = at_wall ? mi : material_of_ball(ball_j);
  const MixedElastic mixed =
      mix(elastic(settings_of(scene, mi)), elastic(at_wall ? scene.walls : settings_of(scene, mj)));
  const auto mass_of = [&](int id) {
    if (id < balls.n_rubber_balls()) return rubber_of_grain(id / k_grain_balls).ball_mass;
    const int c = clumps.clump_of_pebble[static_cast<std::size_t>(id - balls.n_rubber_balls())];
    return clumps.clumps[static_cast<std::size_t>(c)].mass;
  };
  const double ri = balls.radius_of_id(ball_i), rj = at_wall ? 0.0 : balls.radius_of_id(ball_j);
  HertzParameters p;
  p.hertz = hertz_coefficient(mixed, ri, rj);
  p.shear_ratio = mindlin_ratio(mixed);
  p.friction = at_wall ? mix_friction(friction.against_walls[mi], walls[static_cast<std::size_t>(wall)].friction)
                       : friction.between_grains[mi][mj];
  const double m = at_wall ? mass_of(ball_i) : mass_of(ball_i) * mass_of(ball_j) / (mass_of(ball_i) + mass_of(ball_j));
  p.normal_dashpot = dashpot_coefficient(scene.contact.normal_damping_ratio, m, 1.5 * p.hertz);
  p.shear_dashpot = dashpot_coefficient(scene.contact.shear_damping_ratio, m, 1.5 * p.hertz * p.shear_ratio);
  return p;
}

void Simulation::set_time_step(double step) {
  if (!(step > 0.0)) throw InputError("the time step must be positive");
  dt = last_dt = step;
}

void Simulation::change_time_step(double step) {
  if (!(step > 0.0)) throw InputError("the time step must be positive");
  dt = step;
}

void Simulation::set_friction(const FrictionTable& table) {
  friction = table;
  candidates_valid = false;  // the rows hold their friction
}

void Simulation::reset_velocities() {
  for (int id = 0; id < balls.n_balls(); ++id) {
    const int i = balls.index_of_id(id);
    balls.set_velocity(i, {});
    balls.set_spin(i, {});
  }
  for (Clump& c : clumps.clumps) c.velocity = c.angular_momentum = c.spin = {};
}

void Simulation::rebuild_candidates() {
  const auto n = static_cast<std::size_t>(balls.n_balls());
  for (auto& a : built_at) a.resize(n);
  choose_margins(*this);
  std::vector<double> reach(n);  // radius and margin
  for (std::size_t id = 0; id < n; ++id) {
    const int i = balls.index_of_id(static_cast<int>(id));
    const Vec3 p = balls.position(i);
    built_at[0][id] = p.x;
    built_at[1][id] = p.y;
    built_at[2][id] = p.z;
    reach[id] = balls.radius_of_id(static_cast<int>(id)) + margins.margin[speed_block_of(static_cast<int>(id))];
  }
  const SearchBalls view{built_at[0], built_at[1], built_at[2], reach, body_of};
  contacts.replace(find_pairs(view, 0.0), find_wall_pairs(view, walls, margins.wall_margin), balls.n_rubber_balls());
  prepare_rows();
  candidates_valid = true;
  ++rebuilds;
}

void Simulation::prepare_rows() {
  const bool dashpots = scene.contact.normal_damping_ratio > 0.0 || scene.contact.shear_damping_ratio > 0.0;
  contacts.normal_dashpot.resize(dashpots ? contacts.n_rows() : 0);
  contacts.shear_dashpot.resize(dashpots ? contacts.n_rows() : 0);
  for (auto* a : {&contacts.damping_x, &contacts.damping_y, &contacts.damping_z}) {
    a->resize(dashpots ? contacts.n_rows() : 0);
  }
  const auto fill = [&](std::size_t row, int ball, const HertzParameters& p) {
    contacts.index_i[row] = balls.index_of_id(ball);
    contacts.radius_i[row] = balls.radius_of_id(ball);
    contacts.hertz[row] = p.hertz;
    contacts.shear_ratio[row] = p.shear_ratio;
    contacts.friction[row] = p.friction;
    if (dashpots) {
      contacts.normal_dashpot[row] = p.normal_dashpot;
      contacts.shear_dashpot[row] = p.shear_dashpot;
    }
  };
  contacts.has_equal_rubber = rubber_sizes.size() == 1;
  contacts.between_rubber_balls = balls.n_grains > 0 ? contact_parameters(0, 0, -1) : HertzParameters{};
  for (std::size_t c = 0; c < contacts.n_pairs(); ++c) {
    const int i = first_of(contacts.pairs[c]), j = second_of(contacts.pairs[c]);
    const bool is_equal = c < contacts.n_rubber_pairs && contacts.has_equal_rubber;
    fill(c, i, is_equal ? contacts.between_rubber_balls : contact_parameters(i, j, -1));
    contacts.index_j[c] = balls.index_of_id(j);
    contacts.radius_j[c] = balls.radius_of_id(j);
  }
  wall_group.clear();
  for (std::size_t c = 0; c < contacts.wall_pairs.size(); ++c) {
    const PairKey key = contacts.wall_pairs[c];
    fill(contacts.n_pair_rows() + c, first_of(key), contact_parameters(first_of(key), -1, second_of(key)));
    contacts.index_j[contacts.n_pair_rows() + c] = second_of(key);
    if (c == 0 || first_of(key) != first_of(contacts.wall_pairs[c - 1])) wall_group.push_back(static_cast<int>(c));
  }
  wall_group.push_back(static_cast<int>(contacts.wall_pairs.size()));
  wall_block.clear();
  for (int id = 0; id < balls.n_balls() + k_wall_block; id += k_wall_block) {
    const auto end = std::partition_point(wall_group.begin(), wall_group.end() - 1, [&](int row) {
      return first_of(contacts.wall_pairs[static_cast<std::size_t>(row)]) < id;
    });
    wall_block.push_back(static_cast<int>(end - wall_group.begin()));
  }
  for (std::size_t g = 0; g + 1 < wall_group.size(); ++g) {
    require(wall_group[g + 1] - wall_group[g] <= k_most_walls_per_ball,
            "a ball is near more walls than the wall stage holds");
  }
  references.build(contacts, owner_of, place_of, balls.n_blocks + static_cast<int>(clumps.clumps.size()));
}

}  // namespace dem
