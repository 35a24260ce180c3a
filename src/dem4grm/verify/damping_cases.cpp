// SPDX-License-Identifier: BSD-3-Clause
// Cases: local damping of clumps and of the balls of rubber grains.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/scenes.hpp"
#include "dem4grm/verify/servo.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr double k_overlap_share = 8e-3;  // overlap on each plate over the radius
constexpr double k_speed = 1e-4;          // m/s: the swing is some nanometres, the spring linear
constexpr int k_steps_per_period = 4000;

/// Plates across and below a ball at the centre, pressed into it, too small to reach anything else.
void add_plates(Scene& scene, const Vec3& centre, double radius, bool sides) {
  const double reach = radius * (1.0 - k_overlap_share), half = 0.1 * radius;
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const auto plate = [&](const char* name, const Vec3& u, const Vec3& v) {
    const Vec3 middle = centre - cross(u, v) * reach;
    scene.wall_list.push_back(make_wall(name, middle - (u + v) * half, u * (2 * half), v * (2 * half)));
    scene.wall_list.back().friction = 0.7;
  };
  plate("floor", x, y);
  plate("lid", y, x);
  if (!sides) return;
  plate("left", y, z);
  plate("right", z, y);
}

/// A ball between plates that swings on their contact springs.
struct Swing {
  Simulation s;
  int ball = 0;      ///< index
  Vec3 centre;       ///< m
  double stiffness;  ///< N/m, of one contact
};

double plate_stiffness(const MaterialSettings& grain, const MaterialSettings& plate, double radius) {
  const double compliance =
      (1 - grain.poisson_ratio) / (2 * grain.shear_modulus) + (1 - plate.poisson_ratio) / (2 * plate.shear_modulus);
  return 2.0 / compliance * radius * std::sqrt(k_overlap_share);  // 2 E* sqrt(R d), Hertz
}

Swing swinging_sphere(double damping, bool sides) {
  Scene scene = model_scene();
  scene.integration.local_damping = damping;
  const Vec3 centre{0, 0, 0.01};
  const double radius = 2.5e-3;
  if (sides) scene.gravel.friction = 0.0;
  add_plates(scene, centre, radius, sides);
  add_sphere(scene, centre, radius);
  return {Simulation(scene), 0, centre, plate_stiffness(scene.gravel, scene.walls, radius)};
}

/// One ball of a grain whose bonds are next to nothing, between plates that touch no other ball.
Swing swinging_rubber_ball(double damping, bool sides) {
  Scene scene = model_scene();
  scene.integration.local_damping = damping;
  scene.bond.modulus = 1e-3;
  scene.bond.damping_ratio = 0.0;
  scene.grains = {{{0, 0, 0.01}, {}}};
  if (sides) scene.rubber.friction = 0.0;
  const int ball = BallStore::rubber_index(0, 0);
  const Vec3 centre = Simulation(scene).balls.position(ball);
  add_plates(scene, centre, scene.rubber_ball_radius, sides);
  return {Simulation(scene), ball, centre, plate_stiffness(scene.rubber, scene.walls, scene.rubber_ball_radius)};
}

double mass_of(const Swing& w) { return w.s.clumps.clumps.empty() ? w.s.rubber().ball_mass : clump(w.s, 0).mass; }

void throw_ball(Swing& w, const Vec3& velocity, const Vec3& spin) {
  if (!w.s.clumps.clumps.empty()) {
    set_motion(w.s, 0, velocity, spin);
  } else {
    w.s.balls.set_velocity(w.ball, velocity);
    w.s.balls.set_spin(w.ball, spin);
  }
}

/// Turning points and the largest speeds between them, of one coordinate.
struct Record {
  std::vector<double> peaks, speeds;
  double place = 0.0, rate = 0.0, fastest = 0.0;
  void add(double new_place, double new_rate) {
    if (rate * new_rate < 0.0) {
      peaks.push_back(std::abs(place));
      speeds.push_back(fastest);
      fastest = 0.0;
    }
    fastest = std::max(fastest, std::abs(new_rate));
    place = new_place;
    rate = new_rate;
  }
  /// Mean factor of each half swing, over the swings after the first.
  [[nodiscard]] static double factor(const std::vector<double>& v) {
    return v.size() < 5 ? 0.0 : std::pow(v[4] / v[1], 1.0 / 3.0);
  }
};

