// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/specimen/fill.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/core/space_curve.hpp"
#include "dem4grm/engine/observe.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/specimen/fill_check.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {

namespace {

/// Stress that the growing grains may exert on each other; only sets the first time step.
constexpr double k_growth_stress = 50e3;
constexpr double k_growth_damping = 0.7;
const double k_growth_share = safe_share(0.8, k_growth_damping);  // of the stability limit

/// Radius over that of a ball of the sphere that fills the middle of an overlapping rubber grain. Between the outer balls
/// it stays 0.06 below what another grain's ball can touch there, so it only drives out what lies inside.
constexpr double k_core_radius = 2.9;

/// The rubber grain as a rigid clump of unit ball radius; the masses of its balls add up.
ClumpTemplate rigid_rubber_grain(Generation generation) {
  ClumpTemplate t;
  t.name = "rubber grain";
  const double ball = 4.0 / 3.0 * std::numbers::pi;
  double moment = 0.0;
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const Vec3 p = grain_site(slot) * k_grain_lattice;
    t.pebbles.push_back({p, 1.0});
    moment += ball * (0.4 + p.y * p.y + p.z * p.z);
    t.bounding_radius = std::max(t.bounding_radius, norm(p) + 1.0);
  }
  if (generation == Generation::overlapping) t.pebbles.push_back({{}, k_core_radius});
  t.volume = ball * k_grain_balls;
  t.moment_of_inertia = {moment, moment, moment};  // cubic symmetry
  return t;
}

/// All grains as clumps at full size; gravel first, then rubber.
Scene clump_scene(const GrainList& grains, const Scene& materials, Generation generation) {
  Scene scene = materials;
  scene.grains.clear();
  scene.clumps.clear();
  scene.shapes = grains.shapes;
  scene.integration.local_damping = k_growth_damping;
  for (const GravelGrain& g : grains.gravel) scene.clumps.push_back({g.shape, g.sieve_size, {}, k_gravel});
  const int rubber_shape = static_cast<int>(scene.shapes.size());
  scene.shapes.push_back(rigid_rubber_grain(generation));
  for (int g = 0; g < grains.rubber_count; ++g) {
    scene.clumps.push_back({rubber_shape, grains.ball_radius_of_rubber(g), {}, k_rubber});
  }
  return scene;
}

/// Uniform grid of spheres already placed; answers whether a new one is free.
class PlacedSpheres {
 public:
  PlacedSpheres(const Vec3& size, double largest_radius) : cell_(2.0 * largest_radius) {
    nx_ = std::max(1, static_cast<int>(size.x / cell_) + 1);
    ny_ = std::max(1, static_cast<int>(size.y / cell_) + 1);
    nz_ = std::max(1, static_cast<int>(size.z / cell_) + 1);
    cells_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_));
  }
  bool try_to_place(const Vec3& p, double radius) {
    const int cx = along(p.x, nx_), cy = along(p.y, ny_), cz = along(p.z, nz_);
    for (int z = std::max(0, cz - 1); z <= std::min(nz_ - 1, cz + 1); ++z) {
      for (int y = std::max(0, cy - 1); y <= std::min(ny_ - 1, cy + 1); ++y) {
        for (int x = std::max(0, cx - 1); x <= std::min(nx_ - 1, cx + 1); ++x) {
          for (const auto& [q, r] : cells_[index(x, y, z)]) {
            const Vec3 d = p - q;
            if (dot(d, d) < (r + radius) * (r + radius)) return false;
          }
        }
      }
    }
    cells_[index(cx, cy, cz)].emplace_back(p, radius);
    return true;
  }

 private:
  [[nodiscard]] int along(double v, int n) const { return std::clamp(static_cast<int>(v / cell_), 0, n - 1); }
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>((z * ny_ + y) * nx_ + x);
  }
  double cell_;
  int nx_ = 1, ny_ = 1, nz_ = 1;
  std::vector<std::vector<std::pair<Vec3, double>>> cells_;
};

/// Random places that keep every grain inside the box, whatever lies there already; random orientations.
void insert_overlapping(Scene& scene, const Vec3& size, std::uint64_t seed) {
  for (std::size_t k = 0; k < scene.clumps.size(); ++k) {
    PlacedClump& c = scene.clumps[k];
    const double r = c.size * scene.shapes[static_cast<std::size_t>(c.shape)].bounding_radius;
    const auto within = [r](RandomSequence& random, double length) {
      return 2.0 * r < length ? random.uniform(r, length - r) : 0.5 * length;
    };
    RandomSequence random(seed, RandomStream::grain_position, k);
    const double x = within(random, size.x), y = within(random, size.y), z = within(random, size.z);
    c.pose.position = {x, y, z};
    c.pose.orientation = RandomSequence(seed, RandomStream::grain_orientation, k).orientation();
  }
}

