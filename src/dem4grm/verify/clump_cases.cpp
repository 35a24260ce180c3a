// SPDX-License-Identifier: BSD-3-Clause
// Cases: mass, centroid, inertia and sieve size of clumps, and how they bounce off a plane.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "dem4grm/verify/cases.hpp"
#include "dem4grm/verify/union_reference.hpp"

namespace dem {

namespace {

using namespace verify;

constexpr double k_size = 5e-3;  // m, sieve size

/// The shipped shapes as they are written down, radius of the largest pebble 1, and their sieve sizes.
struct Shape {
  const char* name;
  double sieve;
  const char* sieve_source;
  std::vector<Pebble> pebbles;
};

std::vector<Shape> shipped_shapes() {
  const double h = 0.70 * std::sqrt(3.0) / 2, c = 0.75 / std::sqrt(8.0);
  const char* row = "a row of pebbles passes lengthwise: diameter of the largest";
  return {{"T1", 2.0, row, {{{-0.30, 0, 0}, 1}, {{0.30, 0, 0}, 1}}},
          {"T2", 2.0, row, {{{-0.30, 0, 0}, 1}, {{0.40, 0, 0}, 0.8}}},
          {"T3",
           2 + 0.70 * std::sqrt(6.0) / 4,
           "triangle: 2 + edge sqrt(6)/4",
           {{{-0.35, 0, 0}, 1}, {{0.35, 0, 0}, 1}, {{0, h, 0}, 1}}},
          {"T4", 2.0, row, {{{-0.6, 0, 0}, 0.85}, {{0, 0, 0}, 1}, {{0.6, 0, 0}, 0.85}}},
          {"T5",
           2 + 0.75 / std::sqrt(2.0),
           "tetrahedron: 2 + edge / sqrt(2)",
           {{{c, c, c}, 1}, {{c, -c, -c}, 1}, {{-c, c, -c}, 1}, {{-c, -c, c}, 1}}},
          {"T6",
           0.0,
           "",
           {{{0, 0, 0}, 1},
            {{0.5, 0.1, 0}, 0.8},
            {{-0.45, 0.15, 0.1}, 0.8},
            {{0.05, -0.45, 0.1}, 0.78},
            {{-0.05, 0.1, -0.35}, 0.85}}}};
}

/// A simulation of one clump of the shape, at rest and in its principal axes.
Simulation lone_clump(const char* name, Material material = k_gravel) {
  Scene scene = model_scene();
  scene.shapes = {*find_clump_template(name)};
  scene.clumps = {{0, k_size, {{0, 0, 0}, {}}, material}};
  return Simulation(scene);
}

/// Pebbles of clump 0 as the simulation holds them, m, about the centroid.
std::vector<Pebble> pebbles_of(const Simulation& s) {
  std::vector<Pebble> pebbles;
  for (int p = 0; p < clump(s, 0).n_pebbles; ++p) {
    const int i = s.balls.pebble_index(p);
    pebbles.push_back({s.balls.position(i) - clump(s, 0).position, s.balls.radius_of_id(p)});
  }
  return pebbles;
}

double largest_radius(const std::vector<Pebble>& pebbles) {
  double r = 0.0;
  for (const Pebble& p : pebbles) r = std::max(r, p.radius);
  return r;
}

void check_row(Findings& f, const char* name, const std::vector<double>& centres, const std::vector<double>& radii,
               double sieve, Material material) {
  const Simulation s = lone_clump(name, material);
  const double unit = k_size / sieve, density = material == k_rubber ? 1610.0 : 2710.0;
  const double cube = density * unit * unit * unit;
  const RevolvedBody exact = spheres_in_a_row(centres, radii);
  const std::string what = std::string(name) + (material == k_rubber ? " of rubber: " : ": ");
  const char* source = "integral over the union in slices, overlap counted once";
  f.relative(what + "mass", "kg", cube * exact.volume, clump(s, 0).mass, 2e-5, source);
  f.relative(what + "solid volume", "m3", unit * unit * unit * exact.volume, clump(s, 0).volume, 2e-5, source);
  f.relative(what + "axial moment of inertia", "kg m2", cube * unit * unit * exact.axial, clump(s, 0).inertia.x, 2e-5,
             source);
  f.relative(what + "transverse moments of inertia", "kg m2", cube * unit * unit * exact.transverse,
             clump(s, 0).inertia.y, 2e-5, source);
  f.relative(what + "third moment over the second", "1", 1.0, clump(s, 0).inertia.z / clump(s, 0).inertia.y, 2e-5,
             "body of revolution");
  double worst = 0.0;
  const std::vector<Pebble> pebbles = pebbles_of(s);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    worst = std::max(worst, std::abs(std::abs(pebbles[i].position.x) - unit * std::abs(centres[i] - exact.centroid)));
  }
  f.absolute(what + "pebbles about the centroid, largest difference", "m", 0.0, worst, 2e-5 * unit, source);
}

void run_rows(Findings& f) {
  check_row(f, "sphere", {0.0}, {1.0}, 2.0, k_gravel);
  check_row(f, "T1", {-0.3, 0.3}, {1.0, 1.0}, 2.0, k_gravel);
  check_row(f, "T1", {-0.3, 0.3}, {1.0, 1.0}, 2.0, k_rubber);
  check_row(f, "T2", {-0.3, 0.4}, {1.0, 0.8}, 2.0, k_gravel);
  check_row(f, "T4", {-0.6, 0.0, 0.6}, {0.85, 1.0, 0.85}, 2.0, k_gravel);
  const double r = 1.0, c = 0.6;
  f.relative("T1: union volume, largest radius 1", "1",
             8.0 / 3.0 * k_pi * r * r * r - k_pi / 12.0 * (4 * r + c) * (2 * r - c) * (2 * r - c),
             clump(lone_clump("T1"), 0).volume * std::pow(2.0 / k_size, 3), 2e-5, "two spheres less their lens");
}

/// Largest difference between the distances of pebbles, and between their radii, from the written ones; L is the
/// largest radius.
double departure_from(const std::vector<Pebble>& written, const std::vector<Pebble>& built) {
  const double unit = largest_radius(built);
  double worst = 0.0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    worst = std::max(worst, std::abs(built[i].radius / unit - written[i].radius));
    for (std::size_t j = 0; j < i; ++j) {
      worst = std::max(worst, std::abs(norm(built[i].position - built[j].position) / unit -
                                       norm(written[i].position - written[j].position)));
    }
  }
  return worst;
}

