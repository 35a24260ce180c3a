// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/stiffest_mode.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "dem4grm/core/blocks.hpp"
#include "dem4grm/core/random.hpp"

namespace dem {

namespace {

/// Displacement and turn of a body, or force and torque on it; or both scaled with mass and inertia.
struct Twist {
  Vec3 along, about;
};
using Twists = std::vector<Twist>;

/// Joints are weighted as dt^2 k + 2 dt c.
struct Weights {
  double normal = 0.0, shear = 0.0, bending = 0.0, twisting = 0.0;
};

/// Joint at the contact point of two bodies; j < 0: a wall, which does not give.
struct BodyJoint {
  int i = 0, j = -1;
  Vec3 normal, arm_i, arm_j;  // arms from the centres of the bodies to the point, m
  double weight_normal = 0.0, weight_shear = 0.0;
};

/// Of the balls and bonds of one size of rubber grain.
struct SizeRoots {
  double inverse_mass_root = 0.0, inverse_inertia_root = 0.0;
  Weights bond;
};

constexpr std::size_t k_grains_per_block = 16, k_bodies_per_block = 2048;

class Assembly {
 public:
  Assembly(const Simulation& s, double dt) : s_(s), dt_(dt), n_balls_(s.balls.n_rubber_balls()) {
    for (const RubberSize& size : s.rubber_sizes) add_size(size);
    for (std::size_t row = 0; row < s.contacts.n_pairs(); ++row) add_contact(row, false);
    for (std::size_t row = s.contacts.n_pair_rows(); row < s.contacts.n_rows(); ++row) add_contact(row, true);
    for (const Clump& c : s.clumps.clumps) add_inverse_roots(c);
    moved_.resize(n_bodies());
    force_.resize(n_bodies());
  }

  [[nodiscard]] std::size_t n_bodies() const { return static_cast<std::size_t>(n_balls_) + s_.clumps.clumps.size(); }
  [[nodiscard]] bool is_joined() const { return n_balls_ > 0 || !contacts_.empty(); }

