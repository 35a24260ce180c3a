// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/case_facts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "dem4grm/core/quantity.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/lab/grain_compression.hpp"
#include "dem4grm/lab/shear_velocity.hpp"
#include "dem4grm/laws/inertial_number.hpp"
#include "dem4grm/runs/output_folder.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/void_ratio_defaults.hpp"

namespace dem {
namespace {

// Peak of the resident memory, measured on full-size gravel, full-size rubber and the demo: 44, 177 and 35 MB.
constexpr double k_program_bytes = 18e6, k_memory_per_ball = 750.0, k_memory_per_clump = 3200.0;

/// The grains that can limit the time step: the smallest clump of each shape (the limit grows with the size) and one
/// rubber grain, lying apart.
Scene limiting_grains(Scene scene, const GrainList& grains) {
  std::vector<std::optional<double>> smallest(grains.shapes.size());
  for (const GravelGrain& grain : grains.gravel) {
    auto& size = smallest[static_cast<std::size_t>(grain.shape)];
    size = std::min(size.value_or(grain.sieve_size), grain.sieve_size);
  }
  scene.shapes = grains.shapes;
  scene.rubber_ball_radius = grains.rubber_ball_radius;
  for (std::size_t shape = 0; shape < smallest.size(); ++shape) {
    if (!smallest[shape]) continue;
    const Vec3 place{10.0 * static_cast<double>(shape + 1), 0.0, 0.0};
    scene.clumps.push_back({static_cast<int>(shape), *smallest[shape], {place, {}}, k_gravel});
  }
  if (grains.rubber_count > 0) scene.grains.push_back({});
  return scene;
}

void describe_grains(const DirectShearCase& test, const GrainList& grains, CaseFacts& facts) {
  int pebbles = 0;
  for (const ClumpTemplate& shape : grains.shapes) {
    facts.shapes.push_back({shape.name, static_cast<int>(shape.pebbles.size()), 0, 0.0});
  }
  for (const GravelGrain& grain : grains.gravel) {
    const ClumpTemplate& shape = grains.shapes[static_cast<std::size_t>(grain.shape)];
    const double d = grain.sieve_size;
    pebbles += static_cast<int>(shape.pebbles.size());
    ShapeFacts& of_shape = facts.shapes[static_cast<std::size_t>(grain.shape)];
    ++of_shape.grains;
    of_shape.share += shape.volume * d * d * d / grains.gravel_volume;
  }
  facts.clumps = static_cast<int>(grains.gravel.size());
  facts.rubber_grains = grains.rubber_count;
  facts.balls = pebbles + grains.rubber_count * k_grain_balls;
  facts.bonds = grains.rubber_count * k_grain_bonds;
  const SpecimenReport expected = expected_specimen(test, grains);
  facts.rubber_content = expected.rubber_content;
  facts.mean_size = expected.mean_size;
  facts.mean_density = expected.mean_density;
  facts.shear_velocity = shear_velocity(test.shear, expected);
  facts.is_velocity_chosen = !test.shear.velocity;
  facts.inertial_number = inertial_number_at(facts.shear_velocity, expected, test.shear.normal_stress);
}

CaseFacts facts_of(const DirectShearCase& test) {
  const GrainList grains =
      draw_grains(test.specimen, test.box, test.rubber.density, test.rubber_solid_density, test.seed);
  check_fills_box(grains, test.specimen, test.box);
  CaseFacts facts;
  facts.test = "direct_shear";
  describe_grains(test, grains, facts);
  const TimeStepLimit limit =
      choose_time_step(Simulation(limiting_grains(materials_of(test), grains)), test.shear.normal_stress);
  facts.time_step = limit.seconds;
  facts.time_step_limited_by = limit.limited_by;
  facts.steps = std::llround(test.shear.displacement / facts.shear_velocity / limit.seconds);
  facts.rows = static_cast<int>(std::ceil(test.shear.displacement / test.recording.interval - 1e-9));
  const double vrc = test.specimen.rubber_content;
  facts.expected_void_ratio = test.specimen.expected_void_ratio.value_or(expected_void_ratio(vrc));
  facts.generation_void_ratio = generation_void_ratio(test.specimen);
  return facts;
}

CaseFacts facts_of(const GrainCompressionCase& test) {
  const TimeStepLimit limit = choose_time_step(Simulation(lone_grain(test)), 0.0);
  CaseFacts facts;
  facts.test = "grain_compression";
  facts.balls = k_grain_balls;
  facts.rubber_grains = 1;
  facts.bonds = k_grain_bonds;
  facts.time_step = limit.seconds;
  facts.time_step_limited_by = limit.limited_by;
  const double height = 2.0 * (k_grain_lattice + 1.0) * test.ball_radius;
  facts.steps = std::llround(test.strain * height / (2.0 * test.plate_velocity) / limit.seconds);
  facts.rows = test.records;
  return facts;
}

}  // namespace

CaseFacts derive_facts(const TestCase& test) {
  CaseFacts facts = std::visit([](const auto& t) { return facts_of(t); }, test);
  facts.name = case_name(test);
  facts.memory = k_program_bytes + k_memory_per_ball * facts.balls + k_memory_per_clump * facts.clumps;
  return facts;
}

JsonObject facts_as_json(const CaseFacts& f) {
  JsonObject out{{"test", f.test},
                 {"case", f.name},
                 {"balls", f.balls},
                 {"clumps", f.clumps},
                 {"rubber_grains", f.rubber_grains},
                 {"bonds", f.bonds},
                 {"time_step_s", f.time_step},
                 {"time_step_limited_by", f.time_step_limited_by},
                 {"steps", f.steps},
                 {"rows", f.rows},
                 {"memory_MB", f.memory / 1e6}};
  if (f.test != "direct_shear") return out;
  JsonList shapes;
  for (const ShapeFacts& s : f.shapes) {
    if (s.grains == 0) continue;
    shapes.emplace_back(
        JsonObject{{"shape", s.name}, {"pebbles", s.pebbles}, {"grains", s.grains}, {"share_of_gravel", s.share}});
  }
  out.push_back({"clump_shapes", shapes});
  for (JsonField& field : JsonObject{{"rubber_content", f.rubber_content},
                                     {"expected_void_ratio", f.expected_void_ratio},
                                     {"generation_void_ratio", f.generation_void_ratio},
                                     {"mean_size_mm", f.mean_size * 1e3},
                                     {"mean_density_kg_per_m3", f.mean_density},
                                     {"shear_velocity_mm_per_s", scaled_decimal(f.shear_velocity, -3)},
                                     {"is_velocity_chosen", f.is_velocity_chosen},
                                     {"inertial_number", f.inertial_number},
                                     {"is_quasi_static", f.inertial_number < k_quasi_static}}) {
    out.push_back(std::move(field));
  }
  return out;
}

}  // namespace dem
