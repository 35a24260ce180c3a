// SPDX-License-Identifier: BSD-3-Clause
// From settings to a specimen ready for shear: grains, random fill, compression, final friction.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/specimen/fill.hpp"
#include "dem4grm/specimen/grain_list.hpp"
#include "dem4grm/specimen/rest.hpp"
#include "dem4grm/specimen/settings.hpp"
#include "dem4grm/walls/box_settings.hpp"

namespace dem {

/// Everything that decides a specimen.
struct SpecimenOrder {
  SpecimenSettings specimen;
  BoxSettings box;
  ServoSettings servo;
  EquilibriumSettings equilibrium;
  Scene materials;             ///< materials, bonds, contacts and integration; no grains, no walls
  double solid_density = 0.0;  ///< kg/m3 of rubber, for its solid volume
  double normal_stress = 0.0;  ///< Pa
  std::uint64_t seed = 1;
};

/// Milestones of a preparation, for the record.
struct SpecimenReport {
  double rubber_content = 0.0;  ///< VRC reached, fraction
  double void_ratio_generated = 0.0;
  double void_ratio_prepared = 0.0;  ///< at the normal stress, with the preparation friction
  double void_ratio_before_shear = 0.0;
  double height = 0.0;               ///< m, before shear
  double alignment_generated = 0.0;  ///< rubber_alignment after the fill
  double alignment_before_shear = 0.0;
  double fill_overlap = 0.0;  ///< largest, over the smaller radius
  int caught = 0;
  double mean_size = 0.0;     ///< m, volume-weighted mean grain size
  double mean_density = 0.0;  ///< kg/m3, volume-weighted density of the solids
  TimeStepLimit time_step;
  std::int64_t fill_steps = 0, compression_steps = 0, friction_steps = 0;
};

/// A specimen at rest under its normal stress with its final friction.
struct Specimen {
  std::unique_ptr<Simulation> simulation;
  PlateLoad load;
  GrainList grains;               ///< in the order of the clumps of the simulation
  std::vector<int> gravel_order;  ///< [n_clumps] number of each clump in the list that was drawn
  SpecimenReport report;
  Bounds bounds;
};

/// Where a preparation stands.
struct PreparationState {
  std::string stage;          ///< "fill", "compression", "final friction"
  double fraction = -1;       ///< of the fill; below 0 when the end cannot be foreseen
  RestState rest;             ///< of the stages after the fill
  double time_step = 0.0;     ///< s; 0 during the fill, where it changes
  bool is_new_stage = false;  ///< a stage has just been finished, the next one not begun
};

/// What a caller may do while a specimen is made.
struct PreparationHooks {
  /// Called every few hundred steps; `save` writes all that is needed to go on from here. May throw to stop.
  std::function<void(const PreparationState& now, const std::function<void(StateArchive&)>& save)> watch;
  /// What `save` wrote earlier, or null to begin at the beginning.
  StateArchive* resumed = nullptr;
};

/// Prepares a specimen. Throws InputError for grains that cannot be drawn, PhysicsError when a stage fails, IoError when
/// the state to go on from does not fit the order.
Specimen prepare_specimen(const SpecimenOrder& order, const PreparationHooks& hooks);

/// The specimen as it was saved, in whatever stage after the fill, without a step of its own. Throws IoError when the
/// state does not fit the order or was saved during the fill.
Specimen load_specimen(const SpecimenOrder& order, StateArchive& state);

/// Saves or loads a finished specimen; loading is left to prepare_specimen, which knows how to build one.
void exchange(StateArchive& archive, Specimen& specimen);

/// Largest overlap over the smaller radius beyond which a run is stopped as broken.
inline constexpr double k_overlap_limit = 1.2;

}  // namespace dem
