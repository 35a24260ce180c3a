// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/summary.hpp"

#include <cmath>
#include <numbers>
#include <optional>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/results/micro_table.hpp"
#include "dem4grm/results/profile_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

JsonValue state_hashes(const RunFacts& facts) {
  JsonList list;
  for (const FrameInfo& frame : facts.frames) {
    list.emplace_back(JsonObject{
        {"frame", frame.number}, {"displacement_mm", frame.displacement * 1e3}, {"state_hash", frame.state_hash}});
  }
  return list;
}

void append(JsonObject& object, JsonObject more) {
  for (JsonField& field : more) object.push_back(std::move(field));
}

JsonObject origin_of(const std::string& test, const std::string& name, const RunFacts& facts) {
  return {{"test", test},
          {"case", name},
          {"version", k_version},
          {"commit", k_commit},
          {"compiler", k_compiler},
          {"build_type", k_build_type},
          {"processor_target", std::string(kernel_target())},
          {"threads", facts.threads}};
}

JsonValue optional_number(const std::optional<double>& value) { return value ? JsonValue(*value) : JsonValue(); }

/// The search for the relative density, in the order of its branches.
JsonValue branches_of(const SpecimenReport& report) {
  JsonList list;
  for (const Branch& b : report.branches) {
    list.emplace_back(JsonObject{
        {"friction", b.friction}, {"stress_kPa", b.stress / 1e3}, {"void_ratio", b.void_ratio}, {"steps", b.steps}});
  }
  return list;
}

/// What no stage measured is unknown, not zero.
JsonObject specimen_of(const DirectShearCase& test, const DirectShearResult& r) {
  const SpecimenReport& s = r.specimen;
  return {
      {"balls", r.balls},
      {"clumps", r.clumps},
      {"rubber_grains", r.rubber_grains},
      {"bonds", r.bonds},
      {"broken_bonds", r.broken_bonds},
      {"lost_grains", r.lost_grains},
      {"rubber_content", s.rubber_content},
      {"void_ratio_generated", s.void_ratio_generated},
      {"void_ratio_prepared", s.void_ratio_prepared},
      {"void_ratio_before_shear", s.void_ratio_before_shear},
      {"relative_density_target", s.branches.empty() ? JsonValue() : optional_number(test.specimen.relative_density)},
      {"relative_density", optional_number(s.relative_density_reached())},
      {"void_ratio_min", s.branches.empty() ? JsonValue() : JsonValue(s.branches[0].void_ratio)},
      {"void_ratio_max", s.branches.empty() ? JsonValue() : JsonValue(s.branches[1].void_ratio)},
      {"preparation_friction", s.preparation_friction},
      {"branches", branches_of(s)},
      {"height_before_shear_mm", s.height * 1e3},
      {"alignment_generated", s.alignment_generated},
      {"alignment_before_shear", s.alignment_before_shear},
      {"fill_overlap", s.fill_overlap},
      {"caught_balls", s.caught},
      {"mean_size_mm", s.mean_size * 1e3},
      {"mean_density_kg_per_m3", s.mean_density},
      {"steps_fill", s.fill_steps},
      {"steps_branches", s.branch_steps},
      {"steps_compression", s.compression_steps},
      {"steps_final_friction", s.friction_steps}};
}

JsonObject beginning_of(const DirectShearCase& test, const DirectShearResult& result, const RunFacts& facts) {
  JsonObject summary = origin_of("direct_shear", test.name, facts);
  append(summary, {{"seed", static_cast<std::int64_t>(test.seed)},
                   {"steps", result.steps},
                   {"time_step_s", result.time_step},
                   {"time_step_limited_by", result.specimen.time_step.limited_by},
                   {"wall_time_s", facts.wall_time}});
  append(summary, specimen_of(test, result));
  append(summary, homogeneity_fields(result.before.homogeneity));
  append(summary, {{"split_height_mm", result.specimen.split_height * 1e3}});
  append(summary, {{"k0_x", result.before.lateral.k0_x}, {"k0_y", result.before.lateral.k0_y}});
  return summary;
}