/// Samples of volume, centroid, moments and products of inertia about the origin, all over powers of the sieve size.
struct UnionSamples {
  static constexpr int k_repeats = 10, k_cells = 110;
  std::array<std::vector<double>, 10> values;
  explicit UnionSamples(const Simulation& s) {
    std::vector<Pebble> pebbles = pebbles_of(s);
    double half = 0.0;
    for (Pebble& p : pebbles) {
      p = {p.position * (1.0 / k_size), p.radius / k_size};
      half = std::max(half, norm(p.position) + p.radius);
    }
    for (std::uint64_t k = 0; k < k_repeats; ++k) {
      const UnionSums u = sample_union(pebbles, half, k_cells, RandomSequence(23, RandomStream::monte_carlo, k));
      const UnionSums wanted{u[0],        u[1] / u[0], u[2] / u[0], u[3] / u[0], u[5] + u[6],
                             u[4] + u[6], u[4] + u[5], -u[7],       -u[8],       -u[9]};
      for (std::size_t i = 0; i < wanted.size(); ++i) values[i].push_back(wanted[i]);
    }
  }
};

void run_monte_carlo(Findings& f) {
  constexpr double density = 2710.0, in_columns = 2e-5;
  const double cube = k_size * k_size * k_size;
  const char* source =
      "random points in the union; tolerance 5 standard errors and 2e-5 for the columns of the program";
  for (const Shape& shape : shipped_shapes()) {
    const Simulation s = lone_clump(shape.name);
    const std::string what = std::string(shape.name) + ": ";
    f.absolute(what + "radii and distances of the pebbles over the largest radius, largest departure", "1", 0.0,
               departure_from(shape.pebbles, pebbles_of(s)), 1e-12, "shapes as written in the manual of clumps");
    const UnionSamples samples(s);
    const Estimate volume = estimate(samples.values[0]);
    f.relative(what + "mass", "kg", density * cube * volume.mean, clump(s, 0).mass,
               5 * volume.error / volume.mean + in_columns, source);
    double off_centre = 0.0, off_error = 0.0, product = 0.0, product_error = 0.0;
    for (std::size_t i = 1; i <= 3; ++i) {
      const Estimate centre = estimate(samples.values[i]), mixed = estimate(samples.values[i + 6]);
      off_centre = std::max(off_centre, std::abs(centre.mean));
      off_error = std::max(off_error, centre.error);
      product = std::max(product, std::abs(mixed.mean));
      product_error = std::max(product_error, mixed.error);
    }
    f.absolute(what + "largest coordinate of the centroid over the sieve size", "1", 0.0, off_centre,
               5 * off_error + in_columns, source);
    const double moments[] = {clump(s, 0).inertia.x, clump(s, 0).inertia.y, clump(s, 0).inertia.z};
    for (std::size_t i = 0; i < 3; ++i) {
      const Estimate moment = estimate(samples.values[i + 4]);
      f.relative(fmt::format("{}principal moment {}", what, i + 1), "kg m2",
                 density * cube * k_size * k_size * moment.mean, moments[i],
                 5 * moment.error / moment.mean + in_columns, source);
    }
    f.absolute(what + "largest product of inertia over the second moment", "1", 0.0,
               product / estimate(samples.values[5]).mean, 5 * product_error / estimate(samples.values[5]).mean + 1e-4,
               "principal axes; moments within 1e-4 count as equal");
  }
}

