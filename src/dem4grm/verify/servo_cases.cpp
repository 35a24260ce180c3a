// SPDX-License-Identifier: BSD-3-Clause
// Cases: the servo plate on a bed of springs, and on its way there.
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "dem4grm/specimen/rest.hpp"
#include "dem4grm/verify/scenes.hpp"
#include "dem4grm/verify/servo.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr double k_overlap = 20e-6;  // m

/// Nine spheres of two sizes, too heavy to move: nine Hertz springs under a plate, linear over a small error.
struct SpringBed {
  Simulation s;
  double force = 0.0, stiffness = 0.0;  ///< N and N/m at the start, by Hertz
};

SpringBed spring_bed(double dt) {
  Scene scene = model_scene();
  scene.gravel.density = 1e15;
  const double compliance = (1 - scene.gravel.poisson_ratio) / (2 * scene.gravel.shear_modulus) +
                            (1 - scene.walls.poisson_ratio) / (2 * scene.walls.shear_modulus);
  double force = 0.0, stiffness = 0.0;
  for (int k = 0; k < 9; ++k) {
    const double radius = k % 2 == 0 ? 2.5e-3 : 2.0e-3;
    const int column = k % 3, row = k / 3;
    add_sphere(scene, {0.01 * column, 0.01 * row, 5e-3 - radius}, radius);
    const double hertz = 4.0 / 3.0 / compliance * std::sqrt(radius);
    force += hertz * std::pow(k_overlap, 1.5);
    stiffness += 1.5 * hertz * std::sqrt(k_overlap);
  }
  scene.wall_list = {make_wall("plate", {-1, -1, 5e-3 - k_overlap}, {0, 2, 0}, {2, 0, 0})};
  SpringBed bed{Simulation(scene), force, stiffness};
  bed.s.set_time_step(dt);
  return bed;
}

double force_error(const Simulation& s) { return s.servo.target_force - s.reactions[0].force.z; }

void check_gain(Findings& f, Picture& picture, double gain, double dt, double first_error) {
  SpringBed bed = spring_bed(dt);
  bed.s.servo = {0, bed.force * (1.0 + first_error), gain, 1.0};
  bed.s.step();
  const double start = force_error(bed.s);
  std::array<double, 11> error{1.0};
  for (std::size_t k = 1; k < error.size(); ++k) {
    bed.s.step();
    error[k] = force_error(bed.s) / start;
  }
  const std::string what = fmt::format("gain {}, dt {} us: ", gain, dt * 1e6);
  f.absolute(what + "error left by one step", "1", 1.0 - gain, error[1], 2e-4, "proportional control: 1 - gain");
  f.absolute(what + "error left by three steps", "1", std::pow(1.0 - gain, 3), error[3], 5e-4, "(1 - gain)^3");
  if (gain < 2.0) {
    run_steps(bed.s, 300);
    f.absolute(what + "force error in the end, over the force", "1", 0.0, force_error(bed.s) / bed.force, 1e-9,
               "stable for gains below 2, no steady error");
  }
  Series run{fmt::format("gain {}", gain), false, {}, {}}, exact{fmt::format("1 - gain, {}", gain), true, {}, {}};
  for (std::size_t k = 0; k < error.size(); ++k) {
    run.x.push_back(static_cast<double>(k));
    run.y.push_back(error[k]);
    exact.x.push_back(static_cast<double>(k));
    exact.y.push_back(std::pow(1.0 - gain, static_cast<double>(k)));
  }
  picture.series.push_back(run);
  picture.series.push_back(exact);
}

