// SPDX-License-Identifier: BSD-3-Clause
// Cases: bodies that nothing touches, held against Euler's and Jacobi's solutions of the free top.
#include <algorithm>
#include <cmath>
#include <vector>

#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/free_top.hpp"
#include "dem4grm/verify/rolling.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr const char* k_mechanics = "Landau & Lifshitz, Mechanics, 37 (Jacobi's solution)";

/// Moments 1 : 2 : 3 and a spin close to the border between turning about the first and about the third axis.
AsymmetricTop near_separatrix() { return asymmetric_top({1e-9, 2e-9, 3e-9}, 100, 60); }

/// Largest departure of the spin from Jacobi's over the time, over the initial spin.
double worst_departure(const AsymmetricTop& top, double dt, double time, Picture* picture) {
  Simulation s = free_body(top.inertia, {top.w1, 0, top.w3}, dt);
  const double scale = std::sqrt(top.w1 * top.w1 + top.w3 * top.w3);
  const int n = static_cast<int>(std::lround(time / dt)), every = std::max(1, n / 120);
  double worst = 0.0;
  for (int k = 1; k <= n; ++k) {
    s.step();
    const Vec3 now = body_spin(clump(s, 0)), exact = top.spin(s.time);
    worst = std::max(worst, norm(now - exact) / scale);
    if (picture == nullptr || k % every != 0) continue;
    const double values[] = {now.x, now.y, now.z, exact.x, exact.y, exact.z};
    for (std::size_t i = 0; i < 6; ++i) {
      picture->series[i].x.push_back(s.time);
      picture->series[i].y.push_back(values[i]);
    }
  }
  return worst;
}

/// Mean time between second next passages of the middle spin through zero, s.
double flip_period(const AsymmetricTop& top, double dt) {
  Simulation s = free_body(top.inertia, {top.w1, 0, top.w3}, dt);
  std::vector<double> passages;
  double before = body_spin(clump(s, 0)).y;
  while (passages.size() < 5 && s.steps < 200000) {
    s.step();
    const double now = body_spin(clump(s, 0)).y;
    if (before * now < 0.0) passages.push_back(s.time - dt * now / (now - before));
    before = now;
  }
  return passages.size() < 5 ? 0.0 : 0.5 * (passages[4] - passages[0]);
}

void run_asymmetric_top(Findings& f) {
  const AsymmetricTop top = near_separatrix();
  Picture picture{"free-top-spin",
                  "Spin of a free body with moments 1 : 2 : 3",
                  "time (s)",
                  "spin in body axes (rad/s)",
                  {{"axis 1", false, {}, {}},
                   {"axis 2", false, {}, {}},
                   {"axis 3", false, {}, {}},
                   {"axis 1, Jacobi", true, {}, {}},
                   {"axis 2, Jacobi", true, {}, {}},
                   {"axis 3, Jacobi", true, {}, {}}}};
  f.absolute("spin in body axes over two periods, largest departure over the initial spin", "1", 0.0,
             worst_departure(top, 1e-5, 2.0 * top.period(), &picture), 5e-6, k_mechanics);
  f.picture(picture);
  f.relative("period of the flips of the middle axis", "s", top.period(), flip_period(top, 2e-5), 3e-6, k_mechanics);

  const double coarse = worst_departure(top, 4e-4, top.period(), nullptr);
  const double middle = worst_departure(top, 2e-4, top.period(), nullptr);
  const double fine = worst_departure(top, 1e-4, top.period(), nullptr);
  f.absolute("error at dt = 0.4 ms over error at 0.2 ms", "1", 4.0, coarse / middle, 0.01, "order dt^2 of the scheme");
  f.absolute("error at dt = 0.2 ms over error at 0.1 ms", "1", 4.0, middle / fine, 0.01, "order dt^2 of the scheme");
}

double rotation_energy(const Clump& c) { return 0.5 * dot(c.angular_momentum, rotate(c.orientation, body_spin(c))); }