double damping_loss(const Simulation& s) { return s.energy().local_damping; }

double stored(const Simulation& s) {
  const EnergyReport e = s.energy();
  return e.kinetic + e.contact_strain;
}

void check_translation(Findings& f, const std::string& body, Swing w, double alpha) {
  w.s.set_time_step(2 * k_pi / std::sqrt(2 * w.stiffness / mass_of(w)) / k_steps_per_period);
  throw_ball(w, {0, 0, k_speed}, {});
  Record record;
  w.s.step();
  const double start = stored(w.s), lost = damping_loss(w.s);
  while (record.peaks.size() < 5 && w.s.steps < 6 * k_steps_per_period) {
    w.s.step();
    record.add(w.s.balls.position(w.ball).z - w.centre.z, w.s.balls.velocity(w.ball).z);
  }
  const double kept = (1 - alpha) / (1 + alpha), swing = 0.5 * mass_of(w) * k_speed * k_speed;
  const std::string what = fmt::format("{}, damping {}: ", body, alpha);
  f.relative(what + "amplitude kept by a half swing", "1", std::sqrt(kept), Record::factor(record.peaks), 1e-4,
             "in against (1 - a) of the spring, out against (1 + a)");
  f.relative(what + "kinetic energy kept by a half swing", "1", kept, std::pow(Record::factor(record.speeds), 2), 1e-4,
             "in against (1 - a) of the spring, out against (1 + a)");
  f.absolute(what + "booked loss over the energy that is missing", "1", (start - stored(w.s)) / swing,
             (damping_loss(w.s) - lost) / swing, 1e-4, "conservation of energy");
}

void check_spin(Findings& f, const std::string& body, Swing w, double alpha) {
  // Two shear springs at lever r against I = 2/5 m r^2; k_s / k_n = 2 (1 - nu) / (2 - nu) lies between 2/3 and 1.
  w.s.set_time_step(2 * k_pi / std::sqrt(5 * w.stiffness / mass_of(w)) / (4 * k_steps_per_period));
  const double radius = w.s.balls.radius_of_id(0);
  throw_ball(w, {}, {k_speed / radius, 0, 0});
  Record record;
  double turn = w.s.balls.spin(w.ball).x * w.s.time_step();  // the springs count the step before the start
  while (record.peaks.size() < 5 && w.s.steps < 25 * k_steps_per_period) {
    w.s.step();
    turn += w.s.balls.spin(w.ball).x * w.s.time_step();
    record.add(turn, w.s.balls.spin(w.ball).x);
  }
  f.relative(fmt::format("{}, damping {}: turn kept by a half swing", body, alpha), "1",
             std::sqrt((1 - alpha) / (1 + alpha)), Record::factor(record.peaks), 3e-4,
             "in against (1 - a) of the couple, out against (1 + a)");
}

/// Two swings at once, across and along, of different size: each must fade as if it were alone.
void check_components(Findings& f, const std::string& body, Swing w, double alpha) {
  w.s.set_time_step(2 * k_pi / std::sqrt(2 * w.stiffness / mass_of(w)) / k_steps_per_period);
  throw_ball(w, {0.5 * k_speed, 0, 0}, {});
  for (int k = 0; k < k_steps_per_period / 6; ++k) w.s.step();
  const Vec3 sideways = w.s.balls.velocity(w.ball);
  throw_ball(w, {sideways.x, 0, 2 * k_speed}, {});
  Record x, z;
  while (std::min(x.peaks.size(), z.peaks.size()) < 5 && w.s.steps < 6 * k_steps_per_period) {
    w.s.step();
    const Vec3 d = w.s.balls.position(w.ball) - w.centre, v = w.s.balls.velocity(w.ball);
    x.add(d.x, v.x);
    z.add(d.z, v.z);
  }
  const double kept = std::sqrt((1 - alpha) / (1 + alpha));
  const char* source = "damping acts on each global component by itself (Cundall 1987)";
  f.relative(body + ", two swings at once: amplitude kept across", "1", kept, Record::factor(x.peaks), 1e-4, source);
  f.relative(body + ", two swings at once: amplitude kept along", "1", kept, Record::factor(z.peaks), 1e-4, source);
}

