// SPDX-License-Identifier: BSD-3-Clause
// Bonded cantilevers at rest under a load: straight chains of up to five balls, and the whole rubber grain.
//
// The engine bonds balls in rubber grains only. The balls along a body diagonal of the grain are a straight chain
// corner - centre - corner - centre - corner; with all other bonds broken by hand and all other balls moved away, the
// engine computes a cantilever of one to four bonds.
#include <algorithm>

#include "dem4grm/laws/rigid_rotation.hpp"
#include "peer_cases.hpp"

namespace dem::peers {

namespace {

constexpr int k_diagonal[] = {0, 27, 13, 34, 26};  // slots from corner (-,-,-) to corner (+,+,+)

struct LoadedBall {
  int slot = 0;
  Vec3 force, torque;  // N, N m
};

struct Cantilever {
  std::string name;
  BondForm form = BondForm::incremental;
  std::vector<int> slots;  ///< balls that take part
  std::vector<int> held;   ///< slots
  std::vector<LoadedBall> loads;
};

bool contains(const std::vector<int>& list, int slot) {
  return std::find(list.begin(), list.end(), slot) != list.end();
}

Scene scene_of(const Json& p, BondForm form) {
  Scene scene = model_scene();
  scene.rubber.density = p.at("density");
  scene.rubber_ball_radius = p.at("radius");
  scene.bond.modulus = p.at("modulus");
  scene.bond.stiffness_ratio = p.at("stiffness_ratio");
  scene.bond.damping_ratio = 0.0;
  scene.bond.linear_spring = false;  // it only pushes; the other program's spring is the same both ways
  scene.bond.form = form;
  scene.grains = {{{0, 0, 0}, {}}};
  return scene;
}

/// Leaves only the bonds between the balls of the list; the others go where nothing touches them.
void isolate(Simulation& s, const std::vector<int>& slots) {
  const double r = s.scene.rubber_ball_radius;
  for (std::size_t k = 0; k < k_grain_bonds; ++k) {
    const SlotPair b = k_bonds_of_grain[k];
    if (!contains(slots, b.i) || !contains(slots, b.j)) s.grain_history.bond_is_broken[k * k_lanes] = 1;
  }
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    if (!contains(slots, slot)) s.balls.set_position(BallStore::rubber_index(0, slot), {(20.0 + 4.0 * slot) * r, 0, 0});
  }
  s.invalidate_candidates();
}

/// Changes the motion of the last half step, and with it the place it led to: the law takes displacements from
/// velocities.
void push(Simulation& s, int slot, const Vec3& velocity, const Vec3& spin) {
  const int i = BallStore::rubber_index(0, slot);
  s.balls.set_velocity(i, s.balls.velocity(i) + velocity);
  s.balls.set_spin(i, s.balls.spin(i) + spin);
  s.balls.set_position(i, s.balls.position(i) + velocity * s.dt);
  s.balls.set_orientation(i, turned(s.balls.orientation(i), spin, s.dt));
}

/// Steps with the loads until rest. Velocities are damped by hand: local damping would also act on the loads.
void relax(Simulation& s, const Cantilever& c, const Json& p) {
  const double dt = p.at("time_step"), loss = dt * p.at("damping_rate").get<double>();
  const double mass = s.rubber().ball_mass, r = s.scene.rubber_ball_radius, inertia = 0.4 * mass * r * r;
  const Simulation start = s;
  s.set_time_step(dt);
  const int steps = p.at("steps");
  for (int k = 0; k < steps; ++k) {
    // The motion before the step: that after it is not zero at rest until the load is added.
    std::array<Vec3, k_grain_balls> velocity, spin;
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      const int i = BallStore::rubber_index(0, slot);
      velocity.at(static_cast<std::size_t>(slot)) = s.balls.velocity(i);
      spin.at(static_cast<std::size_t>(slot)) = s.balls.spin(i);
    }
    s.step();
    for (const int slot : c.slots) {
      const auto k_slot = static_cast<std::size_t>(slot);
      push(s, slot, velocity.at(k_slot) * -loss, spin.at(k_slot) * -loss);
    }
    for (const LoadedBall& l : c.loads) push(s, l.slot, l.force * (dt / mass), l.torque * (dt / inertia));
    for (const int slot : c.held) {
      const int i = BallStore::rubber_index(0, slot);
      s.balls.set_position(i, start.balls.position(i));
      s.balls.set_velocity(i, {});
      s.balls.set_spin(i, {});
      s.balls.set_orientation(i, {});
    }
  }
}

