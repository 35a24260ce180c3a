// SPDX-License-Identifier: BSD-3-Clause
// Straight rows of bonded balls, clamped at one end and loaded at the other, against beam formulas.
#include <fmt/format.h>

#include <cmath>

#include "dem4grm/verify/bond_checks.hpp"
#include "dem4grm/verify/driven_grain.hpp"

namespace dem::verify {

namespace {

constexpr double k_radius = 0.63e-3;  // m, of model_scene

enum class Load { pull, push, across, across_too, twist, moment };

/// Compliances of a row of n bonds: deflection or turn of the last centre under a unit load.
struct Beam {
  double axial_area, area, second_moment, modulus, shear_modulus, length, n;

  Beam(const BondSettings& b, int bonds, double radius) {
    const double bond_radius = b.radius_multiplier * radius;
    area = k_pi * bond_radius * bond_radius;
    axial_area = k_pi * radius * radius;
    second_moment = b.moment_scale * 0.25 * area * bond_radius * bond_radius;
    modulus = b.modulus;
    shear_modulus = b.modulus / b.stiffness_ratio;
    length = 2.0 * radius * bonds;
    n = bonds;
  }
  [[nodiscard]] double pull() const { return length / (modulus * area); }
  /// With the linear springs of all bonds beside them.
  [[nodiscard]] double push() const { return length / (modulus * (area + axial_area)); }
  [[nodiscard]] double across() const {
    return length * length * length / (3.0 * modulus * second_moment) * (1.0 - 0.25 / (n * n)) +
           length / (shear_modulus * area);
  }
  /// Turn under a unit force across, and deflection under a unit moment.
  [[nodiscard]] double mixed() const { return length * length / (2.0 * modulus * second_moment); }
  [[nodiscard]] double turn() const { return length / (modulus * second_moment); }
  [[nodiscard]] double twist() const { return length / (shear_modulus * 2.0 * second_moment); }
  /// Deflection or turn in the direction of the load.
  [[nodiscard]] double direct(Load load) const {
    switch (load) {
      case Load::pull:
        return pull();
      case Load::push:
        return push();
      case Load::twist:
        return twist();
      case Load::moment:
        return turn();
      default:
        return across();
    }
  }
};

struct Row {
  int bonds;
  Load load;
};

/// Motion of the loaded ball per unit load: along the load, and the other one that a force across and a moment bring
/// (turn about n x t, deflection along t).
struct TipMotion {
  double direct = 0.0, mixed = 0.0;
};

const Vec3 k_along = Vec3{1, 1, 1} * (1.0 / std::sqrt(3.0));
const Vec3 k_across = Vec3{1, -1, 0} * (1.0 / std::sqrt(2.0));
const Vec3 k_binormal = cross(k_along, k_across);

bool is_couple(Load load) { return load == Load::twist || load == Load::moment; }

Vec3 direction_of(Load load) {
  switch (load) {
    case Load::pull:
    case Load::twist:
      return k_along;
    case Load::push:
      return -k_along;
    case Load::across:
      return k_across;
    default:
      return k_binormal;
  }
}

TipMotion tip_motion(const Simulation& s, int ball, const Vec3& start, Load load, double size) {
  const Quaternion q = orientation_of(s, ball);
  const Vec3 move = s.balls.position(ball) - start, turn = Vec3{q.x, q.y, q.z} * 2.0, d = direction_of(load);
  TipMotion out;
  out.direct = dot(is_couple(load) ? turn : move, d) / size;
  if (load == Load::across) out.mixed = dot(turn, k_binormal) / size;
  if (load == Load::moment) out.mixed = dot(move, k_across) / size;
  return out;
}

OutsideLoad tip_load(int ball, Load load, double size) {
  const Vec3 value = direction_of(load) * size;
  return is_couple(load) ? OutsideLoad{ball, {}, value, false} : OutsideLoad{ball, value, {}, false};
}

/// A load that moves the tip by 1e-5 of the ball radius or turns it by as many radians.
double load_size(const Beam& beam, Load load) { return 1e-5 * (is_couple(load) ? 1.0 : k_radius) / beam.direct(load); }

/// Drag near the critical one of the softest row, and the steps until nothing of the swing is left.
struct Settling {
  double time_step, kept;
  int steps;
};

Settling settling(const BondSettings& bond, int bonds, double mass) {
  const double rate = 0.9 / std::sqrt(Beam(bond, bonds, k_radius).across() * 1.4 * mass);
  const double dt = 0.25 * k_radius * std::sqrt(1610.0 / bond.modulus);
  return {dt, 1.0 - 2.0 * rate * dt, static_cast<int>(30.0 / (rate * dt))};
}

/// Rows cut out of the diagonals of grains with incremental bonds, one grain each.
std::vector<TipMotion> rows_in_engine(BondSettings bond, const std::vector<Row>& rows) {
  bond.form = BondForm::incremental;
  bond.damping_ratio = 0.0;
  Scene scene = lone_grain_scene(bond);
  scene.grains.clear();
  for (std::size_t g = 0; g < rows.size(); ++g) scene.grains.push_back({{0.1 * static_cast<double>(g), 0, 0}, {}});
  Simulation s(scene);
  std::vector<OutsideLoad> loads;
  std::vector<Vec3> start;
  std::vector<double> size;
  int longest = 1;
  for (std::size_t g = 0; g < rows.size(); ++g) {
    const auto grain = static_cast<int>(g);
    keep_only_diagonal(s, grain, rows[g].bonds);
    size.push_back(load_size(Beam(bond, rows[g].bonds, k_radius), rows[g].load));
    for (int k = 0; k <= rows[g].bonds; ++k) {
      const int ball = BallStore::rubber_index(grain, k_diagonal_slots[static_cast<std::size_t>(k)]);
      loads.push_back(k == rows[g].bonds ? tip_load(ball, rows[g].load, size[g]) : OutsideLoad{ball, {}, {}, k == 0});
    }
    start.push_back(s.balls.position(loads.back().ball));
    longest = std::max(longest, rows[g].bonds);
  }
  const Settling settle = settling(bond, longest, s.rubber().ball_mass);
  s.set_time_step(settle.time_step);
  for (int k = 0; k < settle.steps; ++k) step_with_loads(s, loads, settle.kept);
  std::vector<TipMotion> out;
  for (std::size_t g = 0; g < rows.size(); ++g) {
    const int tip =
        BallStore::rubber_index(static_cast<int>(g), k_diagonal_slots[static_cast<std::size_t>(rows[g].bonds)]);
    out.push_back(tip_motion(s, tip, start[g], rows[g].load, size[g]));
  }
  return out;
}

/// One history-free bond: the ball at the grain's vertex has only one, and all other balls are held.
TipMotion vertex_in_engine(BondSettings bond, Load load) {
  bond.damping_ratio = 0.0;
  Simulation s(lone_grain_scene(bond));
  const double size = load_size(Beam(bond, 1, k_radius), load);
  const int tip = BallStore::rubber_index(0, k_diagonal_slots[4]);
  std::vector<OutsideLoad> loads{tip_load(tip, load, size)};
  for (int slot = 0; slot < k_grain_balls - 1; ++slot) {
    const int ball = BallStore::rubber_index(0, slot);
    if (ball != tip) loads.push_back({ball, {}, {}, true});
  }
  loads.push_back({BallStore::rubber_index(0, k_grain_balls - 1), {}, {}, true});
  const Vec3 start = s.balls.position(tip);
  const Settling settle = settling(bond, 1, s.rubber().ball_mass);
  s.set_time_step(settle.time_step);
  for (int k = 0; k < settle.steps; ++k) step_with_loads(s, loads, settle.kept);
  return tip_motion(s, tip, start, load, size);
}

constexpr double k_tolerance = 2e-6;
constexpr const char* k_source = "rigid links joined by springs, closed form";

const char* name_of(Load load) {
  switch (load) {
    case Load::pull:
      return "stretch under a pull";
    case Load::push:
      return "shortening under a push, linear springs beside";
    case Load::across:
      return "deflection under a force across";
    case Load::across_too:
      return "deflection under a force across, other direction";
    case Load::twist:
      return "twist under a torque";
    case Load::moment:
      return "turn under a moment";
  }
  return "";
}

void hold(Findings& findings, const std::string& setting, const Beam& beam, Load load, const TipMotion& found) {
  const std::string n = fmt::format("N = {:.0f}, {}", beam.n, setting);
  findings.relative(fmt::format("{}, {}", name_of(load), n), is_couple(load) ? "rad/(N m)" : "m/N", beam.direct(load),
                    found.direct, k_tolerance, k_source);
  if (load == Load::across) {
    findings.relative("turn under a force across, " + n, "rad/N", beam.mixed(), found.mixed, k_tolerance, k_source);
  }
  if (load == Load::moment) {
    findings.relative("deflection under a moment, " + n, "1/N", beam.mixed(), found.mixed, k_tolerance, k_source);
  }
}

struct Setting {
  std::string name;
  BondSettings bond;
};

std::vector<Setting> changed_settings() {
  std::vector<Setting> out(4);
  out[0].name = "E = 35 MPa";
  out[0].bond.modulus = 35e6;
  out[1].name = "kappa = 2.5";
  out[1].bond.stiffness_ratio = 2.5;
  out[2].name = "lambda = 0.8";
  out[2].bond.radius_multiplier = 0.8;
  out[3].name = "s = 0.5";
  out[3].bond.moment_scale = 0.5;
  return out;
}

void draw_deflections(Findings& findings, const std::vector<TipMotion>& found) {
  Picture p{"bond-cantilever",
            "Tip deflection over the value of a slender beam without shear",
            "number of bonds N",
            "w / (P L^3 / 3 E I)",
            {}};
  Series engine{"engine", false, {}, {}}, formula{"formula", true, {}, {}};
  for (int n = 1; n <= 10; ++n) {
    const Beam beam({}, n, k_radius);
    const double slender = beam.turn() * beam.length * beam.length / 3.0;
    formula.x.push_back(n);
    formula.y.push_back(beam.across() / slender);
    if (n > 4) continue;
    engine.x.push_back(n);
    engine.y.push_back(found[static_cast<std::size_t>(n - 1)].direct / slender);
  }
  p.series = {engine, formula};
  findings.picture(p);
}

}  // namespace

void check_cantilever(Findings& findings) {
  const std::vector<Row> first{{1, Load::across}, {2, Load::across},     {3, Load::across}, {4, Load::across},
                               {1, Load::twist},  {4, Load::across_too}, {4, Load::twist},  {4, Load::moment}};
  const std::vector<Row> second{
      {4, Load::pull}, {4, Load::push}, {4, Load::across}, {4, Load::twist}, {4, Load::moment}};
  const BondSettings published;
  const std::vector<TipMotion> found = rows_in_engine(published, first);
  for (std::size_t k = 0; k < first.size(); ++k) {
    hold(findings, "published", Beam(published, first[k].bonds, k_radius), first[k].load, found[k]);
  }
  for (const Setting& s : changed_settings()) {
    const std::vector<TipMotion> changed = rows_in_engine(s.bond, second);
    for (std::size_t k = 0; k < second.size(); ++k) {
      hold(findings, s.name, Beam(s.bond, second[k].bonds, k_radius), second[k].load, changed[k]);
    }
  }
  for (const Setting& s : changed_settings()) {
    for (const Load load : {Load::pull, Load::push, Load::across, Load::twist, Load::moment}) {
      hold(findings, s.name + ", history-free", Beam(s.bond, 1, k_radius), load, vertex_in_engine(s.bond, load));
    }
  }
  check_row_statics(findings);
  draw_deflections(findings, found);
}

}  // namespace dem::verify