Picture fading_swing(double alpha) {
  Swing w = swinging_sphere(alpha, false);
  const double rate = std::sqrt(2 * w.stiffness / mass_of(w));
  w.s.set_time_step(2 * k_pi / rate / k_steps_per_period);
  throw_ball(w, {0, 0, k_speed}, {});
  Picture p{"local-damping-swing",
            fmt::format("Swing of a sphere between two plates, local damping {}", alpha),
            "time / period without damping",
            "deflection (nm)",
            {{"simulated", false, {}, {}}, {"turning points expected", true, {}, {}}}};
  // Out: half a swing at rate sqrt(1 + a), from the middle; in: at sqrt(1 - a).
  double amplitude = k_speed / rate / std::sqrt(1 + alpha), sign = 1.0, at = 0.25 / std::sqrt(1 + alpha);
  for (int k = 0; k < 6; ++k) {
    p.series[1].x.push_back(at);
    p.series[1].y.push_back(sign * amplitude * 1e9);
    at += 0.25 / std::sqrt(1 - alpha) + 0.25 / std::sqrt(1 + alpha);
    amplitude *= std::sqrt((1 - alpha) / (1 + alpha));
    sign = -sign;
  }
  for (int k = 1; k <= 3 * k_steps_per_period; ++k) {
    w.s.step();
    if (k % 40 != 0) continue;
    p.series[0].x.push_back(static_cast<double>(k) / k_steps_per_period);
    p.series[0].y.push_back((w.s.balls.position(w.ball).z - w.centre.z) * 1e9);
  }
  return p;
}

void run_clump(Findings& f) {
  for (const double alpha : {0.2, 0.5}) {
    check_translation(f, "sphere", swinging_sphere(alpha, false), alpha);
    check_spin(f, "sphere", swinging_sphere(alpha, false), alpha);
  }
  check_components(f, "sphere", swinging_sphere(0.3, true), 0.3);
  f.picture(fading_swing(0.2));
}

void run_rubber(Findings& f) {
  for (const double alpha : {0.2, 0.5}) {
    check_translation(f, "rubber ball", swinging_rubber_ball(alpha, false), alpha);
    check_spin(f, "rubber ball", swinging_rubber_ball(alpha, false), alpha);
  }
  check_components(f, "rubber ball", swinging_rubber_ball(0.3, true), 0.3);
}

constexpr const char* k_damping_text =
    "With the damping coefficient $a$ a force component $F$ acts as $F - a |F| \\,\\mathrm{sign}(v)$. A swing on a "
    "linear spring goes out against $(1 + a) k$ and comes back on $(1 - a) k$, so each half swing keeps "
    "$\\sqrt{(1-a)/(1+a)}$ of the amplitude and $(1-a)/(1+a)$ of the energy: 0.8165 and 0.6667 at $a = 0.2$. ";

}  // namespace

void add_damping_cases(std::vector<VerificationCase>& cases) {
  cases.push_back({"local-damping-clump", "Local damping of a clump",
                   std::string(k_damping_text) +
                       "A sphere swings between two plates, up and down and about a horizontal axis on the two shear "
                       "springs; then up and sideways at once, since every component is damped by itself.",
                   Extent::quick, run_clump});
  cases.push_back({"local-damping-rubber", "Local damping of a ball of a rubber grain",
                   std::string(k_damping_text) +
                       "One corner ball of a grain with next to no bonds swings between plates that touch no other "
                       "ball: rubber balls are moved by a kernel of their own.",
                   Extent::quick, run_rubber});
  add_servo_cases(cases);
}

}  // namespace dem