/// Random places for spheres around the grains at the given scale, largest first; false when one found no place.
bool insert(Scene& scene, const Vec3& size, double scale, std::uint64_t seed) {
  std::vector<double> radius(scene.clumps.size());
  for (std::size_t k = 0; k < radius.size(); ++k) {
    const PlacedClump& c = scene.clumps[k];
    radius[k] = scale * c.size * scene.shapes[static_cast<std::size_t>(c.shape)].bounding_radius;
  }
  std::vector<std::size_t> order(radius.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radius[a] > radius[b]; });
  PlacedSpheres placed(size, radius[order.front()]);
  for (const std::size_t k : order) {
    RandomSequence random(seed, RandomStream::grain_position, k);
    const double r = radius[k];
    bool done = false;
    for (int attempt = 0; attempt < 20000 && !done; ++attempt) {
      const Vec3 p{random.uniform(r, size.x - r), random.uniform(r, size.y - r), random.uniform(r, size.z - r)};
      done = placed.try_to_place(p, r);
      if (done) scene.clumps[k].pose.position = p;
    }
    if (!done) return false;
    scene.clumps[k].pose.orientation = RandomSequence(seed, RandomStream::grain_orientation, k).orientation();
  }
  return true;
}

/// Sets all grains to a fraction of their size about their centroids; masses stay those of the full size.
void set_scale(Simulation& s, double scale) {
  for (const Clump& c : s.clumps.clumps) {
    const ClumpTemplate& shape = s.scene.shapes[static_cast<std::size_t>(c.shape)];
    const Frame frame = frame_of(c.orientation);
    for (int k = 0; k < c.n_pebbles; ++k) {
      const int pebble = c.first_pebble + k;
      const Pebble& p = shape.pebbles[static_cast<std::size_t>(k)];
      const Vec3 offset = p.position * (c.size * scale);
      s.clumps.pebble_offset[static_cast<std::size_t>(pebble)] = offset;
      s.balls.set_pebble_radius(pebble, p.radius * c.size * scale);
      s.balls.set_position(s.balls.pebble_index(pebble), c.position + to_space(frame, offset));
    }
  }
  s.invalidate_candidates();
}

/// Chooses the largest time step that the present contacts allow.
void fit_time_step(Simulation& s, double longest_step) {
  const double present = k_growth_share * clump_limit(s).seconds;
  s.set_time_step(std::max(rounded_down_to_nanosecond(std::min(longest_step, present)), 1e-8));
}

/// Finds the first contacts, which the choice of a time step needs.
void take_first_step(Simulation& s) {
  s.set_time_step(1e-8);
  s.step();
}

/// A few damped time steps from rest.
void push_apart(Simulation& s, double longest_step, int steps) {
  s.reset_velocities();
  fit_time_step(s, longest_step);
  for (int k = 0; k < steps; ++k) s.step();
}

/// One growth step: from rest, until the overlaps are small again.
int grow_to(Simulation& s, double scale, double longest_step, const FillSettings& settings) {
  set_scale(s, scale);
  s.reset_velocities();
  int steps = 0;
  do {
    fit_time_step(s, longest_step);
    for (int k = 0; k < settings.steps_per_growth; ++k) s.step();
    steps += settings.steps_per_growth;
  } while (steps < settings.most_steps_per_growth && worst_overlap(s).largest > settings.growth_overlap);
  return steps;
}

/// One round of relaxation at full size. Throws PhysicsError when there were too many.
void relax(Simulation& s, double longest_step, const FillSettings& settings, FillState& state) {
  const double seen = worst_overlap(s).largest;
  if (!(seen > settings.overlap_goal)) {
    state.is_relaxed = true;
    return;
  }
  if (state.relaxation_steps >= settings.most_relaxation_steps) {
    throw PhysicsError(fmt::format(
        "the random fill did not come to rest: the largest overlap is still {:.4f} of a radius after {} steps "
        "(goal {:.4f}). Choose a larger generation_void_ratio",
        seen, state.relaxation_steps, settings.overlap_goal));
  }
  const int steps = seen > settings.deep_overlap     ? settings.steps_per_calm_deep
                    : seen > settings.growth_overlap ? settings.steps_per_calm
                                                     : settings.steps_per_reset;
  push_apart(s, longest_step, steps);
  state.relaxation_steps += steps;
  state.steps += steps;
}

