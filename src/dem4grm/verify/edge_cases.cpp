// SPDX-License-Identifier: BSD-3-Clause
// Balls at walls made of several rectangles: seams, convex edges and corners, concave ones, and free edges.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dem4grm/verify/impact_scenes.hpp"
#include "dem4grm/verify/led_contact.hpp"

namespace dem::verify {
namespace {

constexpr double k_radius = 2.5e-3, k_overlap = 20e-6, k_distance = k_radius - k_overlap;  // m

/// G* of gravel (90 MPa, 0.30) on wall (80 GPa, 0.25), Pa, and the contact radius, m.
double shear_modulus_on_wall() { return 1.0 / (1.70 / 90e6 + 1.75 / 80e9); }
double patch() { return std::sqrt(k_radius * k_overlap); }
double hertz_force() { return 4.0 / 3.0 * patch() * k_overlap / (0.35 / 90e6 + 0.375 / 80e9); }

/// One gravel ball among walls, led through the engine.
class Probe {
 public:
  Probe(std::vector<Wall> walls, double friction, const Vec3& at) : s_(scene(std::move(walls), friction, at)) {
    s_.set_time_step(k_leading_time_step);
    settle(s_);
  }
  static Scene scene(std::vector<Wall> walls, double friction, const Vec3& at) {
    Scene out = model_scene();
    out.gravel.friction = 10.0;
    for (Wall& w : walls) w.friction = friction;
    out.wall_list = std::move(walls);
    add_sphere(out, at, k_radius);
    return out;
  }
  Vec3 move_to(const Vec3& to) {
    move_clump(s_, 0, to - clump(s_, 0).position);
    return force();
  }
  /// Net force of all walls on the ball, N.
  [[nodiscard]] Vec3 force() const {
    Vec3 sum;
    for (const WallReaction& r : s_.reactions) sum -= r.force;
    return sum;
  }
  [[nodiscard]] int contacts() const {
    int n = 0;
    for (const WallReaction& r : s_.reactions) n += r.contacts;
    return n;
  }
  Simulation& simulation() { return s_; }

 private:
  Simulation s_;
};

std::vector<Wall> whole_floor() { return {make_wall("whole", {-0.1, -0.1, 0}, {0.2, 0, 0}, {0, 0.2, 0})}; }

/// The same floor cut at x = 0; `flip` walks the second piece the other way round, so that two far ends meet.
std::vector<Wall> cut_floor(bool flip) {
  return {make_wall("left", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}),
          flip ? make_wall("right", {0.1, 0.1, 0}, {-0.1, 0, 0}, {0, -0.2, 0})
               : make_wall("right", {0, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0})};
}

/// Across the seam and back in slip, then slowly and sticking, and through x = 0 exactly.
void check_seam(Findings& f, bool flip) {
  const Vec3 start{-3e-3, 0, k_distance};
  Probe one(whole_floor(), 0.7, start), two(cut_floor(flip), 0.7, start);
  std::vector<double> path;
  for (int k = -300; k <= 300; ++k) path.push_back(k * 1e-5);
  for (int k = 300; k >= -300; --k) path.push_back(k * 1e-5 * 0.999);
  for (int k = -20; k <= 20; ++k) path.push_back(k * 1e-7);
  double worst = 0.0;
  int most = 0, fewest = 9;
  for (const double x : path) {
    const Vec3 to{x, 0.3 * x, k_distance}, a = one.move_to(to), b = two.move_to(to);
    worst = std::max(worst, norm(a - b) / norm(a));
    most = std::max(most, two.contacts());
    fewest = std::min(fewest, two.contacts());
  }
  const std::string name = flip ? "floor in two pieces, second reversed" : "floor in two pieces";
  f.absolute(name + ": difference of the force, over it", "1", 0.0, worst, 1e-9, "floor in one piece");
  f.absolute(name + ": most contacts at a time", "1", 1.0, most, 0.0, "geometry");
  f.absolute(name + ": fewest contacts at a time", "1", 1.0, fewest, 0.0, "geometry");
}

void check_force(Findings& f, const std::string& name, Probe& p, const Vec3& expected, int contacts) {
  const Vec3 got = p.force();
  f.absolute(name + ": difference of the force, over Hertz's", "1", 0.0, norm(got - expected) / hertz_force(), 1e-6,
             "Hertz (1882), along the shortest way to the wall");
  f.absolute(name + ": contacts", "1", contacts, p.contacts(), 0.0, "geometry");
}

void convex_and_concave(Findings& f) {
  const double force = hertz_force(), a = k_pi / 6, c = k_distance / std::sqrt(3.0);
  std::vector<Wall> four;
  for (const double x : {-0.1, 0.0}) {
    for (const double y : {-0.1, 0.0}) four.push_back(make_wall("piece", {x, y, 0}, {0.1, 0, 0}, {0, 0.1, 0}));
  }
  for (const double x : {0.0, 1e-5, -1e-9}) {
    Probe p(four, 0.0, {x, -x, k_distance});
    check_force(f, fmt::format("floor in four pieces, {} m beside the point where they meet", x), p, {0, 0, force}, 1);
  }
  Probe edge({make_wall("top", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}),
              make_wall("side", {0, -0.1, -0.1}, {0, 0.2, 0}, {0, 0, 0.1})},
             0.0, {k_distance * std::sin(a), 0.01, k_distance * std::cos(a)});
  check_force(f, "convex edge of two walls", edge, {force * std::sin(a), 0, force * std::cos(a)}, 1);
  Probe corner({make_wall("top", {-0.1, -0.1, 0}, {0.1, 0, 0}, {0, 0.1, 0}),
                make_wall("side x", {0, -0.1, -0.1}, {0, 0.1, 0}, {0, 0, 0.1}),
                make_wall("side y", {-0.1, 0, -0.1}, {0, 0, 0.1}, {0.1, 0, 0})},
               0.0, {c, c, c});
  check_force(f, "convex corner of three walls", corner, Vec3{1, 1, 1} * (force / std::sqrt(3.0)), 1);
  Probe nook({make_wall("floor", {0, -0.1, 0}, {0.1, 0, 0}, {0, 0.2, 0}),
              make_wall("wall", {0, -0.1, 0}, {0, 0.2, 0}, {0, 0, 0.1})},
             0.0, {k_distance, 0, k_radius - k_overlap * std::pow(2.0, 2.0 / 3.0)});
  check_force(f, "concave edge, 20 and 31.7 um", nook, {force, 0, 2 * force}, 2);
  Probe box(closed_box({0.1, 0.1, 0.1}), 0.0, {k_distance, k_distance, k_distance});
  check_force(f, "corner of a box", box, Vec3{1, 1, 1} * force, 3);
}

