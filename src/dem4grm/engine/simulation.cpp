// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem4grm/core/error.hpp"
#include "dem4grm/laws/mixing.hpp"

namespace dem {

namespace {

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
  ledger.grain_breakage.resize(blocks * w);
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
      balls.set_pebble_radius(pebble, p.radius * d);
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

IdRange Simulation::balls_of_block(std::size_t block) const {
  const auto rubber_blocks = static_cast<std::size_t>(balls.n_blocks);
  if (block < rubber_blocks) {
    const int width = static_cast<int>(k_lanes), first = static_cast<int>(block) * width;
    return {first * k_grain_balls, std::min(first + width, balls.n_grains) * k_grain_balls};
  }
  const std::size_t begin = (block - rubber_blocks) * k_clump_block;
  const std::size_t end = std::min(begin + k_clump_block, clumps.clumps.size());
  const Clump &first = clumps.clumps[begin], &last = clumps.clumps[end - 1];
  const int base = balls.n_rubber_balls();
  return {base + first.first_pebble, base + last.first_pebble + last.n_pebbles};
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

void prepare_partial_works(Simulation& s, std::size_t blocks) {
  s.scratch_slip.assign(blocks, 0.0);
  s.scratch_dashpot.assign(blocks, 0.0);
}

void add_to_carriers(Simulation& s) {
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    if (s.walls[w].carrier < 0) continue;
    WallReaction& all = s.reactions[static_cast<std::size_t>(s.walls[w].carrier)];
    all.force += s.reactions[w].force;
    all.stiffness += s.reactions[w].stiffness;
    all.contacts += s.reactions[w].contacts;
  }
}

void prepare_partial_reactions(Simulation& s, std::size_t n) { s.scratch_reactions.assign(n, WallReaction{}); }

void Simulation::reset_velocities() {
  for (int id = 0; id < balls.n_balls(); ++id) {
    const int i = balls.index_of_id(id);
    balls.set_velocity(i, {});
    balls.set_spin(i, {});
  }
  for (Clump& c : clumps.clumps) c.velocity = c.angular_momentum = c.spin = {};
}

}  // namespace dem
