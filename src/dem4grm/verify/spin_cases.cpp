// SPDX-License-Identifier: BSD-3-Clause
// Impact of spinning spheres: on a rigid plane, on their like, and on a larger sphere.
#include <fmt/format.h>

#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/oblique_curves.hpp"
#include "dem4grm/verify/planar_impact.hpp"

namespace dem::verify {
namespace {

const char* const k_sliding = "rigid bodies sliding throughout, impulse balance";
const char* const k_by_hand = "the same impact as scalars in one plane, own scheme";

const BenchmarkMaterial k_aluminium{"aluminium alloy", 70e9, 0.33, 2700}, k_nylon{"nylon", 2.5e9, 0.40, 1000};
constexpr double k_radius = 0.1, k_closing = 0.2, k_friction = 0.4, k_restitution = 0.5;

/// A spinning sphere meets a sphere at rest, or a plane when the partner's radius is 0.
struct SpinImpact {
  BenchmarkMaterial material;
  double partner_radius = 0.0, partner_density = 0.0;  ///< m, kg/m3
  double friction = k_friction;
  double spin = 0.0;  ///< rad/s; positive: moves the contact point along t
};

/// Motion along t; spins positive as in SpinImpact, of the partner about the same axis.
struct SpinOutcome {
  double velocity = 0.0, spin = 0.0;                  ///< of the sphere, m/s and rad/s
  double partner_velocity = 0.0, partner_spin = 0.0;  ///< m/s, rad/s
  double sliding = 0.0, parting = 0.0;                ///< m/s, of the contact points, of the centres
};

PlanarImpact restate(const SpinImpact& i) {
  PlanarImpact p;
  p.a = {i.material.young, i.material.poisson, k_radius, sphere_mass(k_radius, i.material.density)};
  p.b = {i.material.young, i.material.poisson, i.partner_radius, sphere_mass(i.partner_radius, i.partner_density)};
  p.friction = i.friction;
  p.normal_damping = damping_for_restitution(k_restitution);
  p.closing = k_closing;
  p.spin_a = -i.spin;
  return p;
}

HertzImpact expected_impact(const SpinImpact& i) {
  const double m1 = sphere_mass(k_radius, i.material.density), rigid = modulus_on_rigid(i.material);
  if (i.partner_radius == 0.0) return hertz_impact(m1, rigid, k_radius, k_closing);
  const double m2 = sphere_mass(i.partner_radius, i.partner_density);
  return hertz_impact(m1 * m2 / (m1 + m2), 0.5 * rigid, k_radius * i.partner_radius / (k_radius + i.partner_radius),
                      k_closing);
}

SpinOutcome on_plane(const SpinImpact& i, double shear_damping = 0.0) {
  ContactSettings contact;
  contact.shear_damping_ratio = shear_damping;
  contact.dashpot_mode = 2;
  contact.normal_damping_ratio = damping_for_restitution(k_restitution);
  Simulation s =
      sphere_on_plane({i.material.settings(), k_radius, i.friction, contact}, {0, 0, -k_closing}, {0, -i.spin, 0});
  strike(s, expected_impact(i).duration, 4000);
  const Clump& c = clump(s, 0);
  return {c.velocity.x, -c.spin.y, 0, 0, c.velocity.x - k_radius * c.spin.y, c.velocity.z};
}

/// The partner is of "rubber" so that it can have a density of its own.
SpinOutcome on_sphere(const SpinImpact& i) {
  Scene scene = model_scene();
  scene.gravel = scene.rubber = i.material.settings(i.friction);
  scene.rubber.density = i.partner_density;
  scene.contact.normal_damping_ratio = damping_for_restitution(k_restitution);
  add_sphere(scene, {0, 0, 0}, k_radius, k_gravel);
  add_sphere(scene, {(k_radius + i.partner_radius) * (1 + 1e-9), 0, 0}, i.partner_radius, k_rubber);
  Simulation s(scene);
  // Contact in +x; a spin about +z moves the surface there along t = +y.
  set_motion(s, 0, {k_closing, 0, 0}, {0, 0, i.spin});
  strike(s, expected_impact(i).duration, 4000);
  const Clump &a = clump(s, 0), &b = clump(s, 1);
  const double sliding = a.velocity.y - b.velocity.y + k_radius * a.spin.z + i.partner_radius * b.spin.z;
  return {a.velocity.y, a.spin.z, b.velocity.y, b.spin.z, sliding, b.velocity.x - a.velocity.x};
}

void check_published_spins(Findings& f, Picture& picture) {
  const char* source = "Chung & Ooi (2011), test 6, simulation";
  Series published{"Chung & Ooi, simulation, aluminium", true, {}, {}};
  Series damped{"aluminium alloy, shear dashpot", false, {}, {}};
  const auto sliding_after = [](double x, double shear_damping) {
    const SpinOutcome got = on_plane({k_aluminium, 0.0, 0.0, k_friction, x * k_closing / k_radius}, shear_damping);
    return got.sliding / got.parting;
  };
  const double shear_damping = damping_for_restitution(k_restitution);
  for (const CurvePoint& p : k_spin_on_plane) {
    published.x.push_back(p.x), published.y.push_back(p.y);
    const bool sticks = p.x < 2.1;
    f.absolute(fmt::format("aluminium alloy{}, V_s/V_n = {}: sliding after", sticks ? " with shear dashpot" : "", p.x),
               "V_n'", p.y, sliding_after(p.x, sticks ? shear_damping : 0.0), sticks ? 0.13 : 0.03, source);
  }
  for (double x = 0.2; x < 8.0; x += 0.2) {
    damped.x.push_back(x), damped.y.push_back(sliding_after(x, shear_damping));
  }
  picture.series.push_back(damped);
  picture.series.push_back(published);
}

void spin_on_plane(Findings& f) {
  Picture picture{"spin-on-plane",
                  "Sliding of the contact point after the impact of a spinning sphere",
                  "V_s/V_n before",
                  "V_s/V_n after",
                  {}};
  for (const BenchmarkMaterial& m : {k_aluminium, k_nylon}) {
    Series line{m.name, false, {}, {}};
    for (const double x : {0.2, 0.465, 1.0, 1.43, 1.73, 2.747, 3.733, 5.677, 8.0}) {
      const SpinImpact i{m, 0.0, 0.0, k_friction, x * k_closing / k_radius};
      const SpinOutcome got = on_plane(i);
      const PlanarOutcome p = work_out(restate(i), expected_impact(i).duration);
      const double y = got.sliding / got.parting;
      const double worked_out = (p.sliding - k_radius * p.spin_a) / p.parting;
      const std::string name = fmt::format("{}, V_s/V_n = {}", m.name, x);
      if (x > 2.1) {
        const double impulse = k_friction * (1 + k_restitution) * k_closing;
        f.absolute(name + ": sliding after", "V_n'", (x - 3.5 * k_friction * (1 + k_restitution)) / k_restitution, y,
                   1e-2, k_sliding);
        f.relative(name + ": tangential velocity", "m/s", -impulse, got.velocity, 1e-3, k_sliding);
        f.relative(name + ": spin", "rad/s", i.spin - 2.5 * impulse / k_radius, got.spin, 2e-3, k_sliding);
      }
      f.absolute(name + ": sliding after", "V_n'", worked_out, y, 3e-3, k_by_hand);
      f.absolute(name + ": tangential velocity", "m/s", p.sliding, got.velocity, 2e-4, k_by_hand);
      line.x.push_back(x), line.y.push_back(y);
    }
    picture.series.push_back(line);
  }
  check_published_spins(f, picture);
  f.picture(picture);
  f.remark(
      "The authors' shear dashpot is not published in numbers that can be read off. With the ratio of the normal "
      "dashpot, off while slipping, the model meets their curve in the range of sticking within 0.13, where without a "
      "dashpot it is 0.6 away; hence the loose tolerance there.");
}

void two_spinning_spheres(Findings& f) {
  const double closing = 0.4;
  for (const double sense : {-1.0, 1.0}) {
    for (const double spin : {2.0, 20.0}) {
      Simulation s = two_spheres(k_aluminium.settings(k_friction), k_radius, closing);
      set_motion(s, 0, {0.5 * closing, 0, 0}, {0, 0, spin});
      set_motion(s, 1, {-0.5 * closing, 0, 0}, {0, 0, sense * spin});
      const double mass = sphere_mass(k_radius, k_aluminium.density);
      const HertzImpact h = hertz_impact(0.5 * mass, 0.5 * modulus_on_rigid(k_aluminium), 0.5 * k_radius, closing);
      strike(s, h.duration, 4000);
      const std::string name = fmt::format("{} spins of {} rad/s", sense < 0.0 ? "opposite" : "equal", spin);
      if (sense < 0.0) {
        for (std::size_t c = 0; c < 2; ++c) {
          f.relative(fmt::format("{}: spin of sphere {}", name, c + 1), "rad/s", c == 0 ? spin : -spin,
                     clump(s, c).spin.z, 1e-9, "the surfaces move together: no force");
          f.absolute(fmt::format("{}: sideways velocity of sphere {}", name, c + 1), "m/s", 0.0, clump(s, c).velocity.y,
                     1e-9, "the surfaces move together: no force");
        }
        continue;
      }
      PlanarImpact p;
      p.a = p.b = {k_aluminium.young, k_aluminium.poisson, k_radius, mass};
      p.friction = k_friction;
      p.closing = closing;
      p.spin_a = p.spin_b = -spin;
      const bool slides = spin > 10.0;
      const PlanarOutcome worked_out = work_out(p, h.duration);
      const double sideways = slides ? k_friction * closing : -0.5 * worked_out.sliding;
      const double left = slides ? spin - 2.5 * k_friction * closing / k_radius : -worked_out.spin_a;
      for (std::size_t c = 0; c < 2; ++c) {
        f.absolute(fmt::format("{}: sideways velocity of sphere {}", name, c + 1), "m/s", c == 0 ? -sideways : sideways,
                   clump(s, c).velocity.y, 1e-3 * sideways + 1e-5, slides ? k_sliding : k_by_hand);
        f.absolute(fmt::format("{}: spin of sphere {}", name, c + 1), "rad/s", left, clump(s, c).spin.z, 2e-3 * spin,
                   slides ? k_sliding : k_by_hand);
      }
    }
  }
}

void spin_on_larger_sphere(Findings& f) {
  const double large = 0.5;
  for (const double density : {2700.0, 2700.0 * 8.0}) {
    for (const double x : {0.2, 1.0, 1.73, 2.747, 5.677}) {
      const SpinImpact i{k_aluminium, large, density, k_friction, x * k_closing / k_radius};
      const SpinOutcome got = on_sphere(i);
      const double m1 = sphere_mass(k_radius, 2700), m2 = sphere_mass(large, density);
      const double impulse = k_friction * (1 + k_restitution) * k_closing * m1 * m2 / (m1 + m2);
      const PlanarOutcome p = work_out(restate(i), expected_impact(i).duration);
      const std::string name = fmt::format("large sphere {:.0f} times heavier, V_s/V_n = {}", m2 / m1, x);
      if (x > 2.1) {
        f.relative(name + ": velocity of the small one", "m/s", -impulse / m1, got.velocity, 1e-3, k_sliding);
        f.relative(name + ": spin of the small one", "rad/s", i.spin - 2.5 * impulse / (m1 * k_radius), got.spin, 2e-3,
                   k_sliding);
        f.relative(name + ": velocity of the large one", "m/s", impulse / m2, got.partner_velocity, 1e-3, k_sliding);
        f.relative(name + ": spin of the large one", "rad/s", -2.5 * impulse / (m2 * large), got.partner_spin, 2e-3,
                   k_sliding);
      }
      f.absolute(name + ": sliding after", "V_n'", (p.sliding - k_radius * p.spin_a - large * p.spin_b) / p.parting,
                 got.sliding / got.parting, 5e-3, k_by_hand);
    }
  }
  for (const double x : {1.0, 2.747}) {
    const SpinImpact rigid{k_aluminium, 0.0, 0.0, k_friction, x * k_closing / k_radius};
    SpinImpact heavy = rigid;
    heavy.partner_radius = large;
    heavy.partner_density = 2700 * 8;
    const SpinOutcome a = on_plane(rigid), b = on_sphere(heavy);
    f.absolute(fmt::format("heavy sphere against plane, V_s/V_n = {}: sliding after", x), "V_n'", a.sliding / a.parting,
               b.sliding / b.parting, 2e-2, "Chung & Ooi (2011), test 8: the curves of tests 6 and 8 coincide");
  }
}

}  // namespace

void add_spin_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"spin-on-plane", "Spinning sphere on a rigid plane",
       "Chung & Ooi (2011), test 6: spheres of R = 0.1 m of an aluminium alloy and of nylon fall on a rigid "
       "plane at V_n = 0.2 m/s and spin about an axis in the plane; mu = 0.4, e = 0.5. V_s = R spin is the "
       "velocity of the contact point. Sliding throughout (V_s above 3.5 mu (1 + e) V_n):\n\n"
       "    V_s'/V_n' = (V_s/V_n - 3.5 mu (1 + e))/e,   v_t' = mu (1 + e) V_n,   "
       "R spin' = R spin - 2.5 mu (1 + e) V_n\n\n"
       "with the spin as the driver, signs of lever arm and torque have to fit those of the velocity.",
       Extent::quick, spin_on_plane});
  cases.push_back(
      {"spinning-spheres", "Two spinning spheres",
       "Chung & Ooi (2011), test 7: two equal spheres of 0.1 m meet head-on at 0.4 m/s. With opposite spins "
       "about parallel axes their surfaces move together, and nothing may change. With equal spins they rub: "
       "sliding throughout, each gets mu v sideways (v: closing speed, undamped) and loses 2.5 mu v/R of "
       "spin; at low spin they stick, and the expected values are those of a calculation in one plane.",
       Extent::quick, two_spinning_spheres});
  cases.push_back(
      {"spin-on-larger-sphere", "Spinning sphere on a larger sphere",
       "Chung & Ooi (2011), test 8: as spinning sphere on a plane, but the partner is a sphere of 0.5 m at "
       "rest, 125 or 1000 times heavier. The impulse mu (1 + e) V_n m1 m2/(m1 + m2) drives both; the spin of "
       "the large one depends on its own lever and inertia.",
       Extent::quick, spin_on_larger_sphere});
}

}  // namespace dem::verify
