// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/micro_table.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "dem4grm/micro/strong_network.hpp"

namespace dem {
namespace {

constexpr double k_degrees = 180.0 / std::numbers::pi;
using S = SetNumbers;
using M = MicroNumbers;

constexpr std::array<SetQuantity, 27> k_set_quantities{{
    {"contacts", "1", "contacts that carry force", &S::contacts},
    {"normal_force", "N", "mean normal force of the contacts", &S::normal_force},
    {"normal_force_orientations", "N", "mean of the mean normal forces of the bins", &S::normal_force_orientations},
    {"shear_force", "N", "mean magnitude of the tangential force of the contacts", &S::shear_force},
    {"shear_force_orientations", "N", "mean of the mean tangential forces of the bins", &S::shear_force_orientations},
    {"a", "1", "amplitude of the fabric", &S::fabric_amplitude},
    {"theta_a", "deg", "major axis of the fabric from the shear direction", &S::fabric_direction, k_degrees},
    {"a_residual", "1", "root mean square of the fabric off its curve, over the mean", &S::fabric_residual},
    {"a_noise", "1", "amplitude that isotropic contacts of that number exceed once in 3000 times", &S::fabric_noise},
    {"theta_a_error", "deg", "standard error of theta_a", &S::fabric_direction_error, k_degrees},
    {"a_n", "1", "amplitude of the normal force", &S::normal_amplitude},
    {"theta_n", "deg", "direction of the largest normal force", &S::normal_direction, k_degrees},
    {"a_n_residual", "1", "root mean square of the normal force off its curve, over the mean", &S::normal_residual},
    {"a_t", "1", "amplitude of the tangential force", &S::shear_amplitude},
    {"theta_t", "deg", "direction of the largest tangential force, modulo 90", &S::shear_direction, k_degrees},
    {"a_t_residual", "1", "root mean square of the tangential force off its curve, over the mean", &S::shear_residual},
    {"a_t2", "1", "amplitude of the second harmonic of the tangential force", &S::shear_second_amplitude},
    {"theta_t2", "deg", "direction of it", &S::shear_second_direction, k_degrees},
    {"a_s", "1", "amplitude of the signed tangential force over the mean normal force", &S::signed_shear_amplitude},
    {"theta_s", "deg", "major axis of the stress that it belongs to", &S::signed_shear_direction, k_degrees},
    {"a_s_fourth", "1", "fourth harmonic of the signed tangential force over the mean normal force",
     &S::signed_shear_fourth},
    {"a_s_residual", "1", "root mean square of it off its curve, over the mean normal force",
     &S::signed_shear_residual},
    {"empty_bins", "1", "bins of the half circle without a contact", &S::empty_bins},
    {"sliding", "1", "share of the contacts at their Coulomb limit", &S::sliding},
    {"bulk_friction", "1", "sum of tangential over sum of normal forces", &S::bulk_friction},
    {"strong_share", "1", "share among the strong contacts by number", &S::strong_share},
    {"strong_load_share", "1", "share among the strong contacts by load", &S::strong_load_share},
}};

constexpr std::array<StateQuantity, 47> k_state_quantities{{
    {"strong_threshold", "N", "a contact is strong above this force", &M::strong_threshold},
    {"strong_fraction", "1", "strong contacts among all", &M::strong_fraction},
    {"strong_load", "1", "share of the load that strong contacts carry", &M::strong_load},
    {"strong_spans", "1", "1 when strong contacts lead from plate to plate", &M::strong_spans},
    {"strong_clusters", "1", "groups of bodies that strong contacts join", &M::strong_clusters},
    {"strong_largest_cluster", "1", "share of the bodies in the largest group", &M::strong_largest_cluster},
    {"zone", "1", "1 rigid (g-g holds the majority), 2 intermediate, 3 soft (r-r)", &M::zone},
    {"zone_margin", "1", "distance to the next zone in standard errors", &M::zone_margin},
    {"coordination", "1", "contacts of a body with others, mean", &M::coordination},
    {"coordination_pairs", "1", "bodies that a body touches, mean", &M::coordination_pairs},
    {"coordination_mechanical", "1", "contacts of a body that is no rattler, mean", &M::coordination_mechanical},
    {"rattlers", "1", "share of the bodies that touch fewer than two others or walls", &M::rattlers},
    {"rattlers_gravel", "1", "the same among the gravel grains", &M::rattlers_gravel},
    {"rattlers_rubber", "1", "the same among the rubber grains", &M::rattlers_rubber},
    {"stress_xx", "kPa", "stress from contacts and branches, compression positive", &M::stress_xx, 1e-3},
    {"stress_yy", "kPa", "the same", &M::stress_yy, 1e-3},
    {"stress_zz", "kPa", "the same", &M::stress_zz, 1e-3},
    {"stress_xz", "kPa", "the same: force along x, branch along z", &M::stress_xz, 1e-3},
    {"stress_zx", "kPa", "the same: force along z, branch along x", &M::stress_zx, 1e-3},
    {"boundary_zz", "kPa", "stress from the forces on the walls and their places", &M::boundary_zz, 1e-3},
    {"boundary_xz", "kPa", "the same", &M::boundary_xz, 1e-3},
    {"plate_stress", "kPa", "force on the top plate over the nominal area", &M::plate_stress, 1e-3},
    {"stress_difference", "1", "largest component of contact minus boundary stress over the plate stress",
     &M::stress_difference},
    {"stress_direction", "deg", "major axis of the stress in the shear plane", &M::stress_direction, k_degrees},
    {"stress_ratio", "1", "deviator over mean stress, q/p, of the contacts", &M::stress_ratio},
    {"stress_ratio_of_fabric", "1", "q/p that fabric and force anisotropy in space give", &M::stress_ratio_of_fabric},
    {"a_spatial", "1", "amplitude of the fabric from the tensor in space", &M::fabric_amplitude_spatial},
    {"theta_a_spatial", "deg", "its direction", &M::fabric_direction_spatial, k_degrees},
    {"bond_strain", "1", "mean compressive strain of the bonds of the rubber", &M::bond_strain},
    {"bond_strain_deviation", "1", "standard deviation of it", &M::bond_strain_deviation},
    {"bond_strain_p05", "1", "5 % of the bonds lie below", &M::bond_strain_p05},
    {"bond_strain_p50", "1", "median", &M::bond_strain_p50},
    {"bond_strain_p95", "1", "5 % of the bonds lie above", &M::bond_strain_p95},
    {"bond_strain_compressed", "1", "mean strain of the bonds that are shorter than at rest",
     &M::bond_strain_compressed},
    {"bonds_compressed", "1", "their share", &M::bonds_compressed},
    {"bond_strain_at_gravel", "1", "mean bond strain of rubber grains, each once for each gravel grain that it touches",
     &M::bond_strain_at_gravel},
    {"bond_strain_at_rubber", "1", "the same for rubber grains that it touches", &M::bond_strain_at_rubber},
    {"grain_strain_major", "1", "mean compression of a rubber grain along the major axis of the stress",
     &M::grain_strain_major},
    {"grain_strain_vertical", "1", "the same along the vertical", &M::grain_strain_vertical},
    {"bond_force", "N", "mean normal force of the bonds, compression positive", &M::bond_force},
    {"bond_force_size", "N", "mean magnitude of it", &M::bond_force_size},
    {"bond_moment", "mN_m", "mean magnitude of the moment of the bonds", &M::bond_moment, 1e3},
    {"volume_strain", "1", "mean compression of the volume of a rubber grain", &M::volume_strain},
    {"volume_strain_deviation", "1", "standard deviation of it", &M::volume_strain_deviation},
    {"aspect_ratio", "1", "longest over shortest axis of a rubber grain, mean", &M::aspect_ratio},
    {"aspect_ratio_p95", "1", "5 % of the rubber grains lie above", &M::aspect_ratio_p95},
    {"closed_second_neighbours", "1", "second neighbours in contact in a rubber grain, of 66",
     &M::closed_second_neighbours},
}};

constexpr std::array<const char*, k_contact_sets> k_set_words{"all", "gg", "gr", "rr"};

/// What the views of ColumnInfo look at.
struct Columns {
  std::vector<std::string> names, descriptions;
  std::vector<ColumnInfo> columns;

