// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/specimen_parts.hpp"

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quantity.hpp"
#include "dem4grm/core/space_curve.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

void describe(const GrainList& g, const SpecimenOrder& order, SpecimenReport& report) {
  double size = 0.0;
  for (const GravelGrain& grain : g.gravel) {
    const double d = grain.sieve_size;
    size += g.shapes[static_cast<std::size_t>(grain.shape)].volume * d * d * d * d;
  }
  const double total = g.solid_volume();
  report.mean_size = (size + g.rubber_volume * g.rubber_mean_size) / total;
  report.mean_density =
      (g.gravel_volume * order.materials.gravel.density + g.rubber_volume * order.solid_density) / total;
  report.rubber_content = g.rubber_content();
}

void renumber_gravel(GrainList& grains, const std::vector<int>& order) {
  const std::vector<GravelGrain> old = grains.gravel;
  std::vector<bool> is_used(old.size(), false);
  if (order.size() != old.size()) throw IoError("the saved state holds another number of gravel grains");
  for (std::size_t k = 0; k < old.size(); ++k) {
    const auto from = static_cast<std::size_t>(order[k]);
    if (from >= old.size() || is_used[from]) throw IoError("the saved state numbers its gravel grains wrongly");
    is_used[from] = true;
    grains.gravel[k] = old[from];
  }
}

std::vector<int> number_along_curve(GrainList& grains, Fill& fill) {
  const auto position_of = [](const Pose& pose) { return pose.position; };
  // Grains of several sizes keep their runs of equal size.
  if (grains.rubber_radii.empty()) sort_along_curve(fill.rubber, position_of);
  std::vector<int> order = sort_along_curve(fill.gravel, position_of);
  renumber_gravel(grains, order);
  return order;
}

Scene scene_of(const SpecimenOrder& order, const GrainList& grains, const Fill& fill) {
  Scene scene = order.materials;
  scene.rubber_ball_radius = grains.rubber_ball_radius;
  scene.rubber_ball_radii = grains.rubber_radii;
  scene.grains = fill.rubber;
  scene.shapes = grains.shapes;
  for (std::size_t k = 0; k < grains.gravel.size(); ++k) {
    scene.clumps.push_back({grains.gravel[k].shape, grains.gravel[k].sieve_size, fill.gravel[k], k_gravel});
  }
  // Fills are made between smooth plates; the crests of rough ones stand where those were.
  const double reach = ShearBox::reach_beyond_plates(order.box);
  for (PlacedClump& c : scene.clumps) c.pose.position.z += reach;
  for (Pose& pose : scene.grains) pose.position.z += reach;
  scene.wall_list = ShearBox(order.box, fill.height + 2.0 * reach).walls();
  return scene;
}

Fill fill_of_nowhere(const SpecimenOrder& order, const GrainList& grains) {
  Fill nowhere;
  nowhere.gravel.resize(grains.gravel.size());
  nowhere.rubber.resize(static_cast<std::size_t>(grains.rubber_count));
  nowhere.height = order.box.height;
  return nowhere;
}

std::string advice_for(const Trouble& trouble, const BoxSettings& box, const std::vector<Wall>& walls) {
  if (trouble.kind != TroubleKind::outside || box.gap == 0.0) return {};
  const auto [lower, upper] = ShearBox::rooms_of(walls);
  const double gap_begin = upper.low.z, gap_end = lower.high.z;
  if (trouble.place.z < gap_begin || trouble.place.z > gap_end) return {};
  return fmt::format(". It is on its way out through the gap between the halves; make box.gap ({}) smaller",
                     format_quantity(box.gap, Dimension::length));
}

FrictionTable preparation_friction(double friction) {
  FrictionTable t;
  for (auto& row : t.between_grains) row.fill(friction);
  t.against_walls.fill(friction);
  return t;
}

}  // namespace dem
