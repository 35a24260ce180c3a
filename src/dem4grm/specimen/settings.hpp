// SPDX-License-Identifier: BSD-3-Clause
// Settings of a specimen: gradings, contents and how it is prepared, in SI units.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/grains/clump_template.hpp"

namespace dem {

/// One line of a grading: share of the mass that passes a sieve.
struct GradingPoint {
  double size = 0.0;     ///< m, square opening
  double passing = 0.0;  ///< fraction of mass, 0 to 1
};
using Grading = std::vector<GradingPoint>;

/// Target of the search when a case names neither a relative density nor a preparation friction (Chew et al. 2022).
inline constexpr double k_default_relative_density = 0.5;

/// Relative density of the random fill between the laboratory's loosest and densest state of a mixture, fitted
/// to the void ratios of gravel alone and rubber alone (docs/decisions/0025-generation-density.md).
inline constexpr double k_default_generation_density = 0.35;

/// How the grains of the random fill come to their places (specimen/fill.hpp).
enum class Generation : std::uint8_t { grown, overlapping };

/// A clump shape of the user: pebbles in any frame and any unit of length, since only the shape counts.
struct ClumpShape {
  std::string name;
  std::vector<Pebble> pebbles;
};

struct SpecimenSettings {
  double rubber_content = 0.0;                 ///< VRC, fraction of the solid volume
  std::optional<double> relative_density;      ///< to be searched for, fraction
  std::optional<double> preparation_friction;  ///< of all contacts between grains while the plate compresses; no search
  double relative_density_tolerance = 0.02;    ///< absolute
  double smallest_friction = 0.0;              ///< of the branch that gives e_min
  double largest_friction = 2.0;               ///< of the branch that gives e_max
  double branch_stress_ratio = 0.9;            ///< stress at which the branches are compared over the normal stress
  double preparation_plate_friction = 0.0;     ///< of both plates until the final friction
  std::vector<double> load_steps;              ///< Pa, rising: rest under these on the way to the normal stress
  Grading gravel_grading, rubber_grading;      ///< read from the files named in the case
  std::string gravel_grading_file, rubber_grading_file;
  std::vector<ClumpShape> clump_templates;  ///< shapes beside the shipped ones
  std::string clump_templates_file;
  std::vector<std::string> clump_shapes{"T1", "T2", "T3", "T4", "T5", "T6"};
  std::vector<double> clump_shares;  ///< of the gravel's volume, one for each of clump_shapes; empty: equal
  std::optional<int> gravel_clumps;  ///< explicit count instead of the one from the box volume
  std::optional<int> rubber_grains;
  std::optional<double> expected_void_ratio;  ///< sets the number of grains; default by rubber content
  Generation generation = Generation::grown;
  double generation_relative_density = k_default_generation_density;  ///< of the random fill, in the laboratory's range
  std::optional<double> generation_void_ratio;                        ///< of the random fill, in place of that
  double generation_friction = 0.0;
  double approach_speed = 0.05;             ///< m/s, largest speed of the plate before shear
  double approach_inertial_number = 0.003;  ///< in branches the plate may go as fast as this, too
};

}  // namespace dem