void run_spring_bed(Findings& f) {
  SpringBed bed = spring_bed(1e-6);
  bed.s.step();
  f.relative("force of the bed", "N", bed.force, bed.s.reactions[0].force.z, 1e-9, "Hertz, nine contacts");
  f.relative("stiffness that the servo divides by", "N/m", bed.stiffness, bed.s.reactions[0].stiffness, 1e-9,
             "Hertz, tangent stiffness of nine contacts");
  Picture picture{"servo-error", "Force error of the servo plate", "step", "error / first error", {}};
  check_gain(f, picture, 0.2, 1e-6, 1e-4);
  check_gain(f, picture, 0.5, 3e-6, -1e-4);
  check_gain(f, picture, 1.0, 1e-6, 1e-4);
  check_gain(f, picture, 1.5, 1e-6, 1e-4);
  check_gain(f, picture, 2.1, 1e-6, 1e-4);
  f.picture(picture);
}

void run_approach(Findings& f) {
  Scene scene = model_scene();
  scene.gravel.density = 1e15;
  add_sphere(scene, {0, 0, 2.5e-3}, 2.5e-3);
  scene.wall_list = {make_wall("plate", {-1, -1, 6e-3}, {0, 2, 0}, {2, 0, 0})};
  Simulation s(scene);
  s.set_time_step(1e-6);
  s.servo = {0, 1.0, 0.5, 0.05};
  s.walls[0].velocity = {0.3, 0.1, 0};
  run_steps(s, 1000);
  const Vec3 corner = s.walls[0].corner;
  f.absolute("height of the plate after 1 ms at 50 mm/s", "m", 6e-3 - 50e-6, corner.z, 1e-12, "cap of the speed");
  f.absolute("way along x at 300 mm/s", "m", 0.3e-3, corner.x + 1.0, 1e-12, "the servo steers the normal alone");
  f.absolute("way along y at 100 mm/s", "m", 0.1e-3, corner.y + 1.0, 1e-12, "the servo steers the normal alone");
  const PlateLoad load{0, 2e-6, 1e5, 0.05, 0.5, 4e-9};
  f.relative("void ratio under the plate", "1", 2e-6 * corner.z / 4e-9 - 1.0, plate_void_ratio(s, load), 1e-12,
             "volume of the box over that of the solids, less 1");
  s.servo.target_force = -1.0;
  run_steps(s, 1000);
  f.absolute("height after 1 ms with a target that pulls", "m", 6e-3, s.walls[0].corner.z, 1e-12, "cap of the speed");
  s.servo.target_force = 1.0;
  double fastest = 0.0, most = 0.0;
  for (int k = 0; k < 30000; ++k) {
    s.step();
    fastest = std::max(fastest, std::abs(s.walls[0].velocity.z));
    most = std::max(most, s.reactions[0].force.z);
  }
  f.at_most("largest speed of the plate", "m/s", 0.05 * (1 + 1e-12), fastest, "cap of the speed");
  f.relative("force in the end", "N", 1.0, s.reactions[0].force.z, 1e-9, "target of the servo");
  // At the cap the plate runs 50 nm in a step, 2 k v dt / 3 = 6 mN at the contact's stiffness; the servo sees it first.
  f.at_most("largest force", "N", 1.01, most, "the servo brakes in one step");
  f.relative("stress on the plate", "Pa", 1.0 / 2e-6, plate_stress(s, load), 1e-9, "force over area");
}

}  // namespace

void add_servo_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"servo-spring-bed", "The plate servo on springs",
       "The plate lies on nine spheres that cannot move. It moves with $v = G (F_t - F) / (\\Delta t \\sum k_n)$ "
       "(m/s), "
       "$F_t$ and $F$ the wanted and the present force (N), $k_n$ the tangent stiffness of each contact (N/m), $G$ the "
       "gain: each step leaves $1 - G$ of the error, whatever the time step and the number of contacts, and none in "
       "the end. Above $G = 2$ the error grows.",
       Extent::quick, run_spring_bed});
  cases.push_back(
      {"servo-approach", "The plate servo before it touches",
       "A plate with nothing under it moves at the cap of its speed towards the grains, or away from them if it is to "
       "pull; its other components of velocity stay as they are set. Then it lands on one sphere and holds 1 N. Stress "
       "and void ratio are those of the plate's area and height.",
       Extent::quick, run_approach});
}

}  // namespace dem
