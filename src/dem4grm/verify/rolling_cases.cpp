// SPDX-License-Identifier: BSD-3-Clause
// Cases: a sphere that slides, rolls and runs down a slope, and a clump that slides like a sled.
#include <cmath>

#include <fmt/format.h>

#include "dem4grm/verify/rolling.hpp"
#include "dem4grm/verify/scenes.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr double k_gravity = 9.81;   // m/s2
constexpr double k_radius = 2.5e-3;  // m
constexpr double k_time_step = 5e-6;

/// Weight is no part of the engine: it is put in as a change of velocity before each step.
void step_under(Simulation& s, const Vec3& gravity) {
  for (Clump& c : s.clumps.clumps) c.velocity += gravity * s.time_step();
  s.step();
}

/// Shear and normal dashpots end the swings of the contact springs; none acts while the contact slips.
Scene damped_scene(double grain_friction, double floor_friction) {
  Scene scene = model_scene();
  scene.gravel.friction = grain_friction;
  scene.walls.friction = floor_friction;
  scene.contact.normal_damping_ratio = 0.2;
  scene.contact.shear_damping_ratio = 0.2;
  scene.contact.dashpot_mode = 2;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  scene.wall_list[0].friction = floor_friction;
  return scene;
}

/// Overlap at which n equal pebbles carry the weight of clump 0, m.
double resting_overlap(const Simulation& s, double weight_acceleration, int n) {
  return std::pow(clump(s, 0).mass * weight_acceleration / n / s.contact_parameters(0, 0, 0).hertz, 2.0 / 3.0);
}

/// A sphere that rests on the floor; its moment of inertia is factor m r^2 (kg m2).
Simulation resting_sphere(double grain_friction, double floor_friction, double weight_acceleration,
                          double factor = 0.4) {
  Scene scene = damped_scene(grain_friction, floor_friction);
  add_sphere(scene, {0, 0, k_radius}, k_radius);
  const double overlap = resting_overlap(Simulation(scene), weight_acceleration, 1);
  scene.clumps[0].pose.position.z = k_radius - overlap;
  Simulation s(scene);
  const double moment = factor * clump(s, 0).mass * k_radius * k_radius;
  s.clumps.clumps[0].inertia = {moment, moment, moment};
  s.set_time_step(k_time_step);
  return s;
}

/// Speed of the sphere's lowest point over the floor, m/s.
double slip_speed(const Simulation& s) { return clump(s, 0).velocity.x - k_radius * clump(s, 0).spin.y; }

struct Start {
  const char* what;
  double grain_friction, floor_friction, factor, speed, rim_speed;
};

void check_rolling(Findings& f, const Start& start) {
  const double friction = std::min(start.grain_friction, start.floor_friction), g = k_gravity;
  Simulation s = resting_sphere(start.grain_friction, start.floor_friction, g, start.factor);
  set_motion(s, 0, {start.speed, 0, 0}, {0, start.rim_speed / k_radius, 0});
  const double slip = start.speed - start.rim_speed;
  const double time = slip / (friction * g * (1.0 + 1.0 / start.factor));
  const double distance = start.speed * time - 0.5 * friction * g * time * time;
  double before = slip, place = 0.0, ended = 0.0, ended_at = 0.0;
  while (s.time < 1.5 * time) {
    step_under(s, {0, 0, -g});
    const double now = slip_speed(s);
    if (ended == 0.0 && now <= 0.0) {
      const double share = before / (before - now);
      ended = s.time - k_time_step * (1.5 - share);  // velocities belong to half steps
      ended_at = place + (clump(s, 0).position.x - place) * (share - 0.5);
    }
    before = now;
    place = clump(s, 0).position.x;
  }
  const std::string what = start.what;
  const char* source = "momentum and angular momentum of a sphere that slides until it rolls";
  f.relative(what + ": speed of rolling", "m/s", (start.speed + start.factor * start.rim_speed) / (1.0 + start.factor),
             clump(s, 0).velocity.x, 2e-4, source);
  f.relative(what + ": spin of rolling", "rad/s",
             (start.speed + start.factor * start.rim_speed) / (1.0 + start.factor) / k_radius, clump(s, 0).spin.y, 2e-4,
             source);
  f.relative(what + ": time of sliding", "s", time, ended, 3e-4, source);
  f.relative(what + ": distance of sliding", "m", distance, ended_at, 5e-4, source);
}

