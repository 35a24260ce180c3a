// SPDX-License-Identifier: BSD-3-Clause
// Everything that a case file can say, in SI units, with the published values as defaults.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/engine/settings.hpp"
#include "dem4grm/grains/material.hpp"
#include "dem4grm/specimen/settings.hpp"
#include "dem4grm/walls/box_settings.hpp"

namespace dem {

/// Of a test whose velocity is to be chosen: half the published limit.
inline constexpr double k_default_inertial_number = 5e-5;

struct ShearSettings {
  double normal_stress = 0.0;               ///< Pa
  std::optional<double> velocity = 0.002;   ///< m/s, of the halves against each other; nothing: by the inertial number
  std::optional<double> inertial_number{};  ///< that a velocity is chosen for; nothing: k_default_inertial_number
  double displacement = 0.014;              ///< m
  MovingHalf moving_half = MovingHalf::lower;
};

struct RecordingSettings {
  double interval = 1e-5;                    ///< m of displacement over which a row of shear.csv is averaged
  double frame_interval = 2e-3;              ///< m of displacement between full states
  std::vector<double> extra_frames{0.2e-3};  ///< m, further full states
  double micro_interval = 0.2e-3;            ///< m of displacement between rows of micro.csv
};

/// A direct shear test from grading to curves.
struct DirectShearCase {
  std::string name = "direct_shear";
  std::uint64_t seed = 1;
  SpecimenSettings specimen;
  BoxSettings box;
  MaterialSettings gravel{2710.0, 0.72, 90e6, 0.3};
  MaterialSettings rubber{1610.0, 0.27, 12e6, 0.5};
  double rubber_solid_density = 1150.0;  ///< kg/m3; solid volume of a grain = mass / this
  MaterialSettings walls{0.0, 0.70, 80e9, 0.25};
  BondSettings bond;
  ContactSettings contact;
  IntegrationSettings integration;
  ServoSettings servo;
  EquilibriumSettings equilibrium;
  ShearSettings shear;
  RecordingSettings recording;
};

/// One rubber grain between two plates.
struct GrainCompressionCase {
  std::string name = "grain_compression";
  double ball_radius = 0.627e-3;  ///< m
  MaterialSettings rubber{1610.0, 0.27, 12e6, 0.5};
  MaterialSettings walls{0.0, 0.70, 80e9, 0.25};
  BondSettings bond;
  ContactSettings contact;
  IntegrationSettings integration;
  double plate_velocity = 0.02;  ///< m/s, of each plate
  double strain = 0.45;          ///< of the grain's outer height
  int records = 100;             ///< rows of the curve
};

}  // namespace dem