void run_long_flight(Findings& f) {
  Simulation s = free_body({1e-9, 2e-9, 3e-9}, {10, 100, 10}, 1e-4);
  const Vec3 momentum = clump(s, 0).angular_momentum;
  const double energy = rotation_energy(clump(s, 0));
  double worst_first = 0.0, worst_later = 0.0, worst_spin = 0.0, worst_norm = 0.0;
  const int n = 20000;
  for (int k = 0; k < n; ++k) {
    const Quaternion before = clump(s, 0).orientation;
    s.step();
    const Clump& c = clump(s, 0);
    const double error = std::abs(rotation_energy(c) / energy - 1.0);
    double& worst = k < n / 4 ? worst_first : worst_later;
    worst = std::max(worst, error);
    const Quaternion q = c.orientation, turn = q * conjugate(before);
    worst_norm = std::max(worst_norm, std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0));
    const Vec3 turned = Vec3{turn.x, turn.y, turn.z} * (2.0 / (turn.w * s.time_step()));
    worst_spin = std::max(worst_spin, norm(c.spin - turned) / norm(c.spin));
  }
  f.absolute("change of the angular momentum over 320 turns", "kg m2/s", 0.0,
             norm(clump(s, 0).angular_momentum - momentum), 0.0, "conservation law");
  f.at_most("error of the rotation energy in the first quarter", "1", 3e-6, worst_first, "conservation law");
  f.at_most("error of the rotation energy after the first quarter over that in it", "1", 1.05,
            worst_later / worst_first, "bounded error of a symmetric splitting");
  f.at_most("error of the norm of the orientation", "1", 1e-14, worst_norm, "unit quaternion");
  f.absolute("spin of the body against the turn of its axes, largest relative difference", "1", 0.0, worst_spin, 5e-5,
             "kinematics: a turn by the angle w dt about w");
}

/// Angle of the vector b against a, turned about the axis, rad.
double angle_about(const Vec3& axis, const Vec3& a, const Vec3& b) {
  return std::atan2(dot(axis, cross(a, b)), dot(a, b) - dot(a, axis) * dot(b, axis));
}

Quaternion turn_about(const Vec3& axis, double angle) {
  return {std::cos(angle / 2), axis.x * std::sin(angle / 2), axis.y * std::sin(angle / 2),
          axis.z * std::sin(angle / 2)};
}

void run_symmetric_top(Findings& f) {
  for (const double third : {2e-9, 0.5e-9}) {
    const Vec3 inertia{1e-9, 1e-9, third}, start{30, 0, 100};
    Simulation s = free_body(inertia, start, 1e-5);
    const double momentum = norm(clump(s, 0).angular_momentum);
    const Vec3 axis = clump(s, 0).angular_momentum * (1.0 / momentum);
    const double in_space = momentum / inertia.x, in_body = (inertia.z - inertia.x) / inertia.x * start.z;
    double space_angle = 0.0, body_angle = 0.0;
    Vec3 tip{0, 0, 1}, spin = start;
    while (s.time < 0.2) {
      s.step();
      const Vec3 new_tip = frame_of(clump(s, 0).orientation).e3, new_spin = body_spin(clump(s, 0));
      space_angle += angle_about(axis, tip, new_tip);
      body_angle += angle_about({0, 0, 1}, spin, new_spin);
      tip = new_tip;
      spin = new_spin;
    }
    const std::string which = third > 1e-9 ? "I3 = 2 I1: " : "I3 = I1 / 2: ";
    f.relative(which + "precession of the axis about the angular momentum", "rad/s", in_space, space_angle / s.time,
               2e-6, "L / I1: Landau & Lifshitz, Mechanics, 33");
    f.relative(which + "precession of the spin in the body", "rad/s", in_body, body_angle / s.time, 2e-6,
               "Euler: (I3 - I1) / I1 w3");
    const Quaternion exact = turn_about(axis, in_space * s.time) * turn_about({0, 0, 1}, -in_body * s.time);
    const Quaternion off = clump(s, 0).orientation * conjugate(exact);
    f.absolute(which + "orientation after 0.2 s, angle to the exact one", "rad", 0.0,
               2.0 * std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z), 5e-6,
               "turn by L t / I1 about L and by -(I3 - I1) w3 t / I1 about the axis");
  }
}