void run_rolling_start(Findings& f) {
  check_rolling(f, {"friction 0.3", 0.3, 0.9, 0.4, 0.2, 0.0});
  check_rolling(f, {"friction 0.1, that of the floor", 0.9, 0.1, 0.4, 0.1, 0.0});
  check_rolling(f, {"back spin, friction 0.3", 0.3, 0.9, 0.4, 0.1, -0.4});
  check_rolling(f, {"hollow sphere, friction 0.3", 0.3, 0.9, 2.0 / 3.0, 0.2, 0.0});
}

/// Acceleration down a slope, m/s2, and the slip speed at the end of the run, m/s.
struct Descent {
  double acceleration = 0.0, spin_acceleration = 0.0, slip = 0.0;
};

Descent run_down(double angle, double friction) {
  const Vec3 gravity{k_gravity * std::sin(angle), 0, -k_gravity * std::cos(angle)};
  Simulation s = resting_sphere(friction, 0.9, -gravity.z);
  const int half = 2000;
  for (int k = 0; k < half; ++k) step_under(s, gravity);
  const double speed = clump(s, 0).velocity.x, spin = clump(s, 0).spin.y, start = s.time;
  for (int k = 0; k < half; ++k) step_under(s, gravity);
  const double time = s.time - start;
  return {(clump(s, 0).velocity.x - speed) / time, (clump(s, 0).spin.y - spin) / time, slip_speed(s)};
}

double exact_acceleration(double angle, double friction) {
  return std::tan(angle) < 3.5 * friction ? 5.0 / 7.0 * k_gravity * std::sin(angle)
                                          : k_gravity * (std::sin(angle) - friction * std::cos(angle));
}

void run_slope(Findings& f) {
  const double friction = 0.2;
  Picture picture{"sphere-on-slope",
                  "Sphere on a slope, friction 0.2",
                  "angle of the slope (degrees)",
                  "acceleration / g",
                  {{"simulated", true, {}, {}}, {"rigid sphere", false, {}, {}}}};
  for (const double degrees : {15.0, 25.0, 33.0, 34.5, 35.5, 37.0, 45.0, 60.0}) {
    const double angle = degrees * k_pi / 180.0, exact = exact_acceleration(angle, friction);
    const bool rolls = std::tan(angle) < 3.5 * friction;
    const Descent d = run_down(angle, friction);
    const char* source = "rigid sphere on a slope: rolls while tan(angle) < 3.5 friction";
    f.relative(fmt::format("slope {} degrees: acceleration", degrees), "m/s2", exact, d.acceleration, 1e-4, source);
    f.relative(fmt::format("slope {} degrees: angular acceleration", degrees), "rad/s2",
               rolls ? exact / k_radius : 2.5 * friction * k_gravity * std::cos(angle) / k_radius, d.spin_acceleration,
               1e-4, source);
    if (rolls) f.absolute(fmt::format("slope {} degrees: slip speed", degrees), "m/s", 0.0, d.slip, 1e-5, source);
    picture.series[0].x.push_back(degrees);
    picture.series[0].y.push_back(d.acceleration / k_gravity);
  }
  for (int degrees = 5; degrees <= 70; ++degrees) {
    picture.series[1].x.push_back(degrees);
    picture.series[1].y.push_back(exact_acceleration(degrees * k_pi / 180.0, friction) / k_gravity);
  }
  f.picture(picture);
}

/// A clump of shape T1 that lies lengthwise on the floor.
Simulation sled(double friction) {
  Scene scene = damped_scene(friction, 0.9);
  scene.shapes = {*find_clump_template("T1")};
  scene.clumps = {{0, 2 * k_radius, {{0, 0, k_radius}, {}}, k_gravel}};
  const double overlap = resting_overlap(Simulation(scene), k_gravity, 2);
  scene.clumps[0].pose.position.z -= overlap;
  Simulation s(scene);
  s.set_time_step(k_time_step);
  return s;
}