double sieve_of(const ClumpTemplate& shape) { return 1.0 / largest_radius(shape.pebbles); }

void run_sieve(Findings& f) {
  for (const Shape& shape : shipped_shapes()) {
    const double sieve = sieve_of(*find_clump_template(shape.name));
    const std::string what = std::string(shape.name) + ": ";
    if (shape.sieve > 0.0) {
      f.relative(what + "sieve size over the largest radius", "1", shape.sieve, sieve, 1e-8, shape.sieve_source);
    }
    f.relative(what + "sieve size over the largest radius, scan", "1", scanned_opening(shape.pebbles), sieve, 1e-7,
               "scan of 180000 orientations, the best 60 followed down");
  }
  const ClumpTemplate large = make_clump_template("large", {{{0, 0, 0}, 50}, {{0, 60, 0}, 30}});
  f.relative("spheres of 50 and 30 at 60, of a unit 50 times as small: sieve size over the largest radius", "1", 2.0,
             sieve_of(large), 1e-8, "a row of pebbles passes lengthwise");
  f.remark(
      "The least width of a regular tetrahedron is edge/sqrt(2), between opposite edges, and three such directions are "
      "perpendicular to each other, so no opening is smaller and this one is passed. A triangle in its plane is at "
      "least "
      "sqrt(3)/2 edge wide; of two perpendicular directions one has at least 1/sqrt(2) of its length in that plane.");
}

/// Motion of a clump before and after it meets the floor.
struct Bounce {
  Vec3 velocity, spin;  ///< afterwards
  Vec3 arm;             ///< m, from the centroid to the contact point at touch
  Clump body;           ///< before
};

