// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/micro/analysis.hpp"

#include <cmath>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/micro/connectivity.hpp"
#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/stress_tensor.hpp"
#include "dem4grm/micro/strong_network.hpp"

namespace dem {
namespace {

SetNumbers numbers_of_set(std::span<const Contact> contacts, const PolarHistogram& histogram, ForceMean mean) {
  SetNumbers out;
  const Friction friction = friction_of(contacts);
  out.contacts = friction.contacts;
  out.sliding = friction.sliding;
  out.bulk_friction = friction.bulk;
  const HarmonicFit fabric = fabric_anisotropy(histogram);
  out.fabric_amplitude = fabric.amplitude;
  out.fabric_direction = fabric.direction;
  out.fabric_residual = fabric.residual;
  out.fabric_noise = isotropy_bound(histogram.count);
  out.fabric_direction_error = direction_error(histogram.count, fabric.amplitude);
  const ForceAnisotropy normal = normal_force_anisotropy(histogram), shear = shear_force_anisotropy(histogram);
  out.normal_force = normal.mean_over_contacts;
  out.normal_force_orientations = normal.mean_over_orientations();
  out.normal_amplitude = normal.amplitude(mean);
  out.normal_direction = normal.fit.direction;
  out.normal_residual = normal.fit.residual;
  out.shear_force = shear.mean_over_contacts;
  out.shear_force_orientations = shear.mean_over_orientations();
  out.shear_amplitude = shear.amplitude(mean);
  out.shear_direction = shear.fit.direction;
  out.shear_residual = shear.fit.residual;
  const ForceAnisotropy second = second_shear_harmonic(histogram);
  out.shear_second_amplitude = second.amplitude(mean);
  out.shear_second_direction = second.fit.direction;
  const SignedShearAnisotropy signed_shear = signed_shear_anisotropy(histogram, mean);
  out.signed_shear_amplitude = signed_shear.amplitude;
  out.signed_shear_direction = signed_shear.direction;
  out.signed_shear_fourth = signed_shear.fourth;
  out.signed_shear_residual = signed_shear.residual;
  out.empty_bins = normal.fit.empty_bins;
  return out;
}

void take_strong(const ContactNetwork& network, std::span<const Contact> contacts, MicroAnalysis& out) {
  const StrongMeasure measure = out.options.strong;
  const StrongNetwork strong = strong_network(contacts, measure);
  const Percolation percolation = percolation_of(network, contacts, out.options);
  const ZoneLabel zone = zone_of(strong);
  MicroNumbers& n = out.numbers;
  n.strong_threshold = strong.threshold;
  n.strong_fraction = strong.share;
  n.strong_load = strong.load_share;
  n.strong_spans = percolation.spans ? 1.0 : 0.0;
  n.strong_clusters = percolation.clusters;
  n.strong_largest_cluster = percolation.largest_cluster;
  n.zone = strong.count > 0.0 ? static_cast<double>(zone.zone) : std::numeric_limits<double>::quiet_NaN();
  n.zone_margin = zone.margin;
  for (std::size_t k = 0; k < k_pair_kinds; ++k) {
    n.sets[0].strong_share += strong.composition[k];
    n.sets[0].strong_load_share += strong.load_composition[k];
    n.sets[k + 1].strong_share = strong.composition[k];
    n.sets[k + 1].strong_load_share = strong.load_composition[k];
  }
  const std::vector<unsigned char> is_strong = strong_contacts(contacts, measure);
  out.fabric = fabric_tensor(contacts);
  out.strong_fabric = fabric_tensor(contacts, is_strong, true);
  out.weak_fabric = fabric_tensor(contacts, is_strong, false);
}

void take_stress(const ContactNetwork& network, std::span<const Contact> contacts, MicroAnalysis& out) {
  MicroNumbers& n = out.numbers;
  const Tensor3 stress = contact_stress(network), boundary = boundary_stress(network);
  n.stress_xx = stress.xx();
  n.stress_yy = stress.yy();
  n.stress_zz = stress.zz();
  n.stress_xz = stress.xz();
  n.stress_zx = stress.zx();
  n.boundary_zz = boundary.zz();
  n.boundary_xz = boundary.xz();
  n.plate_stress = plate_stress(network);
  n.stress_difference = largest_difference(stress, boundary) / n.plate_stress;
  n.stress_direction = major_axis_in_shear_plane(stress);
  n.stress_ratio = stress_ratio_of(stress);
  n.stress_ratio_of_fabric = stress_ratio_of(anisotropy_tensors(contacts));
  const ProjectedFabric fabric = projected_fabric(out.fabric);
  n.fabric_amplitude_spatial = fabric.amplitude;
  n.fabric_direction_spatial = fabric.direction;
}

void take_connectivity(const ContactNetwork& network, MicroNumbers& n) {
  const Connectivity c = connectivity_of(network);
  n.coordination = c.coordination;
  n.coordination_pairs = c.coordination_pairs;
  n.coordination_mechanical = c.coordination_mechanical;
  n.rattlers = c.rattlers;
  n.rattlers_gravel = c.rattlers_gravel;
  n.rattlers_rubber = c.rattlers_rubber;
}

/// After the stress, whose major axis it reads.
void take_rubber(const MicroState& all, MicroNumbers& n) {
  const RubberState& state = all.rubber;
  const RubberReport r = rubber_report(state);
  n.bond_strain_compressed = r.bond_strain_compressed;
  n.bonds_compressed = r.bonds_compressed;
  const NeighbourStrain beside = strain_by_neighbour(r.grain_bond_strain, all.network);
  n.bond_strain_at_gravel = beside.at_gravel;
  n.bond_strain_at_rubber = beside.at_rubber;
  n.grain_strain_major = mean_strain_along(state, {std::cos(n.stress_direction), 0.0, std::sin(n.stress_direction)});
  n.grain_strain_vertical = mean_strain_along(state, {0.0, 0.0, 1.0});
  n.bond_strain = r.bond_strain.mean;
  n.bond_strain_deviation = r.bond_strain.deviation;
  n.bond_strain_p05 = r.bond_strain.p05;
  n.bond_strain_p50 = r.bond_strain.p50;
  n.bond_strain_p95 = r.bond_strain.p95;
  n.bond_force = r.bond_force;
  n.bond_force_size = r.bond_force_size;
  n.bond_moment = r.bond_moment;
  n.volume_strain = r.volume_strain.mean;
  n.volume_strain_deviation = r.volume_strain.deviation;
  n.aspect_ratio = r.aspect_ratio.mean;
  n.aspect_ratio_p95 = r.aspect_ratio.p95;
  n.closed_second_neighbours = r.closed_second_neighbours;
}

}  // namespace

MicroState micro_state_of(const Simulation& s) { return {contact_network_of(s), rubber_state_of(s)}; }

MicroAnalysis analyse(const MicroState& state, const MicroOptions& options) {
  require(problem_of(options).empty(), "options of an analysis have no problem");
  MicroAnalysis out;
  out.options = options;
  const ContactNetwork& network = state.network;
  const std::vector<Contact> merged =
      options.level == ContactLevel::pair ? merge_pairs(network.contacts) : std::vector<Contact>();
  const std::span<const Contact> contacts =
      options.level == ContactLevel::pair ? std::span<const Contact>(merged) : network.contacts;
  for (std::size_t set = 0; set < k_contact_sets; ++set) {
    const std::vector<Contact> of_kind =
        set == 0 ? std::vector<Contact>() : contacts_of_kind(contacts, static_cast<PairKind>(set - 1));
    const std::vector<Contact> seen =
        contacts_in_projection(set == 0 ? contacts : std::span<const Contact>(of_kind), options.projection);
    const std::span<const Contact> chosen(seen);
    const std::vector<PolarSample> samples = polar_samples(chosen, options);
    out.histograms[set] = polar_histogram(samples, options.bins);
    out.numbers.sets[set] = numbers_of_set(chosen, out.histograms[set], options.force_mean);
    out.bands[set] = bootstrap_bands(samples, options, set);
  }
  take_strong(network, contacts, out);
  take_stress(network, contacts, out);
  take_connectivity(network, out.numbers);
  take_rubber(state, out.numbers);
  return out;
}

}  // namespace dem