void run_one(const Json& p, const Cantilever& c, const Folder& folder) {
  Simulation s(scene_of(p, c.form));
  if (c.slots.size() < k_grain_balls) isolate(s, c.slots);
  Table start(folder / (c.name + ".start.csv"), "x,y,z,held,fx,fy,fz,tx,ty,tz");
  for (const int slot : c.slots) {
    const Vec3 at = s.balls.position(BallStore::rubber_index(0, slot));
    LoadedBall load;
    for (const LoadedBall& l : c.loads) {
      if (l.slot == slot) load = l;
    }
    start.row(at.x, at.y, at.z, contains(c.held, slot) ? 1 : 0, load.force.x, load.force.y, load.force.z, load.torque.x,
              load.torque.y, load.torque.z);
  }
  const Simulation before = s;
  relax(s, c, p);
  Table result(folder / (c.name + ".ours.csv"), "ux,uy,uz,ax,ay,az");
  for (const int slot : c.slots) {
    const int i = BallStore::rubber_index(0, slot);
    const Quaternion q = s.balls.orientation(i);
    const Vec3 u = s.balls.position(i) - before.balls.position(i);
    const Vec3 half{q.x, q.y, q.z};
    const double sine = norm(half), angle = 2.0 * std::atan2(sine, q.w);
    const Vec3 turn = sine > 0.0 ? half * (angle / sine) : Vec3{};
    result.row(u.x, u.y, u.z, turn.x, turn.y, turn.z);
  }
}

/// The chain of n bonds with a load at its last ball.
Cantilever chain(const std::string& name, int n, const Vec3& force, const Vec3& torque = {}) {
  Cantilever c;
  c.name = "cantilever-" + name;
  c.slots.assign(std::begin(k_diagonal), std::begin(k_diagonal) + n + 1);
  c.held = {k_diagonal[0]};
  c.loads = {{k_diagonal[n], force, torque}};
  return c;
}

/// The grain held at its lowest nine balls, pushed sideways (x) at its top nine.
Cantilever grain(const std::string& name, BondForm form, double force) {
  Cantilever c;
  c.name = "cantilever-" + name;
  c.form = form;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    c.slots.push_back(slot);
    if (grain_site(slot).z == -1.0) c.held.push_back(slot);
    if (grain_site(slot).z == 1.0) c.loads.push_back({slot, {force / 9.0, 0, 0}, {}});
  }
  return c;
}

}  // namespace

void run_cantilevers(const Json& parameters, const Folder& folder) {
  const double r = parameters.at("radius"), modulus = parameters.at("modulus");
  const Vec3 along = Vec3{1, 1, 1} * (1.0 / std::sqrt(3.0)), across = Vec3{1, -1, 0} * (1.0 / std::sqrt(2.0));
  // Loads that turn or bend the last ball by about the chosen share of the length.
  const double length = 8.0 * r, second_moment = 0.25 * k_pi * r * r * r * r;
  const double share = parameters.at("chain_deflection"), bending = modulus * second_moment / (length * length);
  for (const int n : {1, 2, 4}) {
    const double stiffer = 64.0 / (n * n * n);
    run_one(parameters, chain("force-" + std::to_string(n), n, across * (3.0 * share * bending * stiffer)), folder);
  }
  run_one(parameters, chain("pull-4", 4, along * (share * modulus * k_pi * r * r)), folder);
  run_one(parameters, chain("twist-4", 4, {}, along * (share * bending * length)), folder);
  run_one(parameters, chain("moment-4", 4, {}, across * (share * bending * length)), folder);
  const auto forces = parameters.at("grain_force").get<std::vector<double>>();
  for (const auto& [form, word] :
       {std::pair{BondForm::incremental, "incremental"}, std::pair{BondForm::history_free, "history-free"}}) {
    run_one(parameters, grain(std::string("grain-small-") + word, form, forces.at(0)), folder);
    run_one(parameters, grain(std::string("grain-large-") + word, form, forces.at(1)), folder);
  }
}

}  // namespace dem::peers