void check_inside(const Simulation& s, const BoxSettings& box, double height) {
  const int outside = first_outside(s, {box.length, box.width, height});
  if (outside < 0) return;
  const Vec3& p = s.clumps.clumps[static_cast<std::size_t>(outside)].position;
  const Trouble trouble{
      TroubleKind::outside,
      fmt::format("clump {} left the box in the random fill: its centre is at ({:.2f}, {:.2f}, {:.2f}) mm", outside,
                  p.x * 1e3, p.y * 1e3, p.z * 1e3),
      p};
  const std::string advice = advice_for(trouble, box, s.walls);
  throw PhysicsError(trouble.text + (advice.empty()
                                         ? ". Choose another seed, a larger generation_void_ratio or generation = "
                                           "\"grown\""
                                         : advice));
}

/// The grains at their first places; returns their size over the full one.
double place(Scene& scene, const Vec3& size, const FillSettings& settings) {
  if (settings.generation == Generation::overlapping) {
    insert_overlapping(scene, size, settings.seed);
    return 1.0;
  }
  double scale = settings.start_scale;
  while (!insert(scene, size, scale, settings.seed)) {
    scale *= 0.9;
    if (scale < 0.1) throw PhysicsError("the grains do not fit the box even at a tenth of their size");
  }
  return scale;
}

}  // namespace

Fill make_fill(const GrainList& grains, const BoxSettings& box, const Scene& materials, const FillSettings& settings,
               const FillHooks& hooks) {
  Fill fill;
  fill.height = grains.solid_volume() * (1.0 + settings.void_ratio) / (box.length * box.width);
  if (fill.height >= box.upper_height) {
    throw PhysicsError(
        fmt::format("the loose fill would be {:.1f} mm high, but the box ends at {:.1f} mm; raise box.upper_height",
                    fill.height * 1e3, box.upper_height * 1e3));
  }
  Scene scene = clump_scene(grains, materials, settings.generation);
  BoxSettings smooth = box;
  smooth.plate_roughness = 0.0;
  scene.wall_list = ShearBox(smooth, fill.height).walls();
  const double scale = place(scene, {box.length, box.width, fill.height}, settings);
  const std::vector<int> drawn = sort_along_curve(scene.clumps, [](const PlacedClump& c) { return c.pose.position; });
  Simulation s(scene);
  FrictionTable friction;
  for (auto& row : friction.between_grains) row.fill(settings.friction);
  s.set_friction(friction);
  const double longest = rounded_down_to_nanosecond(k_growth_share * expected_clump_limit(s, k_growth_stress).seconds);
  const int growths = static_cast<int>(std::ceil((1.0 - scale) / settings.growth));
  FillState state;
  if (hooks.restore) hooks.restore(state, s);
  if (state.steps == 0 && growths == 0) {
    take_first_step(s);
    state.steps = 1;
  }
  while (!state.is_relaxed) {
    if (state.growth_steps < growths) {
      ++state.growth_steps;
      state.steps += grow_to(s, scale + (1.0 - scale) * state.growth_steps / growths, longest, settings);
    } else {
      relax(s, longest, settings, state);
    }
    const double share = state.is_relaxed ? 1.0 : static_cast<double>(state.growth_steps) / (growths + 1);
    if (hooks.between) hooks.between(share, state, s);
  }
  fill.steps = state.steps;
  check_inside(s, box, fill.height);
  const OverlapReport overlap = worst_overlap(s);
  fill.largest_overlap = overlap.largest;
  fill.caught = overlap.caught + interlocked_balls(s, static_cast<int>(scene.shapes.size()) - 1);
  fill.alignment = rubber_alignment(s);
  fill.gravel.resize(grains.gravel.size());
  fill.rubber.resize(static_cast<std::size_t>(grains.rubber_count));
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const Clump& c = s.clumps.clumps[k];
    const auto number = static_cast<std::size_t>(drawn[k]);  // gravel first, then rubber
    Pose& pose = c.material == k_gravel ? fill.gravel[number] : fill.rubber[number - fill.gravel.size()];
    pose = {c.position, c.orientation};
  }
  return fill;
}

}  // namespace dem