/// A ball at the far edge of a floor at x = 0.1, seen from it at `angle` from the vertical.
Vec3 around_edge(double angle, double distance) {
  return {0.1 + distance * std::sin(angle), 0, distance * std::cos(angle)};
}
Vec3 across_edge(double angle) { return {std::cos(angle), 0, -std::sin(angle)}; }

/// Rolls around the edge by the angle without slip: the spin takes up what lies in the contact plane of each motion.
void roll_around_edge(Simulation& s, double begin, double angle, int n) {
  const Vec3 from = clump(s, 0).position;
  const double distance = std::hypot(from.x - 0.1, from.z), turn = angle / n;
  const double spin = distance * std::sin(turn) / (0.5 * (k_radius + distance)) / s.time_step();
  for (int k = 1; k <= n; ++k) {
    hold_all(s);
    const Vec3 to = around_edge(begin + k * turn, distance) + Vec3{0, from.y, 0};
    lead(s, 0, (to - clump(s, 0).position) * (1.0 / s.time_step()), {0, spin, 0});
    s.step();
  }
  settle(s);
}

/// Pushed along the line to the edge, loaded in shear along and across it (m), then rolled around it.
void free_edge(Findings& f, double along, double across) {
  const double start = 0.4, turn = 0.7;
  Probe p(whole_floor(), 5.0, around_edge(start, k_distance));
  Simulation& s = p.simulation();
  const std::string name = fmt::format("free edge, moved {} um along and {} across", 1e6 * along, 1e6 * across);
  if (across == 0.0) check_force(f, "free edge", p, Vec3{std::sin(start), 0, std::cos(start)} * hertz_force(), 1);
  p.move_to(clump(s, 0).position + Vec3{0, along, 0} + across_edge(start) * across);
  const auto shear = [&](double angle) {
    const Vec3 force = s.contacts.shear(only_row(s));
    return Vec3{force.y, dot(force, across_edge(angle)), 0};
  };
  const double begin = std::atan2(clump(s, 0).position.x - 0.1, clump(s, 0).position.z);
  const double stiffness = 8.0 * shear_modulus_on_wall() * patch(), unit = stiffness * std::hypot(along, across);
  const Vec3 loaded = shear(begin);
  f.absolute(name + ": difference of the shear force, over it", "1", 0.0,
             norm(loaded + Vec3{along, across, 0} * stiffness) / unit, 1e-4, "Mindlin (1949)");
  roll_around_edge(s, begin, turn, 2000);
  // Projection at constant length keeps the size exactly, the direction up to the angle of a step.
  const bool is_mixed = along != 0.0 && across != 0.0;
  f.absolute(name + ", rolled around it by 40 degrees: change of the shear force, over it", "1", 0.0,
             norm(shear(begin + turn) - loaded) / unit, is_mixed ? 1e-4 : 1e-6, "kept, by rolling without slip");
}

void pieces(Findings& f) {
  check_seam(f, false);
  check_seam(f, true);
  convex_and_concave(f);
  free_edge(f, 1e-6, 0.0);
  free_edge(f, 0.0, 1e-6);
  free_edge(f, 1e-6, 1e-6);
  f.remark(
      "At an edge the engine brings the shear force to the new contact plane by projection at constant length. A force "
      "with components along and across the edge then turns by about a quarter of the angle of a step for each radian "
      "of rolling: 6e-5 here, at steps of 0.02 degrees, and nothing to speak of at the steps of a run. Faces, and "
      "contacts of two balls, have no such error.");
}

}  // namespace

void add_edge_cases(std::vector<VerificationCase>& cases) {
  cases.push_back(
      {"walls-of-pieces", "Walls made of several rectangles",
       "A gravel ball (R = 2.5 mm, overlap 20 um) at walls in pieces. A flat floor in two or four rectangles "
       "must push, hold and release it like one in one piece, on the way across the seam and back. A convex "
       "edge or corner counts once, along the shortest way; a concave one counts for each face. At a free "
       "edge the ball is pushed along the line to the edge, sticks along it with k_s = 8 G* sqrt(R d), and "
       "keeps its shear force when it rolls around it.",
       Extent::quick, pieces});
}

}  // namespace dem::verify