  /// y = A x, both mass-scaled.
  void multiply(const Twists& x, Twists& y) {
    for_each_block(n_bodies(), k_bodies_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) moved_[b] = scaled(b, x[b]);
    });
    for_each_block(static_cast<std::size_t>(s_.balls.n_grains), k_grains_per_block,
                   [&](std::size_t, std::size_t begin, std::size_t end) {
                     for (std::size_t g = begin; g < end; ++g) add_grain(static_cast<int>(g));
                   });
    for (std::size_t b = static_cast<std::size_t>(n_balls_); b < n_bodies(); ++b) force_[b] = {};
    for (const BodyJoint& joint : contacts_) apply(joint);
    for_each_block(n_bodies(), k_bodies_per_block, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) y[b] = scaled(b, force_[b]);
    });
  }

 private:
  /// Body of a ball: itself in a rubber grain, its clump else.
  [[nodiscard]] int body(int id) const {
    return id < n_balls_ ? id : n_balls_ + s_.clumps.clump_of_pebble[static_cast<std::size_t>(id - n_balls_)];
  }
  [[nodiscard]] Vec3 centre(int body) const {
    return body < n_balls_ ? s_.balls.position(s_.balls.index_of_id(body))
                           : s_.clumps.clumps[static_cast<std::size_t>(body - n_balls_)].position;
  }

  void add_size(const RubberSize& size) {
    const double r = size.ball_radius, square = dt_ * dt_;
    const BondParameters& b = size.bond;
    const double friction_spring = b.spring_friction > 0.0 ? b.linear_shear_stiffness : 0.0;
    sizes_.push_back({1.0 / std::sqrt(size.ball_mass),
                      1.0 / std::sqrt(0.4 * size.ball_mass * r * r),
                      {square * (b.normal_stiffness + b.linear_stiffness) + 2.0 * dt_ * b.dashpot,
                       square * (b.shear_stiffness + friction_spring), square * b.bending_stiffness,
                       square * b.twisting_stiffness}});
  }
  [[nodiscard]] std::size_t size_of(std::size_t grain) const {
    return static_cast<std::size_t>(s_.size_of_block[grain / k_lanes]);
  }

  void add_contact(std::size_t row, bool is_wall) {
    const ContactTable& t = s_.contacts;
    const ContactState& state = t.state[row];
    if (!(state.overlap > 0.0)) return;
    const PairKey pair = is_wall ? t.wall_pairs[row - t.n_pair_rows()] : t.pairs[row];
    const double k = 1.5 * t.hertz[row] * std::sqrt(state.overlap), fourth_root = std::sqrt(std::sqrt(state.overlap));
    const double dashpot_n = t.has_dashpots() ? t.normal_dashpot[row] * fourth_root : 0.0;
    const double dashpot_s = t.has_dashpots() ? t.shear_dashpot[row] * fourth_root : 0.0;
    BodyJoint joint;
    joint.i = body(first_of(pair));
    joint.normal = state.normal;
    joint.weight_normal = dt_ * dt_ * k + 2.0 * dt_ * dashpot_n;
    joint.weight_shear = dt_ * dt_ * k * t.shear_ratio[row] + 2.0 * dt_ * dashpot_s;
    const Vec3 point = s_.balls.position(t.index_i[row]) + state.normal * t.lever_i(row);
    joint.arm_i = point - centre(joint.i);
    if (!is_wall) {
      joint.j = body(second_of(pair));
      joint.arm_j = point - centre(joint.j);
    }
    contacts_.push_back(joint);
  }

  /// I^-1/2 of a clump in space axes, as its three columns.
  void add_inverse_roots(const Clump& c) {
    const Frame f = frame_of(c.orientation);
    const double a = 1.0 / std::sqrt(c.inertia.x), b = 1.0 / std::sqrt(c.inertia.y), d = 1.0 / std::sqrt(c.inertia.z);
    const auto column = [&](double x, double y, double z) { return f.e1 * (a * x) + f.e2 * (b * y) + f.e3 * (d * z); };
    clump_roots_.push_back(
        {column(f.e1.x, f.e2.x, f.e3.x), column(f.e1.y, f.e2.y, f.e3.y), column(f.e1.z, f.e2.z, f.e3.z)});
  }

  [[nodiscard]] Twist scaled(std::size_t b, const Twist& t) const {
    if (b < static_cast<std::size_t>(n_balls_)) {
      const SizeRoots& size = sizes_[size_of(b / k_grain_balls)];
      return {t.along * size.inverse_mass_root, t.about * size.inverse_inertia_root};
    }
    const std::size_t c = b - static_cast<std::size_t>(n_balls_);
    const auto& root = clump_roots_[c];
    return {t.along * (1.0 / std::sqrt(s_.clumps.clumps[c].mass)),
            root[0] * t.about.x + root[1] * t.about.y + root[2] * t.about.z};
  }

  void apply(const BodyJoint& joint) {
    const Twist& u_i = moved_[static_cast<std::size_t>(joint.i)];
    Vec3 gap = -u_i.along - cross(u_i.about, joint.arm_i);
    if (joint.j >= 0) {
      const Twist& u_j = moved_[static_cast<std::size_t>(joint.j)];
      gap += u_j.along + cross(u_j.about, joint.arm_j);
    }
    const double closing = dot(gap, joint.normal);
    const Vec3 f = joint.normal * (closing * (joint.weight_normal - joint.weight_shear)) + gap * joint.weight_shear;
    Twist& on_i = force_[static_cast<std::size_t>(joint.i)];
    on_i.along -= f;
    on_i.about -= cross(joint.arm_i, f);
    if (joint.j < 0) return;
    Twist& on_j = force_[static_cast<std::size_t>(joint.j)];
    on_j.along += f;
    on_j.about += cross(joint.arm_j, f);
  }

  /// Bonds and closed second neighbours of one grain; begins the forces on its balls.
  void add_grain(int grain) {
    const auto first = static_cast<std::size_t>(grain) * k_grain_balls;
    Vec3 position[k_grain_balls];
    for (int slot = 0; slot < k_grain_balls; ++slot) {
      position[slot] = s_.balls.position(BallStore::rubber_index(grain, slot));
      force_[first + static_cast<std::size_t>(slot)] = {};
    }
    const RubberSize& size = s_.rubber_of_grain(grain);
    const Weights& bond = sizes_[size_of(static_cast<std::size_t>(grain))].bond;
    const double r = size.ball_radius;
    for (const SlotPair& p : k_bonds_of_grain) {
      const Vec3 branch = position[p.j] - position[p.i];
      const double length = norm(branch);
      Weights w = bond;
      if (s_.scene.bond.hertz_contact && length < 2.0 * r) add_hertz(size.second_neighbour, 2.0 * r - length, w);
      join(first + p.i, first + p.j, branch * (1.0 / length), 0.5 * length, w);
    }
    for (const SlotPair& p : k_second_neighbours_of_grain) {
      const Vec3 branch = position[p.j] - position[p.i];
      const double squared = dot(branch, branch);
      if (squared >= 4.0 * r * r) continue;
      const double length = std::sqrt(squared);
      Weights w;
      add_hertz(size.second_neighbour, 2.0 * r - length, w);
      join(first + p.i, first + p.j, branch * (1.0 / length), 0.5 * length, w);
    }
  }

  /// Hertz contact of two balls of a grain.
  void add_hertz(const HertzParameters& p, double overlap, Weights& w) const {
    const double k = 1.5 * p.hertz * std::sqrt(overlap), fourth_root = std::sqrt(std::sqrt(overlap));
    w.normal += dt_ * dt_ * k + 2.0 * dt_ * p.normal_dashpot * fourth_root;
    w.shear += dt_ * dt_ * k * p.shear_ratio + 2.0 * dt_ * p.shear_dashpot * fourth_root;
  }

  void join(std::size_t i, std::size_t j, const Vec3& n, double lever, const Weights& w) {
    const Twist &u_i = moved_[i], &u_j = moved_[j];
    const Vec3 gap = u_j.along - u_i.along - cross(u_i.about + u_j.about, n) * lever;
    const Vec3 turn = u_j.about - u_i.about;
    const Vec3 f = n * (dot(gap, n) * (w.normal - w.shear)) + gap * w.shear;
    const Vec3 m = n * (dot(turn, n) * (w.twisting - w.bending)) + turn * w.bending;
    const Vec3 couple = cross(n, f) * lever;
    force_[i].along -= f;
    force_[j].along += f;
    force_[i].about -= couple + m;
    force_[j].about += m - couple;
  }

  const Simulation& s_;
  double dt_;
  int n_balls_;                   // of rubber grains
  std::vector<SizeRoots> sizes_;  // of Simulation::rubber_sizes
  std::vector<BodyJoint> contacts_;
  std::vector<std::array<Vec3, 3>> clump_roots_;
  Twists moved_, force_;
};