JsonObject curve_of(const DirectShearCase& test, const DirectShearResult& r) {
  const ShearCurve& c = r.curve;
  return {{"normal_stress_target_kPa", test.shear.normal_stress / 1e3},
          {"normal_stress_mean_kPa", r.normal_stress_mean / 1e3},
          {"normal_stress_max_error", r.normal_stress_max_error},
          {"normal_stress_worst_step_error", r.normal_stress_worst_step},
          {"half_force_imbalance_mean", r.half_force_imbalance_mean},
          {"inertial_number_max", r.inertial_number_max},
          {"unbalanced_ratio_mean", r.unbalanced_ratio_mean},
          {"shear_displacement_mm", r.displacement * 1e3},
          {"shear_velocity_mm_per_s", scaled_decimal(r.shear_velocity, -3)},
          {"shear_velocity_rule", test.shear.velocity ? "given" : "quasi-static"},
          {"inertial_number_target", test.shear.velocity ? JsonValue() : optional_number(test.shear.inertial_number)},
          {"peak_shear_stress_kPa", c.peak_stress / 1e3},
          {"displacement_at_peak_mm", c.displacement_at_peak * 1e3},
          {"vertical_displacement_at_peak_mm", c.peak_point.vertical_displacement * 1e3},
          {"normal_stress_at_peak_kPa", c.peak_point.normal_stress / 1e3},
          {"residual_shear_stress_kPa", c.residual_stress / 1e3},
          {"displacement_at_residual_mm", c.residual_point.displacement * 1e3},
          {"vertical_displacement_at_residual_mm", c.residual_point.vertical_displacement * 1e3},
          {"normal_stress_at_residual_kPa", c.residual_point.normal_stress / 1e3},
          {"secant_stiffness_kPa_per_mm", c.secant_stiffness / 1e6},
          {"dilation_angle_deg", c.dilation_angle * 180.0 / std::numbers::pi},
          {"vertical_displacement_at_end_mm", c.vertical_displacement_at_end * 1e3},
          {"void_ratio_at_end", r.rows.empty() ? JsonValue() : JsonValue(r.rows.back().void_ratio)},
          {"rows", static_cast<std::int64_t>(r.rows.size())}};
}

JsonObject stage_fields(const Stage& stage) {
  return {{"displacement_mm", stage.displacement * 1e3},
          {"shear_ratio", stage.dilatancy.shear_ratio},
          {"dilation_rate", stage.dilatancy.rate},
          {"taylor_friction", stage.dilatancy.friction}};
}

/// Of a branched test: its origin, and from which displacement on the numbers of the curve count.
void append_branch(JsonObject& summary, const DirectShearResult& r, const RunFacts& facts) {
  if (facts.branch.empty()) return;
  JsonObject branch = facts.branch;
  branch.push_back({"numbers_from_mm", r.displacement_before * 1e3});
  summary.push_back({"branch", std::move(branch)});
}

/// How the specimen changes its volume, and what that carries of the shear stress.
JsonObject volume_of(const ShearCurve& c) {
  return {{"largest_contraction_mm", c.contraction * 1e3},
          {"displacement_at_contraction_mm", c.displacement_at_contraction * 1e3},
          {"dilatancy_at_peak", stage_fields(c.at_peak)},
          {"dilatancy_fastest", stage_fields(c.fastest_dilation)},
          {"dilatancy_residual", stage_fields(c.residual)}};
}

/// The recorded micro-mechanics nearest to the peak; null without any.
JsonValue micro_at_peak(const DirectShearResult& r) {
  if (std::isnan(r.curve.displacement_at_peak)) return {};
  const MicroRow* nearest = nullptr;
  const auto distance = [&](const MicroRow& row) { return std::fabs(row.displacement - r.curve.displacement_at_peak); };
  for (const MicroRow& row : r.micro_rows) {
    if (nearest == nullptr || distance(row) < distance(*nearest)) nearest = &row;
  }
  if (nearest == nullptr) return {};
  constexpr double degree = std::numbers::pi / 180.0;
  const MicroNumbers& n = nearest->numbers;
  const SetNumbers& all = n.of_all();
  return JsonObject{{"displacement_mm", nearest->displacement * 1e3},
                    {"a", all.fabric_amplitude},
                    {"a_n", all.normal_amplitude},
                    {"theta_n_deg", all.normal_direction / degree},
                    {"a_t", all.shear_amplitude},
                    {"bulk_friction", all.bulk_friction},
                    {"strong_share_gg", n.sets[1].strong_share},
                    {"strong_share_gr", n.sets[2].strong_share},
                    {"strong_share_rr", n.sets[3].strong_share},
                    {"zone", zone_name(n.zone)},
                    {"rubber_bond_strain", n.bond_strain}};
}

