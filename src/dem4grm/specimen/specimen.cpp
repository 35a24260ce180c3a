// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/specimen.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/core/error.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/specimen/draw_grains.hpp"
#include "dem4grm/specimen/void_ratio_defaults.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

namespace {

/// Volume-weighted mean size and density of the solids.
void describe(const GrainList& g, const SpecimenOrder& order, SpecimenReport& report) {
  double size = 0.0;
  for (const GravelGrain& grain : g.gravel) {
    const double d = grain.sieve_size;
    size += g.shapes[static_cast<std::size_t>(grain.shape)].volume * d * d * d * d;
  }
  const double rubber_size =
      g.rubber_count > 0 ? rubber_grain_size(g.rubber_ball_radius, order.materials.rubber.density, order.solid_density)
                         : 0.0;
  const double total = g.solid_volume();
  report.mean_size = (size + g.rubber_volume * rubber_size) / total;
  report.mean_density =
      (g.gravel_volume * order.materials.gravel.density + g.rubber_volume * order.solid_density) / total;
  report.rubber_content = g.rubber_content();
}

Scene scene_of(const SpecimenOrder& order, const GrainList& grains, const Fill& fill) {
  Scene scene = order.materials;
  scene.rubber_ball_radius = grains.rubber_ball_radius;
  scene.grains = fill.rubber;
  scene.shapes = grains.shapes;
  for (std::size_t k = 0; k < grains.gravel.size(); ++k) {
    scene.clumps.push_back({grains.gravel[k].shape, grains.gravel[k].sieve_size, fill.gravel[k], k_gravel});
  }
  scene.wall_list = ShearBox(order.box, fill.height).walls();
  return scene;
}

Fill fill_box(const SpecimenOrder& order, const GrainList& grains, double void_ratio,
              const std::function<void(const PreparationState&, const Simulation*)>& watch) {
  FillSettings settings;
  settings.void_ratio = void_ratio;
  settings.friction = order.specimen.generation_friction;
  settings.seed = order.seed;
  return make_fill(grains, order.box, order.materials, settings, [&](double share, std::int64_t steps) {
    PreparationState now{"fill", share, {}};
    now.rest.steps = steps;
    watch(now, nullptr);
  });
}

FrictionTable preparation_friction(double friction) {
  FrictionTable t;  // plates are smooth during preparation
  for (auto& row : t.between_grains) row.fill(friction);
  return t;
}

}  // namespace

Specimen prepare_specimen(const SpecimenOrder& order,
                          const std::function<void(const PreparationState&, const Simulation*)>& watch) {
  Specimen out;
  out.grains = draw_grains(order.specimen, order.box, order.materials.rubber.density, order.solid_density, order.seed);
  describe(out.grains, order, out.report);
  const double vrc = order.specimen.rubber_content;
  out.report.void_ratio_generated = order.specimen.generation_void_ratio.value_or(laboratory_void_ratio(vrc));
  const Fill fill = fill_box(order, out.grains, out.report.void_ratio_generated, watch);
  out.report.fill_steps = fill.steps;
  out.report.alignment_generated = fill.alignment;
  out.report.fill_overlap = fill.largest_overlap;
  out.report.caught = fill.caught;
  if (fill.caught > 0) {
    throw PhysicsError(
        fmt::format("the random fill caught {} ball centres inside other grains; choose another seed or a "
                    "larger generation_void_ratio",
                    fill.caught));
  }

  out.simulation = std::make_unique<Simulation>(scene_of(order, out.grains, fill));
  Simulation& s = *out.simulation;
  out.report.time_step = choose_time_step(s, order.normal_stress);
  s.set_time_step(out.report.time_step.seconds);
  const double area = order.box.length * order.box.width;
  out.load = {ShearBox::k_top_plate,    area, order.normal_stress, order.specimen.approach_speed, order.servo.gain,
              out.grains.solid_volume()};
  out.bounds = {{-order.box.wing, 0.0, 0.0},
                {order.box.length + order.box.wing, order.box.width, order.box.upper_height}};
  const auto look = [&](const char* stage) {
    return [&, stage](const RestState& now) {
      if (now.steps % (5 * k_rest_interval) == 0) {
        const std::string trouble = find_trouble(s, out.bounds, k_overlap_limit);
        if (!trouble.empty()) throw PhysicsError(fmt::format("{} (stage {}, step {})", trouble, stage, now.steps));
      }
      watch({stage, -1.0, now}, &s);
    };
  };

  s.set_friction(preparation_friction(order.specimen.preparation_friction));
  RestState rest = bring_to_rest(s, out.load, order.equilibrium, look("compression"));
  out.report.void_ratio_prepared = rest.void_ratio;
  out.report.compression_steps = rest.steps;

  for (const int plate : {ShearBox::k_bottom_plate, ShearBox::k_top_plate}) {
    s.walls[static_cast<std::size_t>(plate)].friction = order.materials.walls.friction;
  }
  s.set_friction(s.material_friction());
  rest = bring_to_rest(s, out.load, order.equilibrium, look("final friction"));
  out.report.void_ratio_before_shear = rest.void_ratio;
  out.report.friction_steps = rest.steps;
  out.report.height = s.walls[ShearBox::k_top_plate].corner.z;
  out.report.alignment_before_shear = rubber_alignment(s);
  return out;
}

}  // namespace dem
