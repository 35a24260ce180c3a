// SPDX-License-Identifier: BSD-3-Clause
#include "own_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/engine/observe.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem {
namespace {

constexpr std::int64_t k_numbers_interval = 100, k_watch_interval = 500;  // steps, as in a shear test
constexpr double k_longest_over_chosen = 2.0;

void set_grain_motion(Simulation& s, const GrainStart& start) {
  if (!start.is_rubber) {
    verify::set_motion(s, static_cast<std::size_t>(start.number), start.velocity, start.spin);
    return;
  }
  const Vec3 centre = body_position(s, start.number);
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    const int i = BallStore::rubber_index(start.number, slot);
    s.balls.set_velocity(i, start.velocity + cross(start.spin, s.balls.position(i) - centre));
    s.balls.set_spin(i, start.spin);
  }
}

double distance_of(const Wall& a, const Wall& b) { return std::fabs(dot(b.corner - a.corner, a.normal)); }

}  // namespace

Vec3 velocity_at(const WallMotion& motion, double time) {
  const auto after = std::upper_bound(motion.times.begin(), motion.times.end(), time);
  if (after == motion.times.begin()) return motion.velocities.front();
  if (after == motion.times.end()) return motion.velocities.back();
  const auto k = static_cast<std::size_t>(after - motion.times.begin());
  const double share = (time - motion.times[k - 1]) / (motion.times[k] - motion.times[k - 1]);
  return motion.velocities[k - 1] * (1.0 - share) + motion.velocities[k] * share;
}

/// Materials of the published model; what a user does not set is that of a shear test.
OwnTest::OwnTest() {
  scene = materials_of(DirectShearCase{});
  scene.rubber_ball_radius = 0.627e-3;
}

void OwnTest::build() {
  if (is_built()) return;
  auto built = std::make_unique<Simulation>(scene);
  for (const GrainStart& start : starts) set_grain_motion(*built, start);
  simulation_ = std::move(built);
  if (fixed_step_ > 0.0) simulation_->set_time_step(fixed_step_);
}

Simulation& OwnTest::state() {
  build();
  return *simulation_;
}

void OwnTest::fix_time_step(double seconds) {
  if (!(seconds > 0.0) || !std::isfinite(seconds)) throw InputError("the time step must be positive");
  fixed_step_ = seconds;
  longest_step_ = 0.0;
  if (!is_built()) return;
  simulation_->steps == 0 ? simulation_->set_time_step(seconds) : simulation_->change_time_step(seconds);
}

double OwnTest::choose_time_step(double stress) {
  if (!(stress > 0.0) || !std::isfinite(stress)) throw InputError("the stress for a time step must be positive");
  const TimeStepLimit limit = dem::choose_time_step(state(), stress);
  fix_time_step(limit.seconds);
  longest_step_ = k_longest_over_chosen * limit.seconds;
  return limit.seconds;
}

/// The wall moves over a step with what the table says for the middle of it.
void OwnTest::lead_walls() {
  Simulation& s = *simulation_;
  for (const WallMotion& motion : motions) {
    s.walls[static_cast<std::size_t>(motion.wall)].velocity = velocity_at(motion, s.time + 0.5 * s.dt);
  }
}

void OwnTest::load_plates() {
  Simulation& s = *simulation_;
  s.more_servos.resize(plates.size());
  for (std::size_t k = 0; k < plates.size(); ++k) {
    PlateServo servo = plates[k].servo;
    const std::array<int, 4>& sides = plates[k].sides;
    if (sides[0] >= 0) {
      const auto wall = [&](std::size_t i) -> const Wall& { return s.walls[static_cast<std::size_t>(sides[i])]; };
      servo.target_force = plates[k].stress * distance_of(wall(0), wall(1)) * distance_of(wall(2), wall(3));
    }
    s.more_servos[k] = servo;
  }
}

void OwnTest::watch() {
  constexpr double k_far = std::numeric_limits<double>::max();
  const std::array<Bounds, 1> everywhere{Bounds{{-k_far, -k_far, -k_far}, {k_far, k_far, k_far}}};
  const Trouble trouble = find_trouble(*simulation_, everywhere, k_overlap_limit);
  if (trouble.kind != TroubleKind::none) {
    throw PhysicsError(
        fmt::format("{} (step {}). Try a shorter time step or a slower motion", trouble.text, simulation_->steps));
  }
}

void OwnTest::run(std::int64_t steps, const volatile std::sig_atomic_t& stop) {
  Simulation& s = state();
  if (!(s.dt > 0.0)) throw InputError("no time step was chosen: set time_step, or call choose_time_step(stress)");
  for (std::int64_t k = 0; k < steps && stop == 0; ++k) {
    lead_walls();
    load_plates();
    s.step();
    if (longest_step_ > 0.0) review_time_step(s, longest_step_);
    if (s.steps % k_watch_interval == 0 || (s.steps % k_numbers_interval == 0 && !has_only_numbers(s))) watch();
  }
}

InUse::InUse(OwnTest& test) : test_(test) {
  if (test.is_in_use.exchange(true)) {
    throw Error(
        ExitCode::usage,
        "another thread works with this simulation (in a forked process: a thread of the parent did when it was "
        "forked); every thread needs a simulation of its own");
  }
}

}  // namespace dem
