// SPDX-License-Identifier: BSD-3-Clause
// Dashpots: the rebound with and without tension, the decay of a tangential oscillation, and the shear dashpot in slip.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/planar_impact.hpp"

namespace dem::verify {
namespace {

const BenchmarkMaterial k_iron{"cast iron", 100e9, 0.25, 7000};
constexpr double k_radius = 2.5e-3;

/// Restitution when the impact ends at the instant of zero force: the same substitution that makes the damped Hertz
/// impact a linear one (q = d^(5/4)) turns b into the ratio z = b sqrt(6/5) of a linear oscillator.
double restitution_without_tension(double b) {
  const double z = b * std::sqrt(1.2), w = std::sqrt(1.0 - z * z);
  return std::exp(-z / w * (k_pi - std::atan2(2.0 * z * w, 1.0 - 2.0 * z * z)));
}

struct Rebound {
  double restitution = 0.0;
  double lost = 0.0;  ///< work of the dashpots over the energy of approach
};

Rebound rebound(int mode, double b, bool at_wall) {
  const double speed = 3.9;
  ContactSettings contact;
  contact.normal_damping_ratio = b;
  contact.dashpot_mode = mode;
  const double mass = sphere_mass(k_radius, k_iron.density);
  const HertzImpact h = at_wall ? hertz_impact(mass, modulus_on_rigid(k_iron), k_radius, speed)
                                : hertz_impact(0.5 * mass, 0.5 * modulus_on_rigid(k_iron), 0.5 * k_radius, speed);
  Simulation s = at_wall ? sphere_on_plane({k_iron.settings(), k_radius, 0.0, contact}, {0, 0, -speed})
                         : two_spheres(k_iron.settings(), k_radius, speed, contact);
  const double out = strike(s, h.duration, 4000).rebound / speed;
  return {out, s.energy().dashpot / (0.5 * (at_wall ? 1.0 : 0.5) * mass * speed * speed)};
}

void normal_dashpot_modes(Findings& f) {
  for (const bool at_wall : {true, false}) {
    for (int mode = 0; mode < 4; ++mode) {
      for (const double b : {0.2, 0.5}) {
        const bool no_tension = mode == 1 || mode == 3;
        const double e =
            no_tension ? restitution_without_tension(b) : std::exp(-k_pi * b / std::sqrt(5.0 / 6.0 - b * b));
        const std::string name = fmt::format("{}, dashpot mode {}, b = {}", at_wall ? "plane" : "two spheres", mode, b);
        const Rebound got = rebound(mode, b, at_wall);
        f.absolute(name + ": restitution", "1", e, got.restitution, 5e-4,
                   no_tension ? "Schwager & Poeschel (2007), for the Hertz contact by q = d^(5/4)"
                              : "Antypov & Elliott (2011)");
        f.absolute(name + ": work of the dashpot over the energy of approach", "1", 1 - e * e, got.lost, 1e-3,
                   "1 - e^2");
      }
    }
  }
}

/// Extremes of a free oscillation, by a parabola through three samples.
struct Extremes {
  std::vector<double> time, value;
  std::array<double, 3> last{};
  int seen = 0;
  void sample(double t, double dt, double v) {
    last = {last[1], last[2], v};
    if (++seen < 3) return;
    const double left = last[1] - last[0], right = last[2] - last[1];
    if (left * right >= 0.0) return;
    const double shift = 0.5 * (left + right) / (left - right);
    time.push_back(t - dt + shift * dt);
    value.push_back(last[1] + 0.25 * (last[2] - last[0]) * shift);
  }
};

struct Oscillation {
  double period = 0.0;       ///< s
  double decay_ratio = 0.0;  ///< of one period
};

/// A gravel sphere between two walls, 20 um into each, rough enough to stick; it is set sliding (or spinning).
Oscillation squeezed_sphere(double shear_damping, bool spinning, double expected_period) {
  const double overlap = 20e-6;
  Scene scene = model_scene();
  scene.gravel.friction = 10.0;
  scene.contact.shear_damping_ratio = shear_damping;
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
                     make_wall("lid", {-1, -1, 2 * (k_radius - overlap)}, {0, 2, 0}, {2, 0, 0})};
  for (Wall& w : scene.wall_list) w.friction = 10.0;
  add_sphere(scene, {0, 0, k_radius - overlap}, k_radius);
  Simulation s(scene);
  set_motion(s, 0, {spinning ? 0.0 : 3e-3, 0, 0}, {0, spinning ? 1.0 : 0.0, 0});
  s.set_time_step(expected_period / 4000);
  Extremes extremes;
  for (int k = 0; k < 4 * 4000 && extremes.value.size() < 5; ++k) {
    s.step();
    extremes.sample(s.time, s.time_step(), spinning ? clump(s, 0).spin.y : clump(s, 0).velocity.x);
  }
  if (extremes.value.size() < 5) return {};
  return {0.5 * (extremes.time[4] - extremes.time[0]), std::sqrt(extremes.value[4] / extremes.value[0])};
}

void shear_dashpot(Findings& f) {
  const double overlap = 20e-6, mass = sphere_mass(k_radius, 2710), inertia = 0.4 * mass * k_radius * k_radius;
  // Gravel (90 MPa, 0.30) on wall (80 GPa, 0.25).
  const double shear_modulus = 1.0 / ((2 - 0.30) / 90e6 + (2 - 0.25) / 80e9);
  const double stiffness = 8.0 * shear_modulus * std::sqrt(k_radius * overlap), lever = k_radius - 0.5 * overlap;
  for (const bool spinning : {false, true}) {
    for (const double b : {0.0, 0.05, 0.2}) {
      const double own = 2.0 * stiffness * (spinning ? lever * lever / inertia : 1.0 / mass);  // rad2/s2, two contacts
      const double damping = b * std::sqrt(2.0) * (spinning ? lever * std::sqrt(mass / inertia) : 1.0);
      const double rate = std::sqrt(own * (1.0 - damping * damping));
      const Oscillation got = squeezed_sphere(b, spinning, 2 * k_pi / rate);
      const std::string name = fmt::format("{}, b_s = {}", spinning ? "rotation" : "translation", b);
      const char* source = "damped linear oscillator with Mindlin's k_s";
      // The dashpot sees the velocity of half a step ago, which acts like a mass smaller by c dt/2.
      f.relative(name + ": period", "s", 2 * k_pi / rate, got.period, b > 0.0 ? 5e-4 : 1e-5, source);
      f.relative(name + ": amplitude left after a period", "1", std::exp(-2 * k_pi * damping * std::sqrt(own) / rate),
                 got.decay_ratio, 2e-3, source);
    }
  }
}

struct Slipped {
  double sliding = 0.0, worked_out = 0.0;  ///< velocity left over that before, by the engine and by hand
  double booked = 0.0;                     ///< works of slip and dashpots over the kinetic energy lost
};

/// Oblique impact with friction 0.1 and 0.4 m/s along the normal; `sliding` in m/s.
Slipped slip_under_damping(int mode, bool at_wall, double sliding) {
  const double closing = 0.4, friction = 0.1;
  ContactSettings contact;
  contact.normal_damping_ratio = 0.1;
  contact.shear_damping_ratio = 0.3;
  contact.dashpot_mode = mode;
  const PlanarBody ball{k_iron.young, k_iron.poisson, k_radius, sphere_mass(k_radius, k_iron.density)};
  PlanarImpact by_hand{ball, at_wall ? PlanarBody{} : ball, friction, 0.1, 0.3};
  by_hand.no_tension = mode == 1 || mode == 3;
  by_hand.no_dashpot_in_slip = mode >= 2;
  by_hand.closing = closing;
  by_hand.sliding = sliding;
  const double share = at_wall ? 1.0 : 0.5;
  const HertzImpact h = hertz_impact(share * ball.mass, share * modulus_on_rigid(k_iron), share * k_radius, closing);
  Simulation s = at_wall ? sphere_on_plane({k_iron.settings(), k_radius, friction, contact}, {sliding, 0, -closing})
                         : two_spheres(k_iron.settings(friction), k_radius, closing, contact);
  if (!at_wall) {
    set_motion(s, 0, {0.5 * closing, 0.5 * sliding, 0});
    set_motion(s, 1, {-0.5 * closing, -0.5 * sliding, 0});
  }
  const double before = s.energy().kinetic;
  strike(s, h.duration, 4000);
  const EnergyReport e = s.energy();
  const double left = at_wall ? clump(s, 0).velocity.x : clump(s, 0).velocity.y - clump(s, 1).velocity.y;
  return {left / sliding, work_out(by_hand, h.duration).sliding / sliding, (e.slip + e.dashpot) / (before - e.kinetic)};
}

void shear_dashpot_in_slip(Findings& f) {
  for (const bool at_wall : {true, false}) {
    for (int mode = 0; mode < 4; ++mode) {
      for (const double sliding : {0.08, 0.4}) {
        const Slipped got = slip_under_damping(mode, at_wall, sliding);
        const bool much = sliding > 0.2;
        const std::string name = fmt::format("{}, dashpot mode {}, {} sliding at first",
                                             at_wall ? "plane" : "two spheres", mode, much ? "much" : "little");
        // Two spheres turn about each other while they touch, by less than a part in a thousand of a radian; the
        // calculation in one plane leaves that out.
        f.absolute(name + ": tangential velocity left", "1", got.worked_out, got.sliding, at_wall ? 1e-3 : 2e-3,
                   "the same impact as scalars in one plane, own scheme");
        // A spring that sticks while the normal force falls gains energy by rule 0. In modes 0 and 1 the dashpot brakes
        // the sphere until it sticks at last; in 2 and 3 it slips throughout, and the works balance.
        if (much)
          f.relative(name + ": work of slip and dashpots over the loss", "1", 1.0, got.booked, mode < 2 ? 3e-3 : 3e-4,
                     "energy");
      }
    }
  }
}

}  // namespace

