// SPDX-License-Identifier: BSD-3-Clause
// summary.json: all promised names, their units, and the energy balance.
#include "dem4grm/results/summary.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace dem {
namespace {

DirectShearResult sample_result() {
  DirectShearResult r;
  r.specimen.void_ratio_prepared = 0.65;
  r.specimen.time_step.limited_by = "loaded rubber grain";
  r.curve.peak_stress = 88e3;
  r.curve.displacement_at_peak = 3e-3;
  r.curve.peak_point = {3e-3, 0.3e-3, 101e3};
  r.curve.residual_point = {13e-3, 0.5e-3, 99e3};
  r.curve.secant_stiffness = 50e6;
  r.curve.dilation_angle = std::numbers::pi / 18.0;
  r.curve.vertical_displacement_at_end = 0.4e-3;
  r.normal_stress_mean = 100e3;
  r.displacement = 14e-3;
  r.rows.resize(3);
  r.state_hash = "abc";
  return r;
}

TEST(Summary, HasAllPromisedNames) {
  const JsonObject summary = direct_shear_summary({}, sample_result(), {});
  for (const char* name : {"case",
                           "version",
                           "commit",
                           "seed",
                           "threads",
                           "steps",
                           "time_step_s",
                           "time_step_limited_by",
                           "wall_time_s",
                           "balls",
                           "clumps",
                           "rubber_grains",
                           "bonds",
                           "lost_grains",
                           "rubber_content",
                           "void_ratio_prepared",
                           "void_ratio_before_shear",
                           "relative_density",
                           "homogeneity_cells",
                           "homogeneity_void_ratio_scatter",
                           "homogeneity_rubber_content_scatter",
                           "void_ratio_inside",
                           "void_ratio_at_plates",
                           "void_ratio_at_side_walls",
                           "layering_at_plates",
                           "layering_at_side_walls",
                           "contacts_before_shear",
                           "fabric_deviator_before_shear",
                           "fabric_deviator_noise",
                           "largest_overlap_before_shear",
                           "caught_balls_before_shear",
                           "split_height_mm",
                           "k0_x",
                           "k0_y",
                           "largest_contraction_mm",
                           "displacement_at_contraction_mm",
                           "dilatancy_at_peak",
                           "dilatancy_fastest",
                           "dilatancy_residual",
                           "shear_band",
                           "normal_stress_target_kPa",
                           "normal_stress_mean_kPa",
                           "normal_stress_max_error",
                           "half_force_imbalance_mean",
                           "inertial_number_max",
                           "unbalanced_ratio_mean",
                           "shear_displacement_mm",
                           "shear_velocity_mm_per_s",
                           "shear_velocity_rule",
                           "inertial_number_target",
                           "peak_shear_stress_kPa",
                           "displacement_at_peak_mm",
                           "vertical_displacement_at_peak_mm",
                           "normal_stress_at_peak_kPa",
                           "residual_shear_stress_kPa",
                           "displacement_at_residual_mm",
                           "vertical_displacement_at_residual_mm",
                           "normal_stress_at_residual_kPa",
                           "secant_stiffness_kPa_per_mm",
                           "dilation_angle_deg",
                           "vertical_displacement_at_end_mm",
                           "state_hash",
                           "hardening",
                           "warnings"}) {
    EXPECT_NE(find_field(summary, name), nullptr) << name;
  }
}

TEST(Summary, ConvertsUnits) {
  DirectShearCase test;
  test.shear.normal_stress = 100e3;
  const JsonObject summary =
      direct_shear_summary(test, sample_result(), {2, 1.5, 0.0, {{0, 2e-3, "h"}}, {"careful"}, {}});
  EXPECT_DOUBLE_EQ(number_in(summary, "normal_stress_target_kPa"), 100.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "peak_shear_stress_kPa"), 88.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "displacement_at_peak_mm"), 3.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "vertical_displacement_at_peak_mm"), 0.3);
  EXPECT_DOUBLE_EQ(number_in(summary, "normal_stress_at_peak_kPa"), 101.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "displacement_at_residual_mm"), 13.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "vertical_displacement_at_residual_mm"), 0.5);
  EXPECT_DOUBLE_EQ(number_in(summary, "normal_stress_at_residual_kPa"), 99.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "secant_stiffness_kPa_per_mm"), 50.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "dilation_angle_deg"), 10.0);
  EXPECT_DOUBLE_EQ(number_in(summary, "vertical_displacement_at_end_mm"), 0.4);
  EXPECT_EQ(number_in(summary, "threads"), 2.0);
  const auto& hashes = std::get<JsonList>(find_field(summary, "state_hashes")->data);
  ASSERT_EQ(hashes.size(), 1U);
  EXPECT_EQ(text_in(std::get<JsonObject>(hashes[0].data), "state_hash"), "h");
  EXPECT_EQ(std::get<JsonList>(find_field(summary, "warnings")->data).size(), 1U);
}

TEST(Summary, SaysHowTheVelocityWasChosen) {
  DirectShearCase test;
  DirectShearResult result = sample_result();
  result.shear_velocity = 0.00268;
  JsonObject summary = direct_shear_summary(test, result, {});
  EXPECT_EQ(number_in(summary, "shear_velocity_mm_per_s"), 2.68);
  EXPECT_EQ(text_in(summary, "shear_velocity_rule"), "given");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(find_field(summary, "inertial_number_target")->data));
  test.shear.velocity.reset();
  test.shear.inertial_number = 5e-5;
  summary = direct_shear_summary(test, result, {});
  EXPECT_EQ(text_in(summary, "shear_velocity_rule"), "quasi-static");
  EXPECT_EQ(number_in(summary, "inertial_number_target"), 5e-5);
}

TEST(Summary, NamesAreUnique) {
  for (const JsonObject& summary :
       {direct_shear_summary({}, sample_result(), {}), grain_compression_summary({}, {}, {})}) {
    for (std::size_t a = 0; a < summary.size(); ++a) {
      for (std::size_t b = a + 1; b < summary.size(); ++b) EXPECT_NE(summary[a].name, summary[b].name);
    }
  }
}

TEST(Summary, EnergyClosureIsWhatNoLedgerHolds) {
  const EnergyReport start{1.0, 10.0, 5.0, 0.0, 0.0, 0.0, 0.0};
  // Walls put in 20: 8 are stored, 11.8 lost, 0.2 are missing.
  const EnergyReport end{2.0, 14.0, 8.0, 20.0, 9.0, 2.0, 0.8};
  EXPECT_NEAR(energy_closure_per_cent(start, end), 1.0, 1e-12);
  EXPECT_EQ(energy_closure_per_cent({}, {}), 0.0);
}

}  // namespace
}  // namespace dem
