// SPDX-License-Identifier: BSD-3-Clause
// Cases: dense packings of spheres at small pressure, with and without friction.
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/specimen/fill.hpp"
#include "dem4grm/specimen/rest.hpp"
#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/packing_measures.hpp"
#include "dem4grm/verify/scenes.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr double k_diameter = 5e-3;  // m

GrainList equal_spheres(int n) {
  GrainList grains;
  grains.shapes = {sphere_template()};
  // Sizes within 3 % of each other, in an order that has nothing to do with places.
  for (int k = 0; k < n; ++k) grains.gravel.push_back({0, k_diameter * (0.97 + 0.06 * ((k * 7 % 100) + 0.5) / 100)});
  for (const GravelGrain& g : grains.gravel) grains.gravel_volume += k_pi / 6 * std::pow(g.sieve_size, 3);
  return grains;
}

Scene smooth_materials() {
  Scene scene = model_scene();
  scene.walls.friction = 0.0;
  scene.integration.local_damping = 0.3;
  return scene;
}

/// A random fill of a cube-like box at the solid fraction, relaxed without friction.
Simulation filled_box(const GrainList& grains, double side, double solid_fraction, double friction,
                      std::uint64_t seed = 1) {
  BoxSettings box;
  box.length = box.width = side;
  box.height = box.upper_height = 2.5 * side;
  Scene scene = smooth_materials();
  scene.gravel.friction = friction;
  FillSettings fill_settings;
  fill_settings.void_ratio = 1.0 / solid_fraction - 1.0;
  fill_settings.growth = 0.01;
  fill_settings.seed = seed;
  fill_settings.overlap_goal = 0.1;
  const Fill fill = make_fill(grains, box, scene, fill_settings, {});
  scene.shapes = grains.shapes;
  for (std::size_t k = 0; k < grains.gravel.size(); ++k) {
    scene.clumps.push_back({0, grains.gravel[k].sieve_size, fill.gravel[k], k_gravel});
  }
  scene.wall_list = closed_box({side, side, fill.height});
  return Simulation(scene);
}

/// The box less three diameters at every wall.
Bounds core_of(const Simulation& s, double side) {
  const double margin = 3.0 * k_diameter, top = s.walls[5].corner.z;
  return {{margin, margin, margin}, {side - margin, side - margin, top - margin}};
}

/// Mean pressure on the six walls, Pa.
double wall_pressure(const Simulation& s) {
  double sum = 0.0;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    const Wall& wall = s.walls[w];
    sum -= dot(s.reactions[w].force, wall.normal) / (wall.length_u * wall.length_v) / 6.0;
  }
  return sum;
}

struct Level {
  double pressure = 0.0;  ///< Pa, mean of the walls
  PackingState state;
};

/// All radii times the factor; masses stay.
void scale_radii(Simulation& s, double factor) {
  for (int p = 0; p < s.balls.n_pebbles; ++p) s.balls.set_pebble_radius(p, s.balls.pebble_radius(p) * factor);
  s.invalidate_candidates();
}

void relax(Simulation& s, int steps) {
  s.set_time_step(rounded_down_to_nanosecond(0.8 * clump_limit(s).seconds));
  run_steps(s, steps);
}

/// A fill blown up a little above the density of random close packing comes to rest; then the spheres shrink, step by
/// step, until they hardly press on each other.
std::vector<Level> unload(int n, double side) {
  const double filled = 0.58, blown_up = 0.62;
  Simulation s = filled_box(equal_spheres(n), side, filled, 0.0);
  scale_radii(s, std::cbrt(blown_up / filled));
  s.set_time_step(1e-6);
  s.step();
  std::vector<Level> levels;
  for (int k = 0; k < 5; ++k) {
    if (k > 0) scale_radii(s, 1.0 - 0.85 * levels.back().state.mean_overlap);
    relax(s, k == 0 ? 5000 : 2500);
    levels.push_back({wall_pressure(s), packing_state(s, core_of(s, side), 4)});
  }
  return levels;
}