void add_dashpot_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"dashpot-tension", "Normal dashpot with and without tension",
       "The iron sphere of 2.5 mm at 3.9 m/s on a rigid plane, and two of them, in all four dashpot modes. "
       "Modes 0 and 2 let the dashpot pull at the end of the contact: e = exp(-pi b / sqrt(5/6 - b^2)). Modes "
       "1 and 3 cut the force at zero, so the rebound ends there:\n\n"
       "    e = exp(-(z/w) (pi - atan2(2 z w, 1 - 2 z^2))),  z = b sqrt(6/5),  w = sqrt(1 - z^2)\n\n"
       "the closed form of a linear spring and dashpot, which the substitution q = d^(5/4) makes valid for "
       "the Hertz contact.",
       Extent::quick, normal_dashpot_modes});
  cases.push_back(
      {"shear-dashpot", "Decay of a tangential oscillation",
       "A gravel sphere (R = 2.5 mm, m kg, I = 0.4 m R^2) sits between two walls with an overlap d of 20 um "
       "at each and sticks to both. Set sliding it swings with 2 k_s against m, set spinning with 2 k_s l^2 "
       "against I, lever l = R - d/2; k_s = 8 G* sqrt(R d) (N/m), 1/G* = (2-nu1)/G1 + (2-nu2)/G2. The shear "
       "dashpot 2 b_s sqrt(m k_s) damps both:\n\n"
       "    z = sqrt(2) b_s            in translation\n"
       "    z = sqrt(2) b_s l sqrt(m/I)  in rotation\n"
       "    T = 2 pi / (w0 sqrt(1 - z^2)),  amplitude after T: exp(-2 pi z / sqrt(1 - z^2))\n\n"
       "Periods depend on k_s, lever and inertia, decays on b_s and on the mass and stiffness in the dashpot.",
       Extent::quick, shear_dashpot});
  cases.push_back(
      {"dashpot-in-slip", "Shear dashpot while slipping",
       "Iron spheres of 2.5 mm at 0.4 m/s, friction 0.1, b_n = 0.1, b_s = 0.3, in all dashpot modes: one "
       "impact that sticks for most of its time and one that slips throughout. Modes 2 and 3 drop the shear "
       "dashpot while the contact slips. Expected values from a calculation of the same impact as scalars in "
       "one plane, with stiffnesses 2 E* a and 8 G* a of the contact radius a and 100 000 steps, that shares "
       "no code with the engine.",
       Extent::quick, shear_dashpot_in_slip});
}

}  // namespace dem::verify
