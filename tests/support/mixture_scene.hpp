// SPDX-License-Identifier: BSD-3-Clause
// A small shear box with gravel clumps and rubber grains under a servo plate, for tests of bits and symmetries.
#pragma once

#include <array>
#include <string>

#include "dem4grm/core/random.hpp"
#include "dem4grm/walls/shear_box.hpp"
#include "support/scene_builder.hpp"

namespace dem::test {

struct MixtureOptions {
  std::array<int, 3> cells{7, 5, 4};
  ContactSettings contact;
  BondForm form = BondForm::history_free;
  double spring_friction = 0.0;
  double margin_factor = 1.0;
  int rebuild_every = 0;  ///< 0: when the engine wants it
  double reserve = NearPairs{}.reserve;
  bool tunes = true;  ///< the horizon of the lists
  std::uint64_t seed = 1;
  Vec3 shift;  ///< m, of everything
};

inline constexpr double k_cell = 4.3e-3;  // m

inline BoxSettings mixture_box(const MixtureOptions& o) {
  BoxSettings b;
  b.length = o.cells[0] * k_cell;
  b.width = o.cells[1] * k_cell;
  b.height = o.cells[2] * k_cell;
  b.upper_height = 1.5 * b.height;
  b.wing = 0.01;
  return b;
}

/// Clumps of all six shapes and rubber grains, three to one, at random orientations, one in each cell of a grid (105
/// and 35 by default); neighbours touch within a few hundred steps.
inline Scene mixture_scene(const MixtureOptions& o = {}) {
  Scene scene = model_scene();
  scene.integration.local_damping = 0.2;
  scene.contact = o.contact;
  scene.bond.form = o.form;
  scene.bond.spring_friction = o.spring_friction;
  scene.rubber_ball_radius = 0.5e-3;
  scene.shapes = standard_clump_templates();
  const BoxSettings box = mixture_box(o);
  scene.wall_list = ShearBox(box, box.height + 0.1e-3).walls();
  scene.wall_list[ShearBox::k_bottom_plate].friction = scene.wall_list[ShearBox::k_top_plate].friction = 0.7;
  for (Wall& w : scene.wall_list) w.corner += o.shift;
  int cell = 0;
  for (int z = 0; z < o.cells[2]; ++z) {
    for (int y = 0; y < o.cells[1]; ++y) {
      for (int x = 0; x < o.cells[0]; ++x, ++cell) {
        RandomSequence random(o.seed, RandomStream::test, static_cast<std::uint64_t>(cell));
        const Quaternion q = random.orientation();
        const Vec3 jitter{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const Vec3 at = Vec3{(x + 0.5) * k_cell, (y + 0.5) * k_cell, (z + 0.5) * k_cell} + jitter * 5e-5 + o.shift;
        if (cell % 4 == 1) {
          scene.grains.push_back({at, q});
        } else {
          scene.clumps.push_back({cell % 6, random.uniform(3.4e-3, 4.2e-3), {at, q}, k_gravel});
        }
      }
    }
  }
  return scene;
}

/// Runs the box: the plate presses with 100 kPa, the lower half moves at 0.5 m/s.
inline Simulation run_mixture(const MixtureOptions& o, int steps) {
  Simulation s(mixture_scene(o));
  const BoxSettings box = mixture_box(o);
  s.margins.least *= o.margin_factor;
  s.margins.horizon *= o.margin_factor;
  s.near.reserve = o.reserve;
  s.margins.tunes = o.tunes;
  s.set_time_step(1e-6);
  s.servo = {ShearBox::k_top_plate, 100e3 * box.length * box.width, 0.5, 1.0};
  for (int k = 0; k < steps; ++k) {
    if (o.rebuild_every > 0 && k % o.rebuild_every == 0) s.invalidate_candidates();
    ShearBox::set_velocities(s.walls, MovingHalf::lower, 0.5, s.walls[ShearBox::k_top_plate].velocity.z);
    s.step();
  }
  return s;
}

/// Enough for every kernel to be used, few enough for an emulated processor.
inline constexpr int k_few_steps = 40;

/// Hashes of a set of runs that together use every branch of the kernels, one line each; compared between builds.
inline std::string all_mixture_hashes(int steps) {
  std::string text;
  for (const int mode : {0, 1}) {
    for (const BondForm form : {BondForm::history_free, BondForm::incremental}) {
      MixtureOptions o;
      o.form = form;
      o.contact.hz_mode = mode;
      o.contact.normal_damping_ratio = 0.1 * mode;
      o.contact.shear_damping_ratio = 0.05 * mode;
      o.contact.dashpot_mode = 3 * mode;
      text += run_mixture(o, steps).state_hash() + "\n";
    }
  }
  return text;
}

}  // namespace dem::test
