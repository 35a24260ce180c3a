// SPDX-License-Identifier: BSD-3-Clause
// All micro-mechanical quantities of a state in one go. Runs on one thread: the same bits on any machine of one kind.
//
//     const dem::MicroAnalysis m = dem::analyse(dem::micro_state_of(simulation), {});
//     m.numbers.of_all().normal_amplitude;   // a_n
#pragma once

#include <array>

#include "dem4grm/micro/bootstrap.hpp"
#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/force_anisotropy.hpp"
#include "dem4grm/micro/options.hpp"
#include "dem4grm/micro/rubber_strain.hpp"
#include "dem4grm/micro/tensor.hpp"

namespace dem {

/// What an analysis reads: from a simulation here, from a stored state in results.
struct MicroState {
  ContactNetwork network;
  RubberState rubber;
};
MicroState micro_state_of(const Simulation& s);

/// Sets of contacts that an analysis looks at: all, then the kinds in the order of PairKind.
inline constexpr std::size_t k_contact_sets = 1 + k_pair_kinds;
inline constexpr std::array<const char*, k_contact_sets> k_set_names{"all", "g-g", "g-r", "r-r"};

/// Of one set of contacts, SI units, angles in rad; not a number where the set is too small. Doubles only: a record of
/// them is saved as it lies in memory.
struct SetNumbers {
  double contacts = 0.0;
  double normal_force = 0.0;               ///< N, mean over the contacts
  double normal_force_orientations = 0.0;  ///< N, mean over the orientations
  double shear_force = 0.0;                ///< N, mean over the contacts
  double shear_force_orientations = 0.0;   ///< N, mean over the orientations
  double fabric_amplitude = 0.0;           ///< a
  double fabric_direction = 0.0;           ///< theta_a, [0, pi)
  double fabric_residual = 0.0;            ///< root mean square of histogram minus curve over the mean
  double fabric_noise = 0.0;               ///< isotropy_bound
  double fabric_direction_error = 0.0;     ///< standard error of theta_a
  double normal_amplitude = 0.0;           ///< a_n
  double normal_direction = 0.0;           ///< theta_n, [0, pi)
  double normal_residual = 0.0;
  double shear_amplitude = 0.0;  ///< a_t
  double shear_direction = 0.0;  ///< theta_t, [0, pi/2)
  double shear_residual = 0.0;
  double shear_second_amplitude = 0.0;  ///< a_t2
  double shear_second_direction = 0.0;  ///< theta_t2, [0, pi)
  double signed_shear_amplitude = 0.0;  ///< a_s
  double signed_shear_direction = 0.0;  ///< theta_s, [0, pi)
  double signed_shear_fourth = 0.0;
  double signed_shear_residual = 0.0;
  double empty_bins = 0.0;         ///< of the half circle
  double sliding = 0.0;            ///< share of the contacts at their Coulomb limit
  double bulk_friction = 0.0;      ///< sum |f_t| / sum |f_n|
  double strong_share = 0.0;       ///< of this set among the strong contacts
  double strong_load_share = 0.0;  ///< of this set in the load of the strong contacts
};

/// Of a state, SI units. Doubles only, as above.
struct MicroNumbers {
  std::array<SetNumbers, k_contact_sets> sets;
  double strong_threshold = 0.0;  ///< N
  double strong_fraction = 0.0;   ///< of strong contacts among all
  double strong_load = 0.0;       ///< share of the load that they carry
  double strong_spans = 0.0;      ///< 1 when they lead from plate to plate
  double strong_clusters = 0.0;
  double strong_largest_cluster = 0.0;  ///< share of the bodies
  double zone = 0.0;                    ///< Zone
  double zone_margin = 0.0;             ///< in standard errors
  double coordination = 0.0, coordination_pairs = 0.0, coordination_mechanical = 0.0;
  double rattlers = 0.0, rattlers_gravel = 0.0, rattlers_rubber = 0.0;                         ///< shares
  double stress_xx = 0.0, stress_yy = 0.0, stress_zz = 0.0, stress_xz = 0.0, stress_zx = 0.0;  ///< Pa, of the contacts
  double boundary_zz = 0.0, boundary_xz = 0.0;                                                 ///< Pa, of the walls
  double plate_stress = 0.0;            ///< Pa, force on the top plate over the area
  double stress_difference = 0.0;       ///< largest component of contact minus boundary stress over the plate stress
  double stress_direction = 0.0;        ///< rad, major axis in the shear plane, [0, pi)
  double stress_ratio = 0.0;            ///< q/p of the contact stress
  double stress_ratio_of_fabric = 0.0;  ///< q/p that fabric and force anisotropy give
  double fabric_direction_spatial = 0.0, fabric_amplitude_spatial = 0.0;  ///< of the fabric tensor, projected
  double bond_strain = 0.0, bond_strain_deviation = 0.0, bond_strain_p05 = 0.0, bond_strain_p50 = 0.0,
         bond_strain_p95 = 0.0;
  double bond_strain_compressed = 0.0, bonds_compressed = 0.0;  ///< of the bonds under compression, and their share
  double bond_strain_at_gravel = 0.0, bond_strain_at_rubber = 0.0;
  double grain_strain_major = 0.0, grain_strain_vertical = 0.0;
  double bond_force = 0.0, bond_force_size = 0.0;  ///< N
  double bond_moment = 0.0;                        ///< N m
  double volume_strain = 0.0, volume_strain_deviation = 0.0;
  double aspect_ratio = 0.0, aspect_ratio_p95 = 0.0;
  double closed_second_neighbours = 0.0;

  [[nodiscard]] const SetNumbers& of_all() const { return sets.front(); }
};

/// The numbers and what they were read from.
struct MicroAnalysis {
  MicroNumbers numbers;
  MicroOptions options;
  std::array<PolarHistogram, k_contact_sets> histograms;
  std::array<AnisotropyBands, k_contact_sets> bands;  ///< not a number without resamples
  Tensor3 fabric, strong_fabric, weak_fabric;         ///< <n n> of all, strong and weak contacts
};

/// The options must have no problem (problem_of).
MicroAnalysis analyse(const MicroState& state, const MicroOptions& options);

}  // namespace dem
