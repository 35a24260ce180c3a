// SPDX-License-Identifier: BSD-3-Clause
// From settings to a specimen ready for shear: grains, random fill, search for the friction that gives the relative
// density, compression, final friction.
//
// Every branch of the search starts from the same fill, is compressed by the top plate with its own friction and comes
// to rest under a part of the normal stress (Chew et al. 2022: 90 %), where its void ratio is read. The branch that has
// the density asked for goes on to the normal stress. On the way a specimen may come to rest under smaller stresses, as
// load steps in a laboratory: then a test at a larger stress begins with the states of one at a smaller stress, which a
// store can hand over without changing a bit.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/specimen/density_search.hpp"
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
  double preparation_friction = 0.0;  ///< as given or found
  std::vector<Branch> branches;       ///< e_min, e_max, trials; empty without a search
  double void_ratio_prepared = 0.0;   ///< at the normal stress, with the preparation friction
  double void_ratio_before_shear = 0.0;
  double height = 0.0;               ///< m, before shear
  double split_height = 0.0;         ///< m, of the plane at which the halves part
  double alignment_generated = 0.0;  ///< rubber_alignment after the fill
  double alignment_before_shear = 0.0;
  double fill_overlap = 0.0;  ///< largest, over the smaller radius
  int caught = 0;
  double mean_size = 0.0;     ///< m, volume-weighted mean grain size
  double mean_density = 0.0;  ///< kg/m3, volume-weighted density of the solids
  TimeStepLimit time_step;
  std::int64_t fill_steps = 0, branch_steps = 0, compression_steps = 0, friction_steps = 0;

  /// Of the branch that was chosen, at the stress of the branches; none without a search.
  [[nodiscard]] std::optional<double> relative_density_reached() const;
  /// Steps of the branches that the specimen itself did not go through.
  [[nodiscard]] std::int64_t other_branch_steps() const {
    return branches.empty() ? 0 : branch_steps - branches.back().steps;
  }
};

/// A specimen at rest under its normal stress with its final friction.
struct Specimen {
  std::unique_ptr<Simulation> simulation;
  PlateLoad load;
  GrainList grains;               ///< in the order of the clumps of the simulation
  std::vector<int> gravel_order;  ///< [n_clumps] number of each clump in the list that was drawn
  SpecimenReport report;
};

/// What to do about it: a sentence that begins with a capital letter, or nothing.
std::string advice_for(const Trouble& trouble, const BoxSettings& box, const std::vector<Wall>& walls);

/// Where a preparation stands.
struct PreparationState {
  std::string stage;       ///< "fill", "e_min (friction 0)", "trial 1 (friction 0.1)", "compression", "final friction"
  double fraction = -1;    ///< of the fill; below 0 when the end cannot be foreseen
  RestState rest;          ///< of the stages after the fill, its steps counted from the beginning of the stage
  double time_step = 0.0;  ///< s; 0 during the fill, where it changes
  double steps_left = -1;  ///< estimate of the steps until shear, all branches included; below 0 when unknown
  bool is_new_stage = false;  ///< a stage has just been finished, the next one not begun
};

/// What a caller may do while a specimen is made.
struct PreparationHooks {
  /// Called every few hundred steps; `save` writes all that is needed to go on from here. May throw to stop.
  std::function<void(const PreparationState& now, const std::function<void(StateArchive&)>& save)> watch;
  /// What `save` wrote earlier, or null to begin at the beginning.
  StateArchive* resumed = nullptr;
  /// A state that an earlier preparation of the same materials, box and seed kept under that name, or nothing.
  std::function<std::optional<StateArchive>(const std::string& name)> fetch;
  /// Keeps a state for later preparations: the fill, and every branch at rest under each of its stresses.
  std::function<void(const std::string& name, const StateArchive& state)> keep;
  /// Told what a branch gave.
  std::function<void(const std::string& text)> note;
};

/// Prepares a specimen. Throws InputError for grains that cannot be drawn, PhysicsError when a stage fails, IoError when
/// the state to go on from does not fit the order.
Specimen prepare_specimen(const SpecimenOrder& order, const PreparationHooks& hooks);

/// The specimen as it was saved, in whatever stage after the fill, without a step of its own. Throws IoError when the
/// state does not fit the order or was saved during the fill.
Specimen load_specimen(const SpecimenOrder& order, StateArchive& state);

/// Makes a saved state, in whatever stage from the compression on, one whose specimen must come to rest under the normal stress
/// of the order that it is given to next; a finished specimen does so with its final friction.
void rest_under_other_stress(std::vector<StateEntry>& state);

/// Saves or loads a finished specimen; loading is left to prepare_specimen, which knows how to build one.
void exchange(StateArchive& archive, Specimen& specimen);
void exchange(StateArchive& archive, std::vector<Branch>& branches);
void exchange(StateArchive& archive, RestState& rest);
void exchange(StateArchive& archive, FillState& fill);
/// A finished fill with the numbering of its gravel grains.
void exchange(StateArchive& archive, Fill& fill);

/// Largest overlap over the smaller radius beyond which a run is stopped as broken.
inline constexpr double k_overlap_limit = 1.2;

}  // namespace dem
