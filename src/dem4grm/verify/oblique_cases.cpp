// SPDX-License-Identifier: BSD-3-Clause
// Oblique impact of a sphere on a rigid plane: tangential restitution and spin from sticking to gross sliding.
#include <fmt/format.h>

#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/oblique_curves.hpp"
#include "dem4grm/verify/planar_impact.hpp"

namespace dem {
namespace {

using namespace verify;

const char* const k_sliding = "rigid sphere sliding throughout (Kharaz et al. 2001)";
const char* const k_by_hand = "the same impact as scalars in one plane, own scheme";

/// Velocity and spin of a sphere; the spin about the axis that rolling in +x has.
struct PlaneMotion {
  double tangential = 0.0, normal = 0.0, spin = 0.0;  ///< m/s, m/s (after: away from the plane), rad/s
  double slip_work = 0.0;                             ///< J, after
};

struct Oblique {
  BenchmarkMaterial material;
  double radius = 0.0, friction = 0.0, damping = 0.0;
};

HertzImpact expected_impact(const Oblique& o, double closing) {
  return hertz_impact(sphere_mass(o.radius, o.material.density), modulus_on_rigid(o.material), o.radius, closing);
}

PlaneMotion through_engine(const Oblique& o, const PlaneMotion& before) {
  ContactSettings contact;
  contact.normal_damping_ratio = o.damping;
  Simulation s = sphere_on_plane({o.material.settings(), o.radius, o.friction, contact},
                                 {before.tangential, 0, -before.normal}, {0, before.spin, 0});
  strike(s, expected_impact(o, before.normal).duration, 4000);
  return {clump(s, 0).velocity.x, clump(s, 0).velocity.z, clump(s, 0).spin.y, s.ledger.contact_slip};
}

PlaneMotion by_hand(const Oblique& o, const PlaneMotion& before) {
  PlanarImpact p;
  p.a = {o.material.young, o.material.poisson, o.radius, sphere_mass(o.radius, o.material.density)};
  p.friction = o.friction;
  p.normal_damping = o.damping;
  p.closing = before.normal;
  p.sliding = before.tangential;
  p.spin_a = before.spin;
  const PlanarOutcome after = work_out(p, expected_impact(o, before.normal).duration);
  return {after.sliding, after.parting, after.spin_a};
}

template <std::size_t n>
Series reference(const std::string& label, const std::array<CurvePoint, n>& points) {
  Series s{label, true, {}, {}};
  for (const CurvePoint& p : points) s.x.push_back(p.x), s.y.push_back(p.y);
  return s;
}

// ---- Test 4: one speed, all angles ----------------------------------------------------------------------------------

constexpr double k_speed = 3.9, k_friction = 0.092, k_restitution = 0.98;

Oblique oxide_on_glass() {
  return {{"aluminium oxide", 380e9, 0.23, 4000}, 2.5e-3, k_friction, damping_for_restitution(k_restitution)};
}

PlaneMotion at_angle(double angle_deg) {
  const double angle = angle_deg * k_pi / 180.0;
  return {k_speed * std::sin(angle), k_speed * std::cos(angle), 0.0};
}

double tangential_restitution(double angle_deg) {
  return through_engine(oxide_on_glass(), at_angle(angle_deg)).tangential / at_angle(angle_deg).tangential;
}

void check_angle(Findings& f, double angle_deg, const PlaneMotion& after) {
  const Oblique o = oxide_on_glass();
  const PlaneMotion before = at_angle(angle_deg);
  const double ratio = after.tangential / before.tangential;
  const std::string name = fmt::format("{} deg", angle_deg);
  if (angle_deg >= 40) {
    const double share = k_friction * (1 + k_restitution) * before.normal;
    f.absolute(name + ": tangential restitution", "1", 1 - share / before.tangential, ratio, 1e-4, k_sliding);
    f.relative(name + ": spin", "rad/s", 2.5 * share / o.radius, after.spin, 2e-3, k_sliding);
    // The sliding speed falls by 3.5 shares while the impulse grows.
    const double mass = sphere_mass(o.radius, o.material.density);
    f.relative(name + ": work of slip", "J", mass * share * (before.tangential - 1.75 * share), after.slip_work, 2e-3,
               k_sliding);
  }
  const PlaneMotion worked_out = by_hand(o, before);
  f.absolute(name + ": tangential restitution", "1", worked_out.tangential / before.tangential, ratio, 3e-4, k_by_hand);
  f.relative(name + ": spin", "rad/s", worked_out.spin, after.spin, angle_deg < 7 ? 3e-3 : 3e-4, k_by_hand);
}

void oblique_angles(Findings& f) {
  Series ratio{"DEM4GRM", false, {}, {}}, spin{"DEM4GRM", false, {}, {}};
  for (int angle = 5; angle <= 80; angle += 5) {
    const PlaneMotion before = at_angle(angle), after = through_engine(oxide_on_glass(), before);
    check_angle(f, angle, after);
    if (angle % 20 == 5) {
      f.absolute(fmt::format("{} deg: normal restitution", angle), "1", k_restitution, after.normal / before.normal,
                 5e-4, "Antypov & Elliott (2011)");
    }
    ratio.x.push_back(angle), ratio.y.push_back(after.tangential / before.tangential);
    spin.x.push_back(angle), spin.y.push_back(after.spin);
  }
  for (const CurvePoint& p : k_oxide_restitution) {
    // Near the normal the curve is steep and the figure's resolution counts.
    f.absolute(fmt::format("{} deg: tangential restitution", p.x), "1", p.y, tangential_restitution(p.x),
               p.x < 9.0 ? 0.06 : 0.025, "Chung & Ooi (2011), test 4, simulation");
  }
  for (const CurvePoint& p : k_measured_restitution) {
    if (p.x < 9.0) continue;
    f.absolute(fmt::format("{} deg: tangential restitution", p.x), "1", p.y, tangential_restitution(p.x),
               p.x < 15.0 ? 0.05 : 0.02, "Kharaz et al. (2001), measured");
  }
  for (const CurvePoint& p : k_measured_spin) {
    if (p.x < 9.0) continue;
    f.absolute(fmt::format("{} deg: spin", p.x), "rad/s", p.y, through_engine(oxide_on_glass(), at_angle(p.x)).spin,
               60.0, "Kharaz et al. (2001), measured");
  }
  f.remark(
      "In sliding the spin stays up to 0.1 % below the closed form, because the force acts half an overlap inside the "
      "surface. The measured points scatter by about as much as they differ from the model; below 9 degrees they lie "
      "up to 0.2 under it, since real contacts lose energy by partial slip there: drawn, but not held against.");
  f.picture({"oblique-restitution",
             "Tangential restitution against the angle of impact",
             "angle from the normal (deg)",
             "tangential restitution",
             {ratio, reference("Chung & Ooi, simulation", k_oxide_restitution),
              reference("Kharaz et al., measured", k_measured_restitution)}});
  f.picture({"oblique-spin",
             "Spin after impact against the angle of impact",
             "angle from the normal (deg)",
             "spin (rad/s)",
             {spin, reference("Chung & Ooi, simulation", k_oxide_spin),
              reference("Kharaz et al., measured", k_measured_spin)}});
}

// ---- Test 5: one normal speed, all tangential speeds ----------------------------------------------------------------

/// Sliding velocity of the contact point and R spin after the impact, both over unit.
struct Scaled {
  double sliding = 0.0, spin = 0.0;
};
Scaled scaled(const Oblique& o, double x, double unit) {
  const PlaneMotion after = through_engine(o, {x * unit, unit / o.friction, 0.0});
  return {(after.tangential - o.radius * after.spin) / unit, o.radius * after.spin / unit};
}

/// Poisson's ratio whose k_s/k_n = 2(1-nu)/(2-nu) is half that of the given one; beyond what a solid can have, which
/// the law does not mind.
double poisson_of_half_shear_stiffness(double poisson) {
  const double ratio = (1.0 - poisson) / (2.0 - poisson);
  return (2.0 - 2.0 * ratio) / (2.0 - ratio);
}

void check_published_speeds(Findings& f, const Oblique& steel, double unit) {
  Oblique halved = steel;
  halved.material.poisson = poisson_of_half_shear_stiffness(steel.material.poisson);
  const char* source = "Chung & Ooi (2011), test 5, simulation";
  for (const CurvePoint& p : k_steel_sliding) {
    f.absolute(fmt::format("steel with k_s/2, V_s/(mu V_n) = {}: sliding after", p.x), "mu V_n", p.y,
               scaled(halved, p.x, unit).sliding, 0.1, source);
  }
  for (const CurvePoint& p : k_steel_spin) {
    f.absolute(fmt::format("steel with k_s/2, V_s/(mu V_n) = {}: R spin after", p.x), "mu V_n", p.y,
               scaled(halved, p.x, unit).spin, 0.1, source);
  }
  for (const CurvePoint& p : k_element_sliding) {
    if (p.x < 3.0) continue;
    f.absolute(fmt::format("steel, V_s/(mu V_n) = {}: sliding after", p.x), "mu V_n", p.y,
               scaled(steel, p.x, unit).sliding, 0.3, "finite elements, in Chung & Ooi (2011)");
  }
  f.remark(
      "The published simulation is met to the accuracy of its figure when k_s/k_n is half of Mindlin's value, which is "
      "what a plane that is rigid for the normal and of the sphere's own material for the shear stiffness gives; with "
      "Mindlin's value the model lies close to the finite elements instead. Below 3 mu V_n it stays above them by up "
      "to 0.7, because a spring with one limit has no partial slip in the contact patch; that range is drawn but not "
      "held against.");
}

void oblique_speeds(Findings& f) {
  const double radius = 1e-5, closing = 5.0, friction = 0.3, unit = friction * closing;
  const BenchmarkMaterial steel{"steel", 208e9, 0.30, 7850}, polyethylene{"polyethylene", 1e9, 0.40, 1400};
  Picture sliding{"oblique-sliding",
                  "Sliding velocity of the contact point after impact",
                  "V_s/(mu V_n) before",
                  "V_s/(mu V_n) after",
                  {}};
  Picture spin{"oblique-speeds-spin", "Spin after impact", "V_s/(mu V_n) before", "R spin/(mu V_n) after", {}};
  for (const BenchmarkMaterial& m : {steel, polyethylene}) {
    const Oblique o{m, radius, friction, 0.0};
    Series y{m.name, false, {}, {}}, w{m.name, false, {}, {}};
    for (const double x : {0.33, 1.01, 2.0, 2.99, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0}) {
      const PlaneMotion before{x * unit, closing, 0.0}, after = through_engine(o, before),
                                                        worked_out = by_hand(o, before);
      const double slide = (after.tangential - radius * after.spin) / unit;
      const double slide_by_hand = (worked_out.tangential - radius * worked_out.spin) / unit;
      const std::string name = fmt::format("{}, V_s/(mu V_n) = {}", m.name, x);
      if (x > 7) {
        f.absolute(name + ": sliding after", "mu V_n", x - 7, slide, 0.06, k_sliding);
        f.absolute(name + ": R spin after", "mu V_n", 5.0, radius * after.spin / unit, 0.06, k_sliding);
      }
      f.absolute(name + ": sliding after", "mu V_n", slide_by_hand, slide, 5e-3, k_by_hand);
      f.absolute(name + ": R spin after", "mu V_n", radius * worked_out.spin / unit, radius * after.spin / unit, 5e-3,
                 k_by_hand);
      y.x.push_back(x), y.y.push_back(slide);
      w.x.push_back(x), w.y.push_back(radius * after.spin / unit);
    }
    sliding.series.push_back(y);
    spin.series.push_back(w);
  }
  check_published_speeds(f, {steel, radius, friction, 0.0}, unit);
  sliding.series.push_back(reference("Chung & Ooi, simulation, steel", k_steel_sliding));
  sliding.series.push_back(reference("finite elements", k_element_sliding));
  spin.series.push_back(reference("Chung & Ooi, simulation, steel", k_steel_spin));
  Series half_sliding{"steel, k_s halved", false, {}, {}}, half_spin = half_sliding;
  const BenchmarkMaterial softer{"", steel.young, poisson_of_half_shear_stiffness(0.3), steel.density};
  for (double x = 0.25; x < 12.1; x += 0.25) {
    const auto after = scaled({softer, radius, friction, 0.0}, x, unit);
    half_sliding.x.push_back(x), half_sliding.y.push_back(after.sliding);
    half_spin.x.push_back(x), half_spin.y.push_back(after.spin);
  }
  sliding.series.push_back(half_sliding);
  spin.series.push_back(half_spin);
  f.picture(sliding);
  f.picture(spin);
}

}  // namespace

void add_oblique_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"oblique-angles", "Oblique impact at all angles",
       "Chung & Ooi (2011), test 4: an aluminium oxide sphere of R = 2.5 mm meets a rigid plane at 3.9 m/s, "
       "friction mu = 0.092, normal restitution e = 0.98, at angles theta of 5 to 80 degrees from the normal. "
       "Where it slides throughout (theta above atan(3.5 mu (1 + e)) = 32.5 degrees):\n\n"
       "    e_t = v_t'/v_t = 1 - mu (1 + e)/tan(theta),   spin = 2.5 mu (1 + e) v_n/R\n\n"
       "At smaller angles the outcome depends on k_s/k_n, on the order of sticking and slip and on the "
       "inertia; there the expected values come from a calculation beside the engine (the contact as "
       "scalars in one plane, stiffnesses 2 E* a and 8 G* a), from the published simulation and from "
       "measurements.",
       Extent::quick, oblique_angles});
  cases.push_back(
      {"oblique-speeds", "Oblique impact at all tangential speeds",
       "Chung & Ooi (2011), test 5: spheres of 10 um of steel and of polyethylene meet a rigid plane with a "
       "normal speed V_n of 5 m/s, mu = 0.3, no damping, and a tangential speed V_s of 0.33 to 12 mu V_n. "
       "Sliding throughout (V_s above 7 mu V_n) leaves V_s - 7 mu V_n of sliding and a spin of 5 mu V_n/R; "
       "below, the outcome depends on Poisson's ratio alone, through k_s/k_n.",
       Extent::quick, oblique_speeds});
  add_spin_cases(cases);
}

}  // namespace dem
