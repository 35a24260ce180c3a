// SPDX-License-Identifier: BSD-3-Clause
// What a simulation is built from: materials, shapes, where every grain lies, and the walls.
#pragma once

#include <vector>

#include "dem4grm/core/lanes.hpp"
#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/engine/settings.hpp"
#include "dem4grm/grains/clump_template.hpp"
#include "dem4grm/grains/material.hpp"
#include "dem4grm/laws/mixing.hpp"
#include "dem4grm/walls/wall.hpp"

namespace dem {

enum Material : unsigned char { k_gravel = 0, k_rubber = 1 };
inline constexpr int k_materials = 2;

/// Rubber grains of one size in a run: a multiple of every pack width, so that a block holds one size.
inline constexpr int k_grains_of_one_size = 8;

struct Pose {
  Vec3 position;  ///< m
  Quaternion orientation;
};

/// A clump to be placed: a template scaled to a sieve size.
struct PlacedClump {
  int shape = 0;      ///< index into Scene::shapes
  double size = 0.0;  ///< m
  Pose pose;
  Material material = k_gravel;
};

struct Scene {
  MaterialSettings gravel, rubber, walls;
  BondSettings bond;
  ContactSettings contact;
  IntegrationSettings integration;
  Vec3 gravity;  ///< m/s2, acts on every grain; a shear test has none

  double rubber_ball_radius = 0.0;  ///< m, of the rubber grains; of the reference size when there are several
  /// [grains] m; empty: all have the reference size. Grains come in runs of k_grains_of_one_size of equal radius (the
  /// last run may be shorter). Smaller grains than the reference get a density that leaves the time step alone.
  std::vector<double> rubber_ball_radii;
  std::vector<Pose> grains;  ///< bonded rubber grains at rest, pose of the grain's cube axes
  std::vector<ClumpTemplate> shapes;
  std::vector<PlacedClump> clumps;
  std::vector<Wall> wall_list;
};

inline const MaterialSettings& settings_of(const Scene& scene, Material m) {
  return m == k_rubber ? scene.rubber : scene.gravel;
}

DEM_INLINE bool has_gravity(const Scene& scene) { return dot(scene.gravity, scene.gravity) > 0.0; }

inline Elastic elastic(const MaterialSettings& m) { return {m.shear_modulus, m.poisson_ratio}; }

}  // namespace dem
