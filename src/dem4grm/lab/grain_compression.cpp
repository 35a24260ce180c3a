// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/grain_compression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/observe.hpp"

namespace dem {

Scene lone_grain(const GrainCompressionCase& test) {
  Scene scene;
  scene.gravel = DirectShearCase{}.gravel;  // not used, but a scene has it
  scene.rubber = test.rubber;
  scene.walls = test.walls;
  scene.bond = test.bond;
  scene.contact = test.contact;
  scene.integration = test.integration;
  scene.rubber_ball_radius = test.ball_radius;
  scene.grains.push_back({});
  return scene;
}

namespace {

constexpr double k_ramp_strain = 0.002;  // over which the plates reach their velocity

Scene scene_of(const GrainCompressionCase& test, double height) {
  Scene scene = lone_grain(test);
  const double half = 2.0 * height;
  scene.wall_list.push_back(
      make_wall("lower plate", {-half, -half, -0.5 * height}, {2 * half, 0, 0}, {0, 2 * half, 0}));
  scene.wall_list.push_back(make_wall("upper plate", {-half, -half, 0.5 * height}, {0, 2 * half, 0}, {2 * half, 0, 0}));
  for (Wall& w : scene.wall_list) w.friction = test.walls.friction;
  return scene;
}

/// Edge lengths of the inner cube of the eight cell centres: along the axis of loading and across it (mean of both), m.
struct InnerCube {
  double along = 0.0, across = 0.0;
};

InnerCube inner_cube(const Simulation& s) {
  InnerCube c;
  for (int slot = k_grain_corners; slot < k_grain_balls; ++slot) {
    const Vec3 site = grain_site(slot), p = s.balls.position(BallStore::rubber_index(0, slot));
    c.along += p.z * (site.z > 0 ? 0.25 : -0.25);
    c.across += 0.5 * (p.x * (site.x > 0 ? 0.25 : -0.25) + p.y * (site.y > 0 ? 0.25 : -0.25));
  }
  return c;
}

/// formula:  nu = -(D - D0)/D0 * L0/(L - L0)      secant Poisson's ratio, D across and L along the load
/// Source: Chew et al. (2022) Eq. 6 with both changes signed.
double poisson_ratio(const InnerCube& now, double rest) {
  const double along = now.along - rest;
  return along == 0.0 ? 0.0 : -((now.across - rest) / rest) * rest / along;
}

int closed_second_neighbours(const Simulation& s) {
  int closed = 0;
  for (const SlotPair& p : k_second_neighbours_of_grain) {
    const Vec3 d =
        s.balls.position(BallStore::rubber_index(0, p.j)) - s.balls.position(BallStore::rubber_index(0, p.i));
    closed += norm(d) < 2.0 * s.scene.rubber_ball_radius ? 1 : 0;
  }
  return closed;
}

/// Least-squares slope of load against displacement for rows with a strain in [low, high].
double stiffness_between(const std::vector<CompressionRow>& rows, double low, double high) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (const CompressionRow& r : rows) {
    if (r.strain < low || r.strain > high) continue;
    n += 1.0, sx += r.displacement, sy += r.load, sxx += r.displacement * r.displacement,
        sxy += r.displacement * r.load;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 0.0 ? (n * sxy - sx * sy) / spread : std::numeric_limits<double>::quiet_NaN();
}

void read_curve(GrainCompressionResult& out) {
  out.initial_stiffness = stiffness_between(out.rows, 0.02, 0.08);
  const double end = out.rows.empty() ? 0.0 : out.rows.back().strain;
  out.late_stiffness = stiffness_between(out.rows, 0.75 * end, end);
  double sum = 0.0, n = 0.0;
  for (const CompressionRow& r : out.rows) {
    if (r.closed_second_neighbours > 0 && out.knee_strain == 0.0) out.knee_strain = r.strain;
    if (r.strain < 0.02 || r.strain > 0.08) continue;
    sum += r.poisson_ratio;
    n += 1.0;
  }
  out.poisson_ratio_initial = sum / n;
}

}  // namespace

GrainCompressionResult run_grain_compression(const GrainCompressionCase& test, LabObserver& observer) {
  const double lattice = k_grain_lattice * test.ball_radius;
  GrainCompressionResult out;
  out.grain_height = 2.0 * lattice + 2.0 * test.ball_radius;
  Simulation s(scene_of(test, out.grain_height));
  out.time_step_limit = choose_time_step(s, 0.0);
  s.set_time_step(out.time_step_limit.seconds);
  out.time_step = s.dt;
  const double reach = 4.0 * out.grain_height;
  const std::array room{Bounds{{-reach, -reach, -reach}, {reach, reach, reach}}};

  double approach = 0.0, load = 0.0;
  int summed = 0;
  observer.frame(s, {0, 0.0, s.state_hash()});
  for (int record = 1; record <= test.records;) {
    const double ramp = std::clamp(s.time * test.plate_velocity / (k_ramp_strain * out.grain_height), 0.05, 1.0);
    const double v = test.plate_velocity * ramp;
    s.walls[0].velocity = {0, 0, v};
    s.walls[1].velocity = {0, 0, -v};
    s.step();
    approach += 2.0 * v * s.dt;
    load += 0.5 * (s.reactions[1].force.z - s.reactions[0].force.z);
    ++summed;
    if (approach < test.strain * out.grain_height * record / test.records) continue;
    const Trouble trouble = find_trouble(s, room, 1.5);
    if (trouble.kind != TroubleKind::none) {
      throw PhysicsError(fmt::format("{} at {:.1f} % strain", trouble.text, 100.0 * approach / out.grain_height));
    }
    CompressionRow row;
    row.displacement = approach;
    row.strain = approach / out.grain_height;
    row.load = load / summed;
    row.poisson_ratio = poisson_ratio(inner_cube(s), lattice);
    row.closed_second_neighbours = closed_second_neighbours(s);
    row.energy = s.energy();
    out.rows.push_back(row);
    observer.compression_row(row);
    Progress p;
    p.stage = "compression";
    p.fraction = static_cast<double>(record) / test.records;
    p.displacement = approach;
    p.steps = s.steps;
    p.time_step = s.dt;
    observer.progress(p);
    load = 0.0;
    summed = 0;
    ++record;
  }
  observer.frame(s, {1, approach, s.state_hash()});
  read_curve(out);
  out.steps = s.steps;
  out.state_hash = s.state_hash();
  return out;
}

}  // namespace dem