JsonObject ending_of(const RunFacts& facts, const std::string& state_hash) {
  return {{"energy_closure_per_cent", facts.energy_closure},
          {"state_hash", state_hash},
          {"state_hashes", state_hashes(facts)},
          {"warnings", facts.warnings}};
}

}  // namespace

JsonObject homogeneity_fields(const Homogeneity& h) {
  return {{"homogeneity_cells", h.cells},
          {"homogeneity_void_ratio_scatter", h.void_ratio_scatter},
          {"homogeneity_rubber_content_scatter", h.rubber_content_scatter},
          {"void_ratio_inside", h.void_ratio_inside},
          {"void_ratio_at_plates", h.void_ratio_at_plates},
          {"void_ratio_at_side_walls", h.void_ratio_at_sides},
          {"layering_at_plates", h.layering_at_plates},
          {"layering_at_side_walls", h.layering_at_sides},
          {"contacts_before_shear", h.fabric.contacts},
          {"fabric_deviator_before_shear", h.fabric.deviator},
          {"fabric_deviator_noise", h.fabric.deviator_noise},
          {"largest_overlap_before_shear", h.overlap.largest},
          {"caught_balls_before_shear", h.overlap.caught}};
}

double energy_closure_per_cent(const EnergyReport& start, const EnergyReport& end) {
  const double stored = (end.kinetic - start.kinetic) + (end.contact_strain - start.contact_strain) +
                        (end.bond_strain - start.bond_strain);
  const double work = end.boundary_work - start.boundary_work;
  const double lost = (end.slip - start.slip) + (end.dashpot - start.dashpot) +
                      (end.local_damping - start.local_damping) + (end.breakage - start.breakage);
  return work != 0.0 ? 100.0 * (work - stored - lost) / std::fabs(work) : 0.0;
}

JsonObject specimen_summary(const DirectShearCase& test, const DirectShearResult& result, const RunFacts& facts) {
  JsonObject summary = beginning_of(test, result, facts);
  append(summary, {{"normal_stress_target_kPa", test.shear.normal_stress / 1e3},
                   {"state_hash", result.state_hash},
                   {"warnings", facts.warnings}});
  return summary;
}

JsonObject direct_shear_summary(const DirectShearCase& test, const DirectShearResult& result, const RunFacts& facts) {
  JsonObject summary = beginning_of(test, result, facts);
  append(summary, curve_of(test, result));
  append(summary, {{"hardening", result.curve.is_hardening}});
  append(summary, volume_of(result.curve));
  append(summary, {{"shear_band", shear_bands_as_json(facts.profiles)}});
  append(summary, {{"micro_at_peak", micro_at_peak(result)}});
  append_branch(summary, result, facts);
  append(summary, ending_of(facts, result.state_hash));
  return summary;
}

JsonObject grain_compression_summary(const GrainCompressionCase& test, const GrainCompressionResult& result,
                                     const RunFacts& facts) {
  JsonObject summary = origin_of("grain_compression", test.name, facts);
  const bool has_rows = !result.rows.empty();
  append(summary, {{"steps", result.steps},
                   {"time_step_s", result.time_step},
                   {"time_step_limited_by", result.time_step_limit.limited_by},
                   {"wall_time_s", facts.wall_time},
                   {"balls", k_grain_balls},
                   {"clumps", 0},
                   {"rubber_grains", 1},
                   {"bonds", k_grain_bonds},
                   {"grain_height_mm", result.grain_height * 1e3},
                   {"plate_velocity_mm_per_s", test.plate_velocity * 1e3},
                   {"strain", has_rows ? result.rows.back().strain : 0.0},
                   {"load_at_end_N", has_rows ? result.rows.back().load : 0.0},
                   {"initial_stiffness_N_per_mm", result.initial_stiffness / 1e3},
                   {"late_stiffness_N_per_mm", result.late_stiffness / 1e3},
                   {"knee_strain", result.knee_strain},
                   {"poisson_ratio_initial", result.poisson_ratio_initial},
                   {"rows", static_cast<std::int64_t>(result.rows.size())}});
  append(summary, ending_of(facts, result.state_hash));
  return summary;
}

}  // namespace dem