/// A loose fill is compressed by its lid with friction between the spheres.
Level compress(int n, double side, double pressure, std::uint64_t seed) {
  const GrainList grains = equal_spheres(n);
  Simulation s = filled_box(grains, side, 0.52, 0.3, seed);
  s.scene.integration.local_damping = 0.3;
  s.set_time_step(choose_time_step(s, pressure).seconds);
  // The plate strains the packing by 3e-3 in the time in which the pressure moves a sphere by its own size.
  const double inertial_time = std::sqrt(clump(s, 0).mass / (pressure * k_diameter));
  const PlateLoad load{5,   side * side,          pressure, 3e-3 * s.walls[5].corner.z / inertial_time,
                       0.5, grains.solid_volume()};
  EquilibriumSettings rest;
  rest.force_ratio = 3e-3;
  rest.plate_speed = 1e-4 * k_diameter / inertial_time;
  rest.stress_tolerance = 0.01;
  rest.hold_steps = 300;
  rest.most_steps = 60000;
  RestState now;
  bring_to_rest(s, load, rest, now, [] {});
  return {wall_pressure(s), packing_state(s, core_of(s, side), 2)};
}

constexpr const char* k_source = "Agnolin & Roux (2007), Phys. Rev. E 76, 061302";

Picture picture_of(const std::vector<Level>& levels) {
  Picture p{"packing-unloading",
            "Frictionless spheres on the way to zero pressure",
            "mean overlap / diameter",
            "contacts of a sphere; 10 x solid fraction",
            {{"contacts of a sphere", false, {}, {}},
             {"10 x solid fraction", false, {}, {}},
             {"isostatic limit", true, {0.0}, {6.0}},
             {"10 x random close packing", true, {0.0}, {6.39}}}};
  for (const Level& l : levels) {
    p.series[0].x.push_back(l.state.mean_overlap);
    p.series[0].y.push_back(l.state.coordination);
    p.series[1].x.push_back(l.state.mean_overlap);
    p.series[1].y.push_back(10.0 * l.state.solid_fraction);
  }
  return p;
}

void run_frictionless(Findings& f) {
  const std::vector<Level> levels = unload(8000, 18.7 * k_diameter);
  const Level& last = levels.back();
  const double modulus = 90e6 / 0.7;  // E* of two gravel spheres, Pa
  f.at_most("mean overlap over the diameter at the end", "1", 2e-4, last.state.mean_overlap, "limit of zero pressure");
  f.at_most("pressure over E*", "1", 5e-6, last.pressure / modulus, "limit of zero pressure");
  f.absolute("solid fraction of the core", "1", 0.639, last.state.solid_fraction, 0.01, k_source);
  f.absolute("contacts of a sphere that is no rattler", "1", 6.0, last.state.coordination, 0.15,
             "isostatic: as many contacts as degrees of freedom, 2 x 3 for a sphere");
  f.at_most("share of rattlers", "1", 0.05, last.state.rattlers,
            "a few in a hundred spheres, as in all random close packings");
  f.picture(picture_of(levels));
  f.remark(
      fmt::format("{} spheres have their centres in the core. The tolerances are those of one specimen of this "
                  "size and of states that are nearly at rest; how fast the packing is made shifts its density by "
                  "some thousandths.",
                  last.state.core_spheres));
}

void run_friction(Findings& f) {
  constexpr int k_specimens = 3;
  double solid_fraction = 0.0, coordination = 0.0;
  for (std::uint64_t seed = 1; seed <= k_specimens; ++seed) {
    const PackingState state = compress(3000, 13.5 * k_diameter, 300.0, seed).state;
    solid_fraction += state.solid_fraction / k_specimens;
    coordination += state.coordination / k_specimens;
  }
  f.absolute("solid fraction of the core", "1", 0.593, solid_fraction, 0.01, k_source);
  f.absolute("contacts of a sphere that is no rattler", "1", 4.5, coordination, 0.25, k_source);
  f.remark(
      "The published packing was compressed from all sides without walls, this one by a lid in a smooth box, so the "
      "comparison is a loose one: without friction the numbers would be 0.639 and 6.0.");
}

}  // namespace

void add_packing_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"packing-smooth-spheres", "Random close packing of frictionless spheres",
       "8000 spheres of 5 mm (sizes within 3 %, so that no crystal grows) without friction are brought to rest in a "
       "closed box a little above the density at which they jam; then all radii shrink in steps until the mean overlap "
       "is some 10⁻⁴ of the diameter. In the core, three diameters from every wall, the packing must have the solid "
       "fraction of random close packing, 0.639, and six contacts for each sphere that carries load (rattlers, with "
       "fewer than four, are taken out repeatedly). A contact that pulls, slips or is counted twice would change both.",
       Extent::full, run_frictionless});
  cases.push_back({"packing-rough-spheres", "Packing of spheres with friction 0.3",
                   "Three specimens of 3000 spheres with friction 0.3 are compressed by the lid from a loose fill to "
                   "300 Pa, 2·10⁻⁶ of E*. Friction "
                   "keeps the packing looser and with fewer contacts.",
                   Extent::full, run_friction});
}

}  // namespace dem