void run_braking(Findings& f, double friction) {
  Simulation s = sled(friction);
  const double speed = 0.05, time = speed / (friction * k_gravity);
  set_motion(s, 0, {speed, 0, 0});
  double front = 0.0, rear = 0.0, ended = 0.0, resting_place = 0.0;
  const int first = s.balls.position(s.balls.pebble_index(0)).x > s.balls.position(s.balls.pebble_index(1)).x ? 0 : 1;
  while (s.time < 1.3 * time) {
    step_under(s, {0, 0, -k_gravity});
    if (ended == 0.0 && clump(s, 0).velocity.x <= 0.0) ended = s.time;
    if (s.time < 1.2 * time) resting_place = clump(s, 0).position.x;
    if (s.time < 0.4 * time || s.time > 0.9 * time) continue;
    front += s.contacts.force(static_cast<std::size_t>(wall_row(s, first, 0))).z;
    rear += s.contacts.force(static_cast<std::size_t>(wall_row(s, 1 - first, 0))).z;
  }
  // Half the distance of the pebbles is 0.15, the height of the centroid 0.5 of the sieve size.
  const double tilt = friction * 0.5 / 0.15;
  const std::string what = fmt::format("friction {}: ", friction);
  f.relative(what + "time to stop", "s", time, ended, 3e-4, "block on a plane: v / (friction g)");
  f.relative(what + "distance to stop", "m", 0.5 * speed * time, clump(s, 0).position.x, 1e-3,
             "block on a plane: v^2 / (2 friction g)");
  f.relative(what + "load on the front pebble over that on the rear one", "1", (1 + tilt) / (1 - tilt), front / rear,
             1e-3, "balance of moments about the centroid");
  f.absolute(what + "way after stopping, over the distance to stop", "1", 0.0,
             (clump(s, 0).position.x - resting_place) / resting_place, 1e-4, "static friction");
}

void run_pull(Findings& f, double share) {
  const double friction = 0.15, limit = friction * k_gravity;
  Simulation s = sled(friction);
  while (s.time < 0.02) step_under(s, {share * limit, 0, -k_gravity});
  const double speed = clump(s, 0).velocity.x, start = s.time;
  while (s.time < 0.04) step_under(s, {share * limit, 0, -k_gravity});
  f.absolute(fmt::format("pulled with {} of the friction: acceleration", share), "m/s2",
             std::max(0.0, share - 1.0) * limit, (clump(s, 0).velocity.x - speed) / (s.time - start), 1e-3 * limit,
             "Coulomb: rest below the limit, pull minus friction above it");
}

void run_sled(Findings& f) {
  run_braking(f, 0.15);
  run_braking(f, 0.05);
  run_pull(f, 0.95);
  run_pull(f, 1.05);
  run_pull(f, 1.5);
}

}  // namespace

void add_rolling_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"rolling-start", "A sliding sphere begins to roll",
       "A sphere of radius $r$ (m) lands flat on a floor with speed $u_0$ (m/s) and rim speed $r w_0$ under gravity "
       "$g$. With moment of inertia $c\\, m r^2$ ($c = 2/5$; $2/3$ for a hollow sphere) and friction coefficient "
       "$\\mu$, the smaller one of the two sides, it slides for\n\n"
       "$$t = \\frac{u_0 - r w_0}{\\mu g (1 + 1/c)}, \\qquad s = u_0 t - \\tfrac{1}{2} \\mu g t^2, \\qquad "
       "u = \\frac{u_0 + c\\, r w_0}{1 + c},$$\n\n"
       "and then rolls with $u$, $5/7$ of its speed if it had no spin. Time and distance depend on friction and "
       "weight, the final speed on the moment of inertia and the lever arm of the shear force. Gravity is put in by "
       "the case as a change of velocity before each step.",
       Extent::quick, run_rolling_start});
  cases.push_back(
      {"rolling-slope", "A sphere on a slope rolls or slips",
       "On a slope of angle $\\theta$ a sphere rolls without slip while $\\tan\\theta < 3.5 \\mu$, with the "
       "acceleration $\\frac{5}{7} g \\sin\\theta$; beyond, it slips with $g (\\sin\\theta - \\mu\\cos\\theta)$ and "
       "the "
       "angular acceleration $\\frac{5}{2} \\mu g \\cos\\theta / r$. At friction 0.2 the border is 34.99 degrees.",
       Extent::quick, run_slope});
  cases.push_back(
      {"sliding-clump", "A clump slides, stops and stays",
       "A clump of two pebbles lies lengthwise on a floor with friction $\\mu$. Thrown with $v$ (m/s) it stops after "
       "$v / \\mu g$ and $v^2 / 2 \\mu g$; meanwhile the front pebble carries $(b + \\mu h) / (b - \\mu h)$ times the "
       "load of the rear one, $b$ half the distance of the pebbles and $h$ the height of the centroid. Pulled along "
       "the "
       "floor it stays below $\\mu m g$ and moves with the rest of the pull above.",
       Extent::quick, run_sled});
}

}  // namespace dem
