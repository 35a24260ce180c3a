// SPDX-License-Identifier: BSD-3-Clause
// The random fill: grains at random places and in random orientations, grown to full size in the closed box, or placed
// with their full size whatever they overlap.
//
// Grains start at a fraction of their size, at random and without touching, and grow in small steps; after each step
// they push each other apart without friction, with their velocities reset. Because no grain ever lies deep inside
// another, none can be caught or interlocked, which the other way, Generation::overlapping, cannot promise: its grains
// push each other apart from wherever they were put, and what stays caught is counted. Rubber grains
// are rigid clumps of 35 balls meanwhile and are bonded afterwards, at rest. The box has the height that gives the
// generation void ratio; that void ratio is looser than a frictionless packing can carry load at, so the fill ends
// almost without forces.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dem4grm/engine/scene.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/specimen/grain_list.hpp"
#include "dem4grm/specimen/settings.hpp"
#include "dem4grm/walls/box_settings.hpp"

namespace dem {

struct FillSettings {
  double void_ratio = 0.7;
  double friction = 0.0;
  std::uint64_t seed = 1;
  Generation generation = Generation::grown;
  double start_scale = 0.55;  ///< first size over final size
  double growth = 0.005;      ///< of the final size per growth step
  int steps_per_growth = 60;  ///< time steps after each growth step
  int steps_per_reset = 400;  ///< time steps between velocity resets while the full-size grains relax
  int steps_per_calm = 20;    ///< the same while overlaps are larger than growth_overlap
  int steps_per_calm_deep =
      1;  ///< and while they are larger than deep_overlap: pushed from rest, no grain passes another
  double deep_overlap = 0.5;     ///< over the smaller radius
  double growth_overlap = 0.05;  ///< largest overlap over the smaller radius before the next growth step
  int most_steps_per_growth = 6000;
  double overlap_goal = 5e-3;  ///< largest overlap over the smaller radius when the fill counts as relaxed
  int most_relaxation_steps = 100000;
};

/// Where the grains ended, and how good the fill is.
struct Fill {
  std::vector<Pose> gravel;      ///< [GrainList::gravel]
  std::vector<Pose> rubber;      ///< [GrainList::rubber_count]
  double height = 0.0;           ///< m, of the plate
  double largest_overlap = 0.0;  ///< over the smaller radius
  int caught = 0;                ///< ball centres inside another grain's ball; must be 0
  double alignment = 0.0;        ///< rubber_alignment of engine/observe.hpp
  int steps = 0;
};

/// Where a fill stands between two of its parts; with the simulation all that is needed to go on.
struct FillState {
  int growth_steps = 0;      ///< done
  int relaxation_steps = 0;  ///< time steps since the grains have their full size
  int steps = 0;             ///< time steps in all
  bool is_relaxed = false;
};

/// What a caller may do while a fill is made; each may be empty.
struct FillHooks {
  /// Called between two parts with the share done, 0 to 1. May throw to stop.
  std::function<void(double share, FillState& state, Simulation& s)> between;
  /// Called once before the first part; may load an earlier state.
  std::function<void(FillState& state, Simulation& s)> restore;
};

/// Makes the fill. materials: a scene whose materials, contact and bond settings are used. Throws PhysicsError when the
/// grains do not fit the box or do not come to rest.
Fill make_fill(const GrainList& grains, const BoxSettings& box, const Scene& materials, const FillSettings& settings,
               const FillHooks& hooks);

}  // namespace dem