Bounce bounce(const char* shape, const Quaternion& orientation, const Vec3& velocity, double friction) {
  Scene scene = model_scene();
  scene.gravel.friction = friction;
  scene.shapes = {*find_clump_template(shape)};
  scene.clumps = {{0, k_size, {{0, 0, 0}, orientation}, k_gravel}};
  scene.wall_list = {make_wall("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0})};
  scene.wall_list[0].friction = 0.9;
  const std::vector<Pebble> pebbles = pebbles_of(Simulation(scene));
  Vec3 lowest{0, 0, 1};
  for (const Pebble& p : pebbles) {
    if (p.position.z - p.radius < lowest.z) lowest = {p.position.x, p.position.y, p.position.z - p.radius};
  }
  scene.clumps[0].pose.position.z = 1e-9 - lowest.z;
  Simulation s(scene);
  set_motion(s, 0, velocity);
  s.set_time_step(1e-7);
  Bounce b;
  b.body = clump(s, 0);
  b.arm = lowest;
  bool touched = false;
  run_until(s, 100000, [&] {
    touched = touched || s.reactions[0].contacts > 0;
    return touched && s.reactions[0].contacts == 0;
  });
  b.velocity = clump(s, 0).velocity;
  b.spin = clump(s, 0).spin;
  return b;
}

/// Change of the spin by an impulse at the contact point, rad/s.
Vec3 spin_change(const Bounce& b, const Vec3& impulse) {
  const Frame frame = frame_of(b.body.orientation);
  const Vec3 l = to_body(frame, cross(b.arm, impulse));
  return to_space(frame, {l.x / b.body.inertia.x, l.y / b.body.inertia.y, l.z / b.body.inertia.z});
}

/// Impulse of the floor on a body whose contact slides along -direction all the time: the normal speed of the contact
/// point is turned round, since its acceleration is the same multiple of the force throughout.
Vec3 sliding_impulse(const Bounce& b, const Vec3& velocity, const Vec3& direction, double friction) {
  const Vec3 per_normal = Vec3{0, 0, 1} - direction * friction;
  const Vec3 response = per_normal * (1.0 / b.body.mass) + cross(spin_change(b, per_normal), b.arm);
  return per_normal * (-2.0 * velocity.z / response.z);
}

void check_bounce(Findings& f, const std::string& what, const Bounce& b, const Vec3& velocity, const Vec3& impulse) {
  const Vec3 v = velocity + impulse * (1.0 / b.body.mass), w = spin_change(b, impulse);
  const char* source = "impulse on a rigid body, elastic contact point";
  const double tolerance = 3e-4;
  f.relative(what + ": vertical speed afterwards", "m/s", v.z, b.velocity.z, tolerance, source);
  f.absolute(what + ": horizontal speed afterwards, difference over the speed", "1", 0.0,
             norm(perpendicular(b.velocity - v, {0, 0, 1})) / norm(velocity), tolerance, source);
  f.relative(what + ": size of the spin afterwards", "rad/s", norm(w), norm(b.spin), tolerance, source);
  f.absolute(what + ": spin afterwards, difference over its size", "1", 0.0, norm(b.spin - w) / norm(w), tolerance,
             source);
}

void run_bounces(Findings& f) {
  const Vec3 down{0.001, 0.002, -0.002};
  const Bounce smooth = bounce("T6", normalized({1, 0.3, -0.5, 0.2}), down, 0.0);
  check_bounce(f, "T6, no friction", smooth, down, sliding_impulse(smooth, down, {}, 0.0));

  // In a vertical plane that turns no slip aside: long axis tilted by 0.5 rad, plane turned by 0.7 rad about z.
  const Vec3 along{std::cos(0.7), std::sin(0.7), 0}, oblique = along * 0.01 + Vec3{0, 0, -0.002};
  const Quaternion plane{std::cos(0.35), 0, 0, std::sin(0.35)}, tilt{std::cos(0.25), 0, std::sin(0.25), 0};
  for (const double friction : {0.1, 0.3}) {
    const Bounce rough = bounce("T2", plane * tilt, oblique, friction);
    check_bounce(f, fmt::format("T2, sliding with friction {}", friction), rough, oblique,
                 sliding_impulse(rough, oblique, along, friction));
  }
}

}  // namespace

void add_clump_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"clump-rows", "Mass and inertia of pebbles in a row",
       "For pebbles on one axis the union is a body of revolution of profile $y^2 = R_i^2 - (x - x_i)^2$; neighbours "
       "part at the plane of their common circle. Volume $\\pi\\int y^2$, axial moment $\\frac{\\pi}{2}\\int y^4$ and "
       "transverse moment $\\pi\\int (y^4 / 4 + x^2 y^2)$ are polynomials. Mass and moments of a clump of sieve size "
       "5 mm in a simulation depend on the shape, on the density of its material and on the powers 3 and 5 of its "
       "size; counted twice, the overlap of T1 would add 39 %.",
       Extent::quick, run_rows});
  cases.push_back(
      {"clump-unions", "Mass, centroid and inertia of the shipped shapes",
       "Thirteen million random points, one in each cell of a grid, for each of the shapes T1 to T6: mass, centroid, "
       "principal moments, and products of inertia, which must vanish in the axes that the program chose. Ten "
       "independent grids give the error of the mean.",
       Extent::quick, run_monte_carlo});
  cases.push_back(
      {"clump-sieve", "Sieve size of the shipped shapes",
       "The sieve size is the side of the smallest square opening that the clump passes in any orientation: the "
       "smallest of $\\max(w(u), w(v))$ over perpendicular directions $u, v$, with $w$ the width. Closed forms for "
       "rows, for the triangle T3 and the tetrahedron T5; a scan of all orientations for every shape.",
       Extent::quick, run_sieve});
  cases.push_back(
      {"clump-bounce", "A clump hits a floor off its centre",
       "A clump falls on one of its pebbles. An elastic contact turns the normal speed of the contact point round, so "
       "with the impulse $J = (n - \\mu t) J_n$ and the arm $r$ from the centroid to the contact point\n\n"
       "$$J_n = \\frac{2 v_n}{n \\cdot [(n - \\mu t)/m + I^{-1}(r \\times (n - \\mu t)) \\times r]}, \\qquad "
       "\\Delta v = J/m, \\qquad \\Delta w = I^{-1} (r \\times J)$$\n\n"
       "for a contact that slides along $t$ throughout. Slow falls, so that the body does not turn while it touches. "
       "Mass, the tensor of inertia $I$ and the arms of force and couple enter.",
       Extent::quick, run_bounces});
}

}  // namespace dem
