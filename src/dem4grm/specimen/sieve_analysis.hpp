// SPDX-License-Identifier: BSD-3-Clause
// Simulated sieve analysis: the grains of a state, measured from their balls, through square openings.
//
//   gravel   the smallest square opening that the union of the pebbles passes in any orientation (grains/clump_sieve);
//            mass by the volume of the union
//   rubber   the edge of the cube of its solid volume (grains/rubber_size), by the radius of its balls: 5.899 r
//
// Nothing is taken from the size that a grain was meant to have. Shares are by mass: within one material that is by
// volume, together the densities count.
#pragma once

#include <span>
#include <vector>

#include "dem4grm/specimen/packing.hpp"
#include "dem4grm/specimen/settings.hpp"

namespace dem {

/// One grain as it was measured.
struct MeasuredGrain {
  double size = 0.0;    ///< m, square opening
  double volume = 0.0;  ///< m3, solid
};

struct MeasuredGrains {
  std::vector<MeasuredGrain> gravel, rubber;
};

/// Measures every grain of a packing. Densities in kg/m3: of the balls of a rubber grain and of solid rubber. Pebbles of
/// equal arrangement (distances and radii alike within 1e-9 after scaling) are searched once and scaled, so that six
/// shapes cost six searches of about 8 ms, whatever the number of grains.
MeasuredGrains measure_grains(const Packing& packing, double ball_density, double solid_density);

/// Mean size of all grains, weighted by volume, m; 0 without grains.
double mean_size(const MeasuredGrains& grains);

/// Fraction of the mass of the grains of one material that passes an opening, m. 0 for no grains.
double share_passing(std::span<const MeasuredGrain> grains, double opening);

/// Opening that a fraction of the mass passes, m: between the sizes of the two grains whose middle mass shares enclose
/// it, linear in size; the end sizes beyond. Throws InputError for no grains.
double opening_for_share(std::span<const MeasuredGrain> grains, double share);

/// What was asked for.
struct SieveInput {
  Grading gravel, rubber;        ///< without faults; empty for a material that is not there
  double gravel_density = 0.0;   ///< kg/m3
  double solid_density = 0.0;    ///< kg/m3, of rubber
  double rubber_content = 0.0;   ///< VRC by solid volume
  bool is_content_asked = true;  ///< false: numbers of grains were asked for, so the content is that of the grains
};

/// Shares that pass the sieves of a table, as fractions; empty for a material that is not there.
struct SieveColumn {
  std::vector<double> measured, asked;

  [[nodiscard]] bool is_there() const { return !measured.empty(); }
  /// Largest |measured - asked|, fraction.
  [[nodiscard]] double largest_difference() const;
};

struct SieveTable {
  std::vector<double> openings;  ///< m, ascending
  SieveColumn gravel, rubber, together;
};

/// The sieves of the input gradings, ascending, each once, m.
std::vector<double> usual_sieves(const MeasuredGrains& grains, const SieveInput& input);

/// The table for these openings (m, any order). Columns of materials without grains stay empty; `together` is there when
/// both materials are.
SieveTable sieve_table(const MeasuredGrains& grains, const SieveInput& input, std::vector<double> openings);

}  // namespace dem