  Columns() {
    const std::size_t n = 1 + k_contact_sets * k_set_quantities.size() + k_state_quantities.size();
    names.reserve(n);  // so that no view is left behind when a list grows
    descriptions.reserve(n);
    add("displacement_mm", "mm", "displacement of the halves against each other");
    for (std::size_t set = 0; set < k_contact_sets; ++set) {
      for (const SetQuantity& q : k_set_quantities) {
        add(name_with_unit(q.name, q.unit, k_set_words[set]), q.unit,
            fmt::format("{}: {}", k_set_names[set], q.description));
      }
    }
    for (const StateQuantity& q : k_state_quantities) add(name_with_unit(q.name, q.unit), q.unit, q.description);
  }

 private:
  void add(std::string name, const char* unit, std::string description) {
    names.push_back(std::move(name));
    descriptions.push_back(std::move(description));
    columns.push_back({names.back(), unit, descriptions.back()});
  }
};

}  // namespace

std::span<const SetQuantity> set_quantities() { return k_set_quantities; }
std::span<const StateQuantity> state_quantities() { return k_state_quantities; }

double value_in_unit(const SetQuantity& quantity, const SetNumbers& numbers) {
  return without_sign_of_nan(numbers.*quantity.value * quantity.scale);
}
double value_in_unit(const StateQuantity& quantity, const MicroNumbers& numbers) {
  return without_sign_of_nan(numbers.*quantity.value * quantity.scale);
}

std::string name_with_unit(const char* name, const char* unit, const char* set) {
  std::string text = name;
  if (set != nullptr) text += fmt::format("_{}", set);
  return std::string(unit) == "1" ? text : fmt::format("{}_{}", text, unit);
}

const char* zone_name(double zone) {
  if (zone == static_cast<double>(Zone::rigid)) return "rigid";
  return zone == static_cast<double>(Zone::soft) ? "soft" : "intermediate";
}

std::span<const ColumnInfo> micro_columns() {
  static const Columns k_columns;
  return k_columns.columns;
}

std::vector<double> micro_values(const MicroRow& row) {
  std::vector<double> values{row.displacement * 1e3};
  for (const SetNumbers& numbers : row.numbers.sets) {
    for (const SetQuantity& q : k_set_quantities) values.push_back(value_in_unit(q, numbers));
  }
  for (const StateQuantity& q : k_state_quantities) values.push_back(value_in_unit(q, row.numbers));
  return values;
}

}  // namespace dem
