// SPDX-License-Identifier: BSD-3-Clause
// The table of keys: name, place in the case, unit, range, help, published value.
#include "dem4grm/case_file/case_schema.hpp"

#include <algorithm>

#include "dem4grm/laws/inertial_number.hpp"

namespace dem {
namespace {

constexpr auto k_length = Dimension::length;
constexpr auto k_speed = Dimension::speed;
constexpr auto k_stress = Dimension::stress;
constexpr auto k_density = Dimension::density;
constexpr double k_most_count = 10e6;

using Keys = std::vector<Key>;

// Every section is one function that appends its rows; sections that both tests know are shared. clang-format stays
// off here because a table is read by its columns.
// clang-format off

void add_contact_and_integration(Keys& keys, ContactSettings& contact, IntegrationSettings& integration) {
  keys.insert(keys.end(), {
    {.section = "contact", .name = "hz_mode", .slot = &contact.hz_mode, .range = {0, 1},
     .help = "shear force when the normal force falls: 0 kept, 1 scaled down with it"},
    {.section = "contact", .name = "normal_damping_ratio", .slot = &contact.normal_damping_ratio, .range = {0, 1},
     .help = "normal dashpot of unbonded contacts, fraction of critical"},
    {.section = "contact", .name = "shear_damping_ratio", .slot = &contact.shear_damping_ratio, .range = {0, 1},
     .help = "shear dashpot of unbonded contacts, fraction of critical"},
    {.section = "contact", .name = "dashpot_mode", .slot = &contact.dashpot_mode, .range = {0, 3},
     .help = "0 full, 1 no net tension, 2 no shear dashpot while slipping, 3 both"},
    {.section = "integration", .name = "local_damping", .slot = &integration.local_damping, .range = {0, 0.95},
     .help = "local damping coefficient", .published = "0.2"},
    {.section = "integration", .name = "time_step_rule", .slot = &integration.time_step_rule,
     .help = "stability limit from the largest eigenvalue, or the usual estimate, about half as large",
     .choices = {"true_limit", "diagonal"}},
    {.section = "integration", .name = "time_step_safety", .slot = &integration.time_step_safety, .range = {0.01, 1},
     .help = "time step as a fraction of the stability limit"},
  });
}

void add_bond(Keys& keys, BondSettings& bond) {
  keys.insert(keys.end(), {
    {.section = "rubber.bond", .name = "modulus", .slot = &bond.modulus, .dimension = k_stress, .range = {1e4, 1e12},
     .help = "elastic modulus of the bonds inside a rubber grain", .published = "20 MPa"},
    {.section = "rubber.bond", .name = "stiffness_ratio", .slot = &bond.stiffness_ratio, .range = {0.1, 100},
     .help = "normal over shear stiffness of a bond", .published = "4.0"},
    {.section = "rubber.bond", .name = "radius_multiplier", .slot = &bond.radius_multiplier, .range = {0.1, 2},
     .help = "bond radius over ball radius"},
    {.section = "rubber.bond", .name = "moment_scale", .slot = &bond.moment_scale, .range = {0, 1},
     .help = "factor on the bending and twisting stiffness of a bond"},
    {.section = "rubber.bond", .name = "damping_ratio", .slot = &bond.damping_ratio, .range = {0, 1},
     .help = "normal dashpot of a bond, fraction of critical", .published = "0.25"},
    {.section = "rubber.bond", .name = "tensile_strength", .slot = &bond.tensile_strength, .dimension = k_stress,
     .range = {1, 1e300}, .help = "a bond breaks above it; from 1e100 Pa on it never breaks",
     .published = "30e200 Pa"},
    {.section = "rubber.bond", .name = "shear_strength", .slot = &bond.shear_strength, .dimension = k_stress,
     .range = {1, 1e300}, .help = "a bond breaks above it; from 1e100 Pa on it never breaks",
     .published = "30e200 Pa"},
    {.section = "rubber.bond", .name = "linear_spring", .slot = &bond.linear_spring,
     .help = "spring of the same modulus beside the bond, in compression only"},
    {.section = "rubber.bond", .name = "spring_friction", .slot = &bond.spring_friction, .range = {0, 5},
     .help = "friction coefficient of a shear force of that spring; 0: it only pushes"},
    {.section = "rubber.bond", .name = "hertz_contact", .slot = &bond.hertz_contact,
     .help = "Hertz-Mindlin contact of the bonded balls beside the bond"},
    {.section = "rubber.bond", .name = "form", .slot = &bond.form,
     .help = "formulation: history_free is exact under any rotation, incremental can break",
     .choices = {"history_free", "incremental"}},
  });
}

void add_elasticity(Keys& keys, std::string_view section, MaterialSettings& material, std::string_view friction,
                    std::string_view modulus, std::string_view ratio) {
  keys.insert(keys.end(), {
    {.section = section, .name = "friction", .slot = &material.friction, .range = {0, 5},
     .help = section == "walls" ? "friction coefficient of the plates; side walls have none" : "friction coefficient",
     .published = friction, .is_in_template = section != "walls"},
    {.section = section, .name = "shear_modulus", .slot = &material.shear_modulus, .dimension = k_stress,
     .range = {1e4, 1e12}, .help = "shear modulus in Hertz-Mindlin contacts", .published = modulus},
    {.section = section, .name = "poisson_ratio", .slot = &material.poisson_ratio, .range = {0, 0.5},
     .help = "Poisson's ratio in Hertz-Mindlin contacts", .published = ratio},
  });
}

void add_rubber(Keys& keys, MaterialSettings& rubber) {
  keys.insert(keys.end(), {
    {.section = "rubber", .name = "density", .slot = &rubber.density, .dimension = k_density, .range = {100, 20000},
     .help = "density of the balls, corrected for the voids inside a grain", .published = "1610 kg/m3"},
  });
  add_elasticity(keys, "rubber", rubber, "0.27", "12 MPa", "");
}

void add_specimen(Keys& keys, SpecimenSettings& specimen) {
  keys.insert(keys.end(), {
    {.section = "specimen", .name = "rubber_content", .slot = &specimen.rubber_content, .range = {0, 1},
     .help = "rubber content VRC, fraction of the solid volume", .published = "0, 0.1, 0.25, 0.4, 0.7 and 1",
     .is_required = true, .is_in_template = true},
    {.section = "specimen", .name = "relative_density", .slot = &specimen.relative_density, .range = {0.02, 0.98},
     .help = "relative density (e_max - e) / (e_max - e_min) to be searched for, fraction", .published = "0.5",
     .default_words = "0.5 when preparation_friction is not given either", .is_in_template = true},
    {.section = "specimen", .name = "relative_density_tolerance", .slot = &specimen.relative_density_tolerance,
     .range = {0.001, 0.2}, .help = "the search ends when the relative density is as near as this"},
    {.section = "specimen", .name = "preparation_friction", .slot = &specimen.preparation_friction, .range = {0, 10},
     .help = "friction between grains while the plate compresses; sets the density without a search",
     .default_words = "found by the search for relative_density"},
    {.section = "specimen", .name = "smallest_friction", .slot = &specimen.smallest_friction, .range = {0, 10},
     .help = "friction between grains in the branch that gives e_min", .published = "0"},
    {.section = "specimen", .name = "largest_friction", .slot = &specimen.largest_friction, .range = {0, 10},
     .help = "friction between grains in the branch that gives e_max", .published = "2"},
    {.section = "specimen", .name = "branch_stress_ratio", .slot = &specimen.branch_stress_ratio, .range = {0.1, 1},
     .help = "stress under which the branches are compared, fraction of the normal stress", .published = "0.9"},
    {.section = "specimen", .name = "load_steps", .slot = &specimen.load_steps, .dimension = k_stress,
     .range = {100, 100e6}, .help = "stresses under which the specimen rests on its way; those from the normal stress "
     "on are skipped"},
    {.section = "specimen", .name = "preparation_plate_friction", .slot = &specimen.preparation_plate_friction,
     .range = {0, 5}, .help = "friction of both plates until the final friction is set"},
    // The source stands before its grading: a grading that is read from a file then overwrites the note.
    {.section = "specimen", .name = "gravel_grading_source", .slot = &specimen.gravel_grading_file,
     .help = "note: the file that a list in gravel_grading was copied from; it is not read"},
    {.section = "specimen", .name = "gravel_grading",
     .slot = GradingSlot{&specimen.gravel_grading, &specimen.gravel_grading_file},
     .help = "CSV file, or list of [sieve size, fraction passing by mass]", .published = "D50 5.6 mm",
     .default_words = "needed when rubber_content is below 1", .is_in_template = true},
    {.section = "specimen", .name = "rubber_grading_source", .slot = &specimen.rubber_grading_file,
     .help = "note: the file that a list in rubber_grading was copied from; it is not read"},
    {.section = "specimen", .name = "rubber_grading",
     .slot = GradingSlot{&specimen.rubber_grading, &specimen.rubber_grading_file},
     .help = "CSV file, or list of [sieve size, fraction passing by mass]", .published = "D50 3.7 mm",
     .default_words = "needed when rubber_content is above 0", .is_in_template = true},
    {.section = "specimen", .name = "clump_templates_source", .slot = &specimen.clump_templates_file,
     .help = "note: the file that a list in clump_templates was copied from; it is not read"},
    // Before the key that names the shapes, so that those of the file are known there.
    {.section = "specimen", .name = "clump_templates",
     .slot = ClumpTemplatesSlot{&specimen.clump_templates, &specimen.clump_templates_file},
     .help = "shapes of your own: CSV file, or list of pebbles [shape, x, y, z, radius] in any unit of length",
     .default_words = "none but the shipped shapes"},
    {.section = "specimen", .name = "clump_shapes", .slot = ShapeNamesSlot{&specimen.clump_shapes, &specimen},
     .help = "shapes of the gravel grains, shipped or from clump_templates",
     .choices = {"T1", "T2", "T3", "T4", "T5", "T6", "sphere"}},
    {.section = "specimen", .name = "clump_shares", .slot = &specimen.clump_shares, .range = {1e-4, 1},
     .help = "share of the gravel's volume of each of clump_shapes, in their order; together 1",
     .default_words = "equal shares"},
    {.section = "specimen", .name = "gravel_clumps", .slot = &specimen.gravel_clumps, .range = {0, k_most_count},
     .help = "number of gravel grains", .published = "4483 at VRC 0",
     .default_words = "from box, rubber content and expected_void_ratio"},
    {.section = "specimen", .name = "rubber_grains", .slot = &specimen.rubber_grains, .range = {0, k_most_count},
     .help = "number of rubber grains", .published = "5769 at VRC 1",
     .default_words = "from box, rubber content and expected_void_ratio"},
    {.section = "specimen", .name = "expected_void_ratio", .slot = &specimen.expected_void_ratio, .range = {0.1, 3},
     .help = "void ratio at which the grains fill the height of the box",
     .default_words = "0.534 at VRC 0 to 0.782 at VRC 1, linear"},
    {.section = "specimen", .name = "generation_void_ratio", .slot = &specimen.generation_void_ratio,
     .range = {0.1, 5}, .help = "void ratio of the random fill",
     .default_words = "from generation_relative_density, by rubber content"},
    {.section = "specimen", .name = "generation_relative_density", .slot = &specimen.generation_relative_density,
     .range = {-0.5, 1.5}, .help = "relative density of the random fill between the loosest (0) and densest (1) state that "
     "the laboratory measured of the mixture"},
    {.section = "specimen", .name = "generation", .slot = &specimen.generation,
     .help = "random fill: grains grown from a fraction of their size, or of full size and overlapping, then relaxed",
     .choices = {"grown", "overlapping"}},
    {.section = "specimen", .name = "generation_friction", .slot = &specimen.generation_friction, .range = {0, 10},
     .help = "friction between grains while the random fill relaxes"},
    {.section = "specimen", .name = "approach_speed", .slot = &specimen.approach_speed, .dimension = k_speed,
     .range = {1e-5, 1}, .help = "largest speed of the plate before shear"},
    {.section = "specimen", .name = "approach_inertial_number", .slot = &specimen.approach_inertial_number,
     .range = {0, 0.1}, .help = "in branches of the search the plate may be faster than approach_speed, up to this "
     "inertial number"},
  });
}

void add_box(Keys& keys, BoxSettings& box) {
  keys.insert(keys.end(), {
    {.section = "box", .name = "length", .slot = &box.length, .dimension = k_length, .range = {0.005, 5},
     .help = "inner length, along the shear direction", .published = "100 mm", .is_in_template = true},
    {.section = "box", .name = "width", .slot = &box.width, .dimension = k_length, .range = {0.005, 5},
     .help = "inner width", .published = "100 mm", .is_in_template = true},
    {.section = "box", .name = "height", .slot = &box.height, .dimension = k_length, .range = {0.005, 5},
     .help = "nominal height of the specimen", .published = "53 mm", .is_in_template = true},
    {.section = "box", .name = "upper_height", .slot = &box.upper_height, .dimension = k_length, .range = {0.005, 10},
     .help = "height of the walls of the upper half"},
    {.section = "box", .name = "split_plane", .slot = &box.split_plane,
     .help = "where the halves part: at half of height, or of the specimen's height under its normal stress",
     .choices = {"nominal", "specimen"}},
    {.section = "box", .name = "gap", .slot = &box.gap, .dimension = k_length, .range = {0, 0.1},
     .help = "gap between the halves"},
    {.section = "box", .name = "wing", .slot = &box.wing, .dimension = k_length, .range = {0, 1},
     .help = "length of the ledges that keep grains in as the halves part"},
  });
}

void add_servo_and_equilibrium(Keys& keys, ServoSettings& servo, EquilibriumSettings& equilibrium) {
  keys.insert(keys.end(), {
    {.section = "servo", .name = "gain", .slot = &servo.gain, .range = {0.001, 1},
     .help = "share of the force error that the plate removes per step"},
    {.section = "servo", .name = "shear_speed_cap", .slot = &servo.shear_speed_cap, .dimension = k_speed,
     .range = {1e-6, 1},
     .help = "largest speed of the plate in shear, unless the shear velocity, or five times a chosen one, is larger"},
    {.section = "equilibrium", .name = "force_ratio", .slot = &equilibrium.force_ratio, .range = {1e-9, 0.1},
     .help = "mean net force on a body over mean contact force"},
    {.section = "equilibrium", .name = "branch_force_ratio", .slot = &equilibrium.branch_force_ratio,
     .range = {1e-9, 0.1}, .help = "the same in branches of the search and under load_steps, unless force_ratio is larger"},
    {.section = "equilibrium", .name = "branch_inertial_number", .slot = &equilibrium.branch_inertial_number,
     .range = {1e-9, 0.01}, .help = "there, inertial number of the plate at rest, unless plate_speed is larger"},
    {.section = "equilibrium", .name = "branch_hold_steps", .slot = &equilibrium.branch_hold_steps,
     .range = {1, 1e9}, .help = "there, at rest when all hold for so many steps, unless hold_steps is smaller"},
    {.section = "equilibrium", .name = "plate_speed", .slot = &equilibrium.plate_speed, .dimension = k_speed,
     .range = {1e-9, 0.1}, .help = "largest speed of the plate at rest"},
    {.section = "equilibrium", .name = "stress_tolerance", .slot = &equilibrium.stress_tolerance,
     .range = {1e-6, 0.5}, .help = "relative error of the normal stress"},
    {.section = "equilibrium", .name = "hold_steps", .slot = &equilibrium.hold_steps, .range = {1, 1e9},
     .help = "the specimen is at rest when all hold for so many steps"},
    {.section = "equilibrium", .name = "most_steps", .slot = &equilibrium.most_steps, .range = {1, 2e9},
     .help = "the run stops with an error when rest is not found in so many steps"},
  });
}

void add_shear_and_recording(Keys& keys, ShearSettings& shear, RecordingSettings& recording) {
  keys.insert(keys.end(), {
    {.section = "shear", .name = "normal_stress", .slot = &shear.normal_stress, .dimension = k_stress,
     .range = {100, 100e6}, .help = "normal stress on the plate", .published = "30, 60 and 100 kPa",
     .is_required = true, .is_in_template = true},
    {.section = "shear", .name = "velocity", .slot = QuantityOrWord{&shear.velocity, "quasi-static"},
     .dimension = k_speed, .range = {1e-6, 1},
     .help = "speed of the halves against each other, or \"quasi-static\": chosen for inertial_number",
     .published = "2 mm/s", .is_in_template = true},
    {.section = "shear", .name = "inertial_number", .slot = &shear.inertial_number, .range = {1e-6, k_too_fast},
     .help = "inertial number at the start of a test with velocity = \"quasi-static\"", .published = "below 1e-4",
     .default_words = "5e-5 with velocity = \"quasi-static\""},
    {.section = "shear", .name = "displacement", .slot = &shear.displacement, .dimension = k_length,
     .range = {1e-5, 1}, .help = "shear displacement at the end", .published = "14 mm", .is_in_template = true},
    {.section = "shear", .name = "moving_half", .slot = &shear.moving_half, .help = "which half of the box moves",
     .published = "lower", .choices = {"lower", "upper", "both"}, .is_in_template = true},
    {.section = "recording", .name = "interval", .slot = &recording.interval, .dimension = k_length,
     .range = {1e-7, 1}, .help = "displacement over which a row of shear.csv is averaged"},
    {.section = "recording", .name = "frame_interval", .slot = &recording.frame_interval, .dimension = k_length,
     .range = {1e-6, 1}, .help = "displacement between full states"},
    {.section = "recording", .name = "extra_frames", .slot = &recording.extra_frames, .dimension = k_length,
     .range = {0, 1}, .help = "displacements of further full states"},
    {.section = "recording", .name = "micro_interval", .slot = &recording.micro_interval, .dimension = k_length,
     .range = {1e-6, 1}, .help = "displacement between rows of micro.csv"},
  });
}

void add_compression(Keys& keys, GrainCompressionCase& compression) {
  keys.insert(keys.end(), {
    {.section = "compression", .name = "plate_velocity", .slot = &compression.plate_velocity, .dimension = k_speed,
     .range = {1e-6, 1}, .help = "speed of each of the two plates", .is_in_template = true},
    {.section = "compression", .name = "strain", .slot = &compression.strain, .range = {0.001, 0.8},
     .help = "compression at the end, fraction of the outer height of the grain", .is_in_template = true},
    {.section = "compression", .name = "records", .slot = &compression.records, .range = {2, 1e6},
     .help = "number of rows of the curve", .is_in_template = true},
  });
}

Keys common_head(std::string_view test, std::string& name) {
  return {
    {.section = "", .name = "test", .slot = TestName{test}, .help = "which test",
     .choices = {"direct_shear", "grain_compression"}, .is_in_template = true},
    {.section = "", .name = "name", .slot = &name, .help = "name of the case in results and reports",
     .is_in_template = true},
  };
}

}  // namespace

Schema case_schema(DirectShearCase& c) {
  Keys keys = common_head("direct_shear", c.name);
  keys.insert(keys.end(), {
    {.section = "", .name = "seed", .slot = &c.seed, .help = "number that all random draws follow from",
     .is_in_template = true},
  });
  add_specimen(keys, c.specimen);
  add_box(keys, c.box);
  keys.insert(keys.end(), {
    {.section = "gravel", .name = "density", .slot = &c.gravel.density, .dimension = k_density, .range = {100, 20000},
     .help = "density of the solid", .published = "2710 kg/m3"},
  });
  add_elasticity(keys, "gravel", c.gravel, "0.72", "90 MPa", "0.3");
  add_rubber(keys, c.rubber);
  keys.insert(keys.end(), {
    {.section = "rubber", .name = "solid_density", .slot = &c.rubber_solid_density, .dimension = k_density,
     .range = {100, 20000}, .help = "density of bulk rubber; solid volume of a grain = mass / this",
     .published = "1150 kg/m3"},
  });
  add_bond(keys, c.bond);
  add_elasticity(keys, "walls", c.walls, "0.70", "80 GPa", "0.25");
  keys.insert(keys.end(), {
    {.section = "walls", .name = "plate_roughness", .slot = &c.box.plate_roughness, .dimension = k_length,
     .range = {0, 0.1}, .help = "height of ribs across the shear direction on both plates; 0: smooth plates"},
    {.section = "walls", .name = "plate_roughness_pitch", .slot = &c.box.plate_roughness_pitch, .dimension = k_length,
     .range = {0, 1}, .help = "distance of the ribs; 0: twice their height, flanks at 45 degrees"},
  });
  add_contact_and_integration(keys, c.contact, c.integration);
  add_servo_and_equilibrium(keys, c.servo, c.equilibrium);
  add_shear_and_recording(keys, c.shear, c.recording);
  return {{{"specimen", "what the box is filled with, and how"}, {"box", "inner dimensions of the shear box"},
           {"gravel", "material of the gravel"}, {"rubber", "material of the rubber balls"},
           {"rubber.bond", "bonds inside a rubber grain"}, {"walls", "material of the walls and plates"},
           {"contact", "unbonded contacts"}, {"integration", "time step and damping"},
           {"servo", "keeps the normal stress"}, {"equilibrium", "when the specimen counts as being at rest"},
           {"shear", "the shear test"}, {"recording", "what is written during shear"}},
          std::move(keys)};
}

Schema case_schema(GrainCompressionCase& c) {
  Keys keys = common_head("grain_compression", c.name);
  keys.insert(keys.end(), {
    {.section = "rubber", .name = "ball_radius", .slot = &c.ball_radius, .dimension = k_length, .range = {1e-6, 0.1},
     .help = "radius of the 35 balls; the grain passes a sieve of 5.899 times that", .published = "0.627 mm",
     .is_in_template = true},
  });
  add_rubber(keys, c.rubber);
  add_bond(keys, c.bond);
  add_elasticity(keys, "walls", c.walls, "0.70", "80 GPa", "0.25");
  add_contact_and_integration(keys, c.contact, c.integration);
  add_compression(keys, c);
  return {{{"rubber", "the grain and the material of its balls"}, {"rubber.bond", "bonds inside the grain"},
           {"walls", "material of the two plates"}, {"contact", "unbonded contacts"},
           {"integration", "time step and damping"}, {"compression", "the compression of the grain"}},
          std::move(keys)};
}
// clang-format on

}  // namespace dem
