// SPDX-License-Identifier: BSD-3-Clause
// Bringing a specimen to rest under its plate.
#pragma once

#include <functional>
#include <string>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// The plate that loads a specimen.
struct PlateLoad {
  int wall = 0;               ///< index of the plate
  double area = 0.0;          ///< m2
  double stress = 0.0;        ///< Pa, compression positive
  double speed_cap = 0.0;     ///< m/s
  double gain = 0.5;          ///< of the servo
  double solid_volume = 0.0;  ///< m3, for the void ratio
  /// m/s over the root of Pa: faster than speed_cap up to this times the root of the stress that has been reached, since
  /// a specimen bears more speed the firmer it is pressed together.
  double speed_of_stress = 0.0;
};

/// A layer of grains that a plate compresses.
struct Layer {
  double height = 0.0;     ///< m
  double mean_size = 0.0;  ///< m, of the grains
  double density = 0.0;    ///< kg/m3, of the solids
};

/// formula:  v = I height sqrt(stress / density) / D
/// Speed of the plate, m/s, at which the layer is compressed with the inertial number I = (v / height) D sqrt(density /
/// stress), the rate of strain over the rate at which grains of size D fall into place under that stress.
double plate_speed_at(double inertial_number, const Layer& layer, double stress);

/// How far a specimen is from rest.
struct RestState {
  std::int64_t steps = 0;         ///< since the stage began
  int held = 0;                   ///< steps in a row for which all criteria held
  double stress = 0.0;            ///< Pa, of the plate
  double plate_speed = 0.0;       ///< m/s, mean over the last check interval, up positive
  double unbalanced_ratio = 0.0;  ///< mean net force on a body over mean contact force
  double void_ratio = 0.0;
};

/// The plate's largest speed while it carries this stress (Pa, at most the target counts), m/s.
double speed_cap_at(const PlateLoad& load, double stress);

/// Stress on the plate, Pa, compression positive.
double plate_stress(const Simulation& s, const PlateLoad& load);
/// Void ratio from the height of the plate: area * height / solid volume - 1.
double plate_void_ratio(const Simulation& s, const PlateLoad& load);

/// Steps between two looks at the criteria and at the watchdog.
inline constexpr int k_rest_interval = 100;

/// Runs until every criterion of the settings has held for hold_steps, from `now` on (a fresh one, or where an earlier
/// call was left). `watch` is called every k_rest_interval steps, when `now` and the simulation are all that is needed to
/// go on, and may throw. Throws PhysicsError after most_steps, with the criterion that was not met.
void bring_to_rest(Simulation& s, const PlateLoad& load, const EquilibriumSettings& settings, RestState& now,
                   const std::function<void()>& watch);

}  // namespace dem
