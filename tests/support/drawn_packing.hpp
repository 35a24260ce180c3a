// SPDX-License-Identifier: BSD-3-Clause
// The grains that a case draws, without a simulation: apart from each other, turned at random, in the walls of the box.
#pragma once

#include "dem4grm/core/random.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem::test {

/// One grain in each cell of a cubic grid of 20 mm. The grains do not lie inside the walls.
inline Scene drawn_scene(const DirectShearCase& test) {
  const GrainList grains =
      draw_grains(test.specimen, test.box, test.rubber.density, test.rubber_solid_density, test.seed);
  Scene scene = materials_of(test);
  scene.shapes = grains.shapes;
  scene.rubber_ball_radius = grains.rubber_ball_radius;
  scene.rubber_ball_radii = grains.rubber_radii;
  scene.wall_list = ShearBox(test.box, test.box.height).walls();
  int cell = 0;
  const auto next_pose = [&] {
    RandomSequence random(5, RandomStream::test, static_cast<std::uint64_t>(cell));
    const int x = cell % 20, y = cell / 20 % 20, z = cell / 400;
    const Vec3 at{x * 0.02, y * 0.02, z * 0.02};
    ++cell;
    return Pose{at, random.orientation()};
  };
  for (const GravelGrain& grain : grains.gravel) {
    scene.clumps.push_back({grain.shape, grain.sieve_size, next_pose(), k_gravel});
  }
  for (int g = 0; g < grains.rubber_count; ++g) scene.grains.push_back(next_pose());
  return scene;
}

}  // namespace dem::test