double product(const Twists& a, const Twists& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += dot(a[k].along, b[k].along) + dot(a[k].about, b[k].about);
  return sum;
}

/// The same for every numbering in memory, because it goes by body.
Twists random_start(std::size_t n) {
  RandomSequence random(0, RandomStream::stiffest_mode, 0);
  Twists x(n);
  const auto draw = [&] { return random.uniform(-1.0, 1.0); };
  for (Twist& t : x) t = {{draw(), draw(), draw()}, {draw(), draw(), draw()}};
  return x;
}

void scale(Twists& x, double factor) {
  for (Twist& t : x) t.along = t.along * factor, t.about = t.about * factor;
}

}  // namespace

double stiffest_mode(const Simulation& s, double dt, int lanczos_steps) {
  Assembly assembly(s, dt);
  if (!assembly.is_joined()) return 0.0;
  Twists v = random_start(assembly.n_bodies()), before(v.size()), w(v.size());
  scale(v, 1.0 / std::sqrt(product(v, v)));
  Eigen::VectorXd diagonal(lanczos_steps), beside(lanczos_steps);
  int n = 0;
  for (double norm_before = 0.0; n < lanczos_steps;) {
    assembly.multiply(v, w);
    const double alpha = product(v, w);
    for (std::size_t k = 0; k < w.size(); ++k) {
      w[k].along -= v[k].along * alpha + before[k].along * norm_before;
      w[k].about -= v[k].about * alpha + before[k].about * norm_before;
    }
    const double beta = std::sqrt(product(w, w));
    diagonal[n] = alpha;
    beside[n] = beta;
    ++n;
    if (!(beta > 1e-12 * std::fabs(alpha))) break;  // the start lies in a space that has been searched completely
    norm_before = beta;
    before.swap(v);
    v.swap(w);
    scale(v, 1.0 / beta);
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal.head(n), beside.head(n - 1), Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

double stable_time_step(const Simulation& s, double dt) {
  const double lambda = stiffest_mode(s, dt);
  if (lambda == 0.0) return std::numeric_limits<double>::infinity();
  return lambda < 4.0 ? dt * std::sqrt(4.0 / lambda) : dt * 4.0 / lambda;
}

}  // namespace dem
