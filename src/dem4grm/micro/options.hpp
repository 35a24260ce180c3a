// SPDX-License-Identifier: BSD-3-Clause
// The choices that an analysis of a contact network leaves open, with the defaults of the published model.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>

namespace dem {

/// What a mean normal or tangential force is: of the means of the bins (orientations) or of the contacts.
enum class ForceMean : std::uint8_t { orientations, contacts };
/// What counts as one contact: every contact of two balls, or all contacts of two bodies together.
enum class ContactLevel : std::uint8_t { contact, pair };
/// What is compared with its own mean to call a contact strong.
enum class StrongMeasure : std::uint8_t { normal_force, magnitude };
/// Which contacts are projected on the shear plane: all, or those with |n_y| < 0.5.
enum class Projection : std::uint8_t { all, near_plane };

inline constexpr double k_near_plane = 0.5;  ///< largest |n_y| of Projection::near_plane

struct MicroOptions {
  int bins = 36;  ///< of the full circle, even; 36 is a width of 10 degrees
  ForceMean force_mean = ForceMean::orientations;
  ContactLevel level = ContactLevel::contact;
  StrongMeasure strong = StrongMeasure::normal_force;
  Projection projection = Projection::all;
  int resamples = 0;       ///< of the bootstrap; 0: no bands
  std::uint64_t seed = 1;  ///< of the bootstrap

  /// Width of a bin, rad.
  [[nodiscard]] double bin_width() const { return 2.0 * std::numbers::pi / bins; }
};

/// Fewest bins: wider ones would let the eighth harmonic pass for the fourth. Most: finer than any data.
inline constexpr int k_fewest_bins = 18, k_most_bins = 720;
/// Most resamples of a bootstrap; beyond it nothing is learned.
inline constexpr int k_most_resamples = 100000;

/// Empty when the options make sense, else one sentence.
inline std::string problem_of(const MicroOptions& o) {
  if (o.bins % 2 != 0 || o.bins < k_fewest_bins || o.bins > k_most_bins) {
    return "the number of bins of the circle must be even, from 18 to 720";
  }
  if (o.resamples < 0 || o.resamples > k_most_resamples) return "the number of resamples must be from 0 to 100000";
  return {};
}

}  // namespace dem