void run_carried_pebbles(Findings& f) {
  const double size = 5e-3;
  const Vec3 start{0.01, 0.02, 0.03}, velocity{0.5, -0.3, 0.2};
  Scene scene = model_scene();
  scene.shapes.push_back(*find_clump_template("T6"));
  scene.clumps.push_back({0, size, {start, normalized({1, 2, 3, 4})}, k_gravel});
  Simulation s(scene);
  set_motion(s, 0, velocity, {50, -80, 30});
  s.set_time_step(1e-5);
  run_steps(s, 3000);
  const Clump& c = clump(s, 0);
  double worst_place = 0.0, worst_velocity = 0.0, worst_spin = 0.0;
  for (int p = 0; p < c.n_pebbles; ++p) {
    const int i = s.balls.pebble_index(p);
    const Vec3 arm = rotate(c.orientation, scene.shapes[0].pebbles[static_cast<std::size_t>(p)].position * size);
    worst_place = std::max(worst_place, norm(s.balls.position(i) - c.position - arm));
    worst_velocity = std::max(worst_velocity, norm(s.balls.velocity(i) - c.velocity - cross(c.spin, arm)));
    worst_spin = std::max(worst_spin, norm(s.balls.spin(i) - c.spin));
  }
  f.absolute("centroid after 30 ms of straight flight, distance from v t", "m", 0.0,
             norm(c.position - start - velocity * s.time), 1e-14, "Newton's first law");
  f.absolute("pebbles against the arms of the body, largest distance", "m", 0.0, worst_place, 1e-15, "rigid body");
  f.absolute("velocities of the pebbles against v + w x arm, largest difference", "m/s", 0.0, worst_velocity, 1e-4,
             "rigid body; the arms of the full step stand in for those of the half step");
  f.absolute("spins of the pebbles against that of the body, largest difference", "rad/s", 0.0, worst_spin, 0.0,
             "rigid body");
}

}  // namespace

void add_body_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"free-top", "A free body turns as Jacobi says",
       "A clump with principal moments $I_1 : I_2 : I_3 = 1 : 2 : 3$ (kg m²) flies free with the spin $(w_1, 0, w_3)$ "
       "(rad/s, body axes). With $2T$ twice the rotation energy, $L$ the angular momentum and $L^2 > 2 T I_2$,\n\n"
       "$$w = (w_1 \\,\\mathrm{cn}\\,\\tau,\\; a_2 \\,\\mathrm{sn}\\,\\tau,\\; w_3 \\,\\mathrm{dn}\\,\\tau), \\quad "
       "\\tau = t \\sqrt{\\frac{(I_3 - I_2)(L^2 - 2 T I_1)}{I_1 I_2 I_3}}, \\quad "
       "k^2 = \\frac{(I_2 - I_1)(2 T I_3 - L^2)}{(I_3 - I_2)(L^2 - 2 T I_1)},$$\n\n"
       "with the period $4 K(k)$ in $\\tau$; the spin is chosen near the border where the body flips over. Every "
       "moment of inertia and every turn of the splitting enters; the error must fall with the square of the time "
       "step.",
       Extent::quick, run_asymmetric_top});
  cases.push_back(
      {"free-flight", "Angular momentum and energy over a long flight",
       "A body with moments 1 : 2 : 3 tumbles for 320 turns with steps of 0.01 rad. Its angular momentum must stay to "
       "the last bit, the error of its energy must not grow, and the spin that the contact laws read must be that of "
       "its axes.",
       Extent::quick, run_long_flight});
  cases.push_back(
      {"free-symmetric-top", "A symmetric body precesses at Euler's rate",
       "With $I_1 = I_2$ the axis circles the angular momentum at $L / I_1$, and in the body the spin circles the axis "
       "at $(I_3 - I_1) w_3 / I_1$ (rad/s), the other way round for a slender body. Slow and fast precession and the "
       "orientation after 0.2 s depend on the moments and on the sign of every rotation.",
       Extent::quick, run_symmetric_top});
  cases.push_back({"clump-pebbles", "Pebbles follow their clump",
                   "A clump of shape T6 flies and tumbles; its pebbles must sit at the arms of its body and move with "
                   "$v + w \\times r$.",
                   Extent::quick, run_carried_pebbles});
  add_rolling_cases(cases);
}

}  // namespace dem
