// SPDX-License-Identifier: BSD-3-Clause
// A mirrored or shifted scene moves like the mirror image or the shifted one.
//
// Without local damping, which asks for the sign of each velocity: of a ball at rest that is the sign of a last bit,
// and the first force on it counts 20 % more or less for one step.
#include <gtest/gtest.h>
// rapidcheck's own header needs gtest's first.
#include <rapidcheck/gtest.h>

#include <cmath>

#include "support/mixture_scene.hpp"

namespace {

using namespace dem;
using namespace dem::test;

RC_GTEST_PROP(EngineProperty, ShiftedSceneIsShifted, ()) {
  MixtureOptions o;
  o.cells = {3, 3, 3};
  o.seed = *rc::gen::inRange<std::uint64_t>(1, 1000);
  const auto run = [&] {
    // The plate at a given speed: a servo decides by whether anything touches, which a last bit may turn.
    Scene scene = mixture_scene(o);
    scene.integration.local_damping = 0.0;
    Simulation s(scene);
    s.set_time_step(1e-6);
    ShearBox::set_velocities(s.walls, MovingHalf::lower, 0.5, -1.0);
    run_steps(s, 300);
    return s;
  };
  const Simulation here = run();
  RC_ASSERT(here.energy().slip > 0.0);
  o.shift = {0.037, -0.011, 0.023};
  const Simulation there = run();
  for (int id = 0; id < here.balls.n_balls(); ++id) {
    const int i = here.balls.index_of_id(id);
    RC_ASSERT(norm(there.balls.position(i) - here.balls.position(i) - o.shift) < 1e-9 * k_cell);
  }
}

/// A sphere packing between smooth and rough walls: pyramid of five spheres and a rubber grain squeezed in a box; the
/// mirror plane is x = 0, so positions and velocities flip x, spins and quaternions flip y and z.
Scene heap(std::uint64_t seed, bool mirrored) {
  Scene scene = model_scene();
  scene.rubber_ball_radius = 0.4e-3;
  scene.contact = {1, 0.1, 0.1, 0};
  const double flip = mirrored ? -1.0 : 1.0;
  RandomSequence random(seed, RandomStream::test, 0);
  for (int z = 0; z < 3; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        const Vec3 at{(x - 1) * 3.9e-3 + random.uniform(-1e-4, 1e-4), (y - 1) * 3.9e-3, (z - 1) * 3.9e-3};
        const Quaternion q = random.orientation();
        const Vec3 m{at.x * flip, at.y, at.z};
        if (x == 1 && (y + z) % 2 == 0) {
          scene.grains.push_back({m, {q.w, q.x, q.y * flip, q.z * flip}});
        } else {
          add_sphere(scene, m, random.uniform(1.9e-3, 2.0e-3));
        }
      }
    }
  }
  std::vector<Wall> box = closed_box({11.6e-3, 11.6e-3, 11.6e-3}, 0.5);
  for (Wall& w : box) w.corner -= Vec3{5.8e-3, 5.8e-3, 5.8e-3};
  if (mirrored) std::swap(box[1], box[2]);  // the box is symmetric; each wall keeps its number
  scene.wall_list = box;
  return scene;
}

RC_GTEST_PROP(EngineProperty, MirroredSceneIsMirrored, ()) {
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 1000);
  Simulation a(heap(seed, false)), b(heap(seed, true));
  for (Simulation* s : {&a, &b}) {
    s->set_time_step(1e-6);
    const double flip = s == &a ? 1.0 : -1.0;
    // The wall that is at -x in the first scene pushes in, the lid slides along.
    s->walls[1].velocity = {0.3 * flip, 0, 0};
    s->walls[5].velocity = {0.2 * flip, 0.1, -0.5};
    RandomSequence random(seed, RandomStream::test, 1);
    for (std::size_t c = 0; c < s->clumps.clumps.size(); ++c) {
      const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const Vec3 w{random.uniform(-300, 300), random.uniform(-300, 300), random.uniform(-300, 300)};
      set_motion(*s, c, {v.x * flip, v.y, v.z}, {w.x, w.y * flip, w.z * flip});
    }
    run_steps(*s, 300);
  }
  for (std::size_t c = 0; c < a.clumps.clumps.size(); ++c) {
    const Clump &p = clump(a, c), &q = clump(b, c);
    RC_ASSERT(norm(Vec3{-q.position.x, q.position.y, q.position.z} - p.position) < 1e-9 * 1e-2);
    RC_ASSERT(norm(Vec3{q.spin.x, -q.spin.y, -q.spin.z} - p.spin) < 1e-6 * 300);
  }
  // A mirrored grain is the same set of sites with other numbers: compare what does not depend on them.
  const EnergyReport ea = a.energy(), eb = b.energy();
  RC_ASSERT(std::abs(ea.bond_strain - eb.bond_strain) <= 1e-6 * ea.bond_strain);
  RC_ASSERT(std::abs(ea.slip - eb.slip) <= 1e-6 * ea.slip);
  RC_ASSERT(std::abs(ea.boundary_work - eb.boundary_work) <= 1e-6 * std::abs(ea.boundary_work));
  RC_ASSERT(ea.slip > 0.0);
}

}  // namespace
