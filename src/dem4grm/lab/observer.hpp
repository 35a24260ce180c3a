// SPDX-License-Identifier: BSD-3-Clause
// What a test tells the outside while it runs. The lab declares it; files, progress lines and tests implement it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

/// Where a running test stands. SI units; values that a stage does not have are 0.
struct Progress {
  std::string stage;           ///< as in PreparationState, then "shear"
  double fraction = 0.0;       ///< of this stage, 0 to 1; below 0 when the end cannot be foreseen
  double displacement = 0.0;   ///< m
  double shear_stress = 0.0;   ///< Pa
  double normal_stress = 0.0;  ///< Pa
  double void_ratio = 0.0;
  double inertial_number = 0.0;
  double shear_velocity = 0.0;  ///< m/s, prescribed
  double unbalanced_ratio = 0.0;
  std::int64_t steps = 0;           ///< of this stage
  double time_step = 0.0;           ///< s
  double steps_to_last_stage = -1;  ///< estimate; below 0 when unknown
};

/// How shear stress and rise of the plate go together over a window of the record; not a number while it has but one row.
/// formula:  shear_ratio = tau / sigma_n,  rate = dv / du,  friction = shear_ratio - rate
///   tau, sigma_n  means over the window, Pa; over the area that is left they have the same quotient
///   v, u          rise of the plate and displacement of the halves, m; slope of least squares
/// Source: Taylor (1948). The work tau du of shear is spent in part on the rise of the load, sigma_n dv; what is left is
/// friction of the grains. shear_ratio falls behind at the same pace as rate, since both look at one window.
struct Dilatancy {
  double shear_ratio = 0.0;
  double rate = 0.0;  ///< dilation positive
  double friction = 0.0;
};

/// One row of the record of a shear test: means over one interval of displacement, SI units. Compression and dilation
/// (plate rising) positive. Doubles only: a checkpoint holds the rows as they lie in memory.
struct ShearRow {
  double displacement = 0.0;            ///< m, relative displacement of the halves at the end of the interval
  double shear_stress = 0.0;            ///< Pa, net x-force on the walls of the lower half over the nominal area
  double shear_stress_corrected = 0.0;  ///< Pa, over the area that is left
  double normal_stress = 0.0;           ///< Pa, force on the top plate over the nominal area
  double vertical_displacement = 0.0;   ///< m, of the top plate since shear began
  double void_ratio = 0.0;
  double inertial_number = 0.0;
  double unbalanced_ratio = 0.0;
  double half_force_difference = 0.0;    ///< Pa, (lower half minus upper half) over the nominal area
  double normal_stress_worst = 0.0;      ///< Pa, the single step farthest from the target
  double plate_shear_stress = 0.0;       ///< Pa, share of the lower half's shear stress that its plate carries
  double time_step = 0.0;                ///< s, at the end of the interval
  double normal_stress_corrected = 0.0;  ///< Pa, over the area that is left
  Dilatancy dilatancy;                   ///< over the last k_dilatancy_window
  EnergyReport energy;                   ///< J, since shear began
  std::array<Vec3, ShearBox::k_walls> wall_force{};  ///< N, of the grains on each wall of the box
};

/// One row of a grain compression test: means over one interval, SI units.
struct CompressionRow {
  double strain = 0.0;         ///< approach of the plates over the outer height of the grain
  double displacement = 0.0;   ///< m, approach of the plates
  double load = 0.0;           ///< N, mean of both plates
  double poisson_ratio = 0.0;  ///< of the inner cube of eight balls, secant
  int closed_second_neighbours = 0;
  EnergyReport energy;
};

/// The micro-mechanics at a displacement, with the default options of an analysis. Doubles only: a checkpoint holds the rows
/// as they lie in memory.
struct MicroRow {
  double displacement = 0.0;  ///< m
  MicroNumbers numbers;
};

/// A full state at a displacement.
struct FrameInfo {
  int number = 0;
  double displacement = 0.0;  ///< m
  std::string state_hash;
};

/// What a test that goes on from a checkpoint has behind it.
struct ResumedRun {
  std::span<const ShearRow> rows;
  std::span<const FrameInfo> frames;
  std::span<const MicroRow> micro_rows;
  EnergyReport start_energy;  ///< J, when shear began
};

class LabObserver {
 public:
  LabObserver() = default;
  LabObserver(const LabObserver&) = delete;
  LabObserver& operator=(const LabObserver&) = delete;
  virtual ~LabObserver() = default;

  virtual void progress(const Progress& /*now*/) {}
  virtual void note(const std::string& /*text*/) {}
  virtual void warning(const std::string& /*text*/) {}
  virtual void shear_row(const ShearRow& /*row*/) {}
  virtual void compression_row(const CompressionRow& /*row*/) {}
  virtual void micro_row(const MicroRow& /*row*/) {}
  virtual void frame(const Simulation& /*state*/, const FrameInfo& /*info*/) {}

  /// Asked at every point from which a test could go on; is_new_stage: a stage has just ended.
  virtual bool wants_checkpoint(bool /*is_new_stage*/) { return false; }
  /// All that is needed to go on from here. May throw to stop the test.
  virtual void checkpoint(const StateArchive& /*state*/) {}
  /// The complete state after the last step of shear, from which a longer test may go on. Asked before it is made.
  virtual bool wants_end_state() { return false; }
  virtual void end_state(const StateArchive& /*state*/) {}
  /// Once, before anything else, when shear goes on from a checkpoint.
  virtual void resumed(const ResumedRun& /*past*/) {}

  /// States of preparations, kept for later ones (PreparationHooks::fetch and keep).
  virtual std::optional<StateArchive> fetch_preparation(const std::string& /*name*/) { return std::nullopt; }
  virtual void keep_preparation(const std::string& /*name*/, const StateArchive& /*state*/) {}
  /// The finished specimen, before the first step of shear, from which any shear stage may start.
  virtual void specimen_ready(const StateArchive& /*state*/, const SpecimenReport& /*report*/) {}
  /// False ends the test with the specimen.
  virtual bool wants_shear() { return true; }
};

}  // namespace dem
