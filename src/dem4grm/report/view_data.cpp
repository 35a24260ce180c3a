// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/view_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/report/grain_prediction.hpp"
#include "dem4grm/report/packed_integers.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/micro_state_file.hpp"
#include "dem4grm/results/results_file.hpp"

namespace dem {
namespace {

constexpr double k_lattice_steps = 16383.0;  // 2^14 - 1
constexpr double k_finest_step = 1e-6;       // m, of sizes
constexpr double k_most_steps = 30'000.0;    // of sizes: within 16 bits with their sign
constexpr double k_quaternion_scale = 32767.0;
constexpr PackingRule k_unsigned16{2, false, false}, k_signed16{2, true, false}, k_ascending32{4, false, true},
    k_plain32{4, false, false}, k_byte{1, false, false};

/// What a view needs of one stored state.
struct ViewedState {
  double displacement = 0.0;  ///< m
  MicroState micro;
  std::vector<Vec3> ball_position;      ///< [n_balls] m
  std::vector<double> ball_radius;      ///< [n_balls] m
  std::vector<std::int64_t> ball_body;  ///< [n_balls]
  std::vector<Vec3> clump_position;     ///< [n_clumps] m
  std::vector<Quaternion> clump_orientation;
  std::vector<double> clump_mass;  ///< kg
  struct Plane {
    std::string name;
    Vec3 corner, u, v;  ///< m
  };
  std::vector<Plane> walls;

  [[nodiscard]] std::size_t n_grains() const { return micro.rubber.n_grains(); }
};

void read_wall_planes(const hdf5::Handle& frame, ViewedState& out) {
  const hdf5::Handle group = hdf5::open_group(frame, "walls");
  const std::vector<std::string> names = hdf5::read_texts(group, "name");
  const std::vector<Vec3> corner = hdf5::read_vectors(group, "corner"), u = hdf5::read_vectors(group, "u"),
                          v = hdf5::read_vectors(group, "v");
  const std::vector<double> lengths = hdf5::read_dataset(group, "lengths");
  for (std::size_t w = 0; w < names.size(); ++w) {
    out.walls.push_back({names[w], corner.at(w), u.at(w) * lengths.at(2 * w), v.at(w) * lengths.at(2 * w + 1)});
  }
}

ViewedState read_viewed_state(const std::filesystem::path& path, const hdf5::Handle& frames, const StoredFrame& info) {
  ViewedState out;
  out.displacement = info.displacement;
  out.micro = read_micro_state(path, info.displacement).state;
  const hdf5::Handle frame = hdf5::open_group(frames, info.name);
  const hdf5::Handle balls = hdf5::open_group(frame, "balls");
  out.ball_position = hdf5::read_vectors(balls, "position");
  out.ball_radius = hdf5::read_dataset(balls, "radius");
  out.ball_body = hdf5::read_whole_numbers(balls, "body");
  const hdf5::Handle clumps = hdf5::open_group(frame, "clumps");
  out.clump_position = hdf5::read_vectors(clumps, "position");
  out.clump_mass = hdf5::read_dataset(clumps, "mass");
  const std::vector<double> q = hdf5::read_dataset(clumps, "orientation");
  for (std::size_t k = 0; k + 3 < q.size(); k += 4)
    out.clump_orientation.push_back({q[k], q[k + 1], q[k + 2], q[k + 3]});
  read_wall_planes(frame, out);
  const bool fits =
      out.ball_radius.size() == out.ball_position.size() && out.ball_body.size() == out.ball_position.size() &&
      out.clump_orientation.size() == out.clump_position.size() && out.clump_mass.size() == out.clump_position.size() &&
      out.n_grains() * k_grain_balls <= out.ball_position.size();
  if (!fits)
    throw IoError(fmt::format("{}: the balls and clumps of state {} do not fit together", path.string(), info.name));
  return out;
}

/// Places as whole numbers of steps from an origin.
struct Lattice {
  Vec3 origin, step;  ///< m

  [[nodiscard]] Vec3 steps_of(const Vec3& p) const {
    const Vec3 d = p - origin;
    return {std::round(d.x / step.x), std::round(d.y / step.y), std::round(d.z / step.z)};
  }
};

Lattice lattice_around(const std::vector<ViewedState>& states) {
  constexpr double k_far = std::numeric_limits<double>::max();
  Vec3 low{k_far, k_far, k_far}, high{-k_far, -k_far, -k_far};
  const auto take = [&](const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (const ViewedState& state : states) {
    for (const Vec3& p : state.ball_position) take(p);
    for (const Vec3& p : state.clump_position) take(p);
  }
  const auto step = [](double length) { return std::max(length / k_lattice_steps, 1e-9); };
  return {low, {step(high.x - low.x), step(high.y - low.y), step(high.z - low.z)}};
}

/// All x, then all y, then all z.
std::array<std::vector<std::int32_t>, 3> columns_on(const Lattice& lattice, std::span<const Vec3> places) {
  std::array<std::vector<std::int32_t>, 3> out;
  for (const Vec3& place : places) {
    const Vec3 steps = lattice.steps_of(place);
    out[0].push_back(static_cast<std::int32_t>(steps.x));
    out[1].push_back(static_cast<std::int32_t>(steps.y));
    out[2].push_back(static_cast<std::int32_t>(steps.z));
  }
  return out;
}

std::vector<std::int32_t> joined(const std::array<std::vector<std::int32_t>, 3>& columns) {
  std::vector<std::int32_t> out;
  for (const std::vector<std::int32_t>& column : columns) out.insert(out.end(), column.begin(), column.end());
  return out;
}

/// Numbers as multiples of a step, which comes out so that the largest needs `most` of them.
struct Scaled {
  double step = 1.0;
  std::vector<std::int32_t> numbers;
};
Scaled scaled(std::span<const double> values, double most) {
  Scaled out;
  double largest = 0.0;
  for (const double v : values) largest = std::isfinite(v) ? std::max(largest, std::fabs(v)) : largest;
  if (largest > 0.0) out.step = largest / most;
  for (const double v : values) {
    out.numbers.push_back(std::isfinite(v) ? static_cast<std::int32_t>(std::round(v / out.step)) : 0);
  }
  return out;
}

/// Mean stress of each body, Pa, compression positive: a third of the trace of -(1/V) sum F (x) (p - x), F the force on the
/// body at p, x its centre, V its solid volume. Source: the stress of one grain in a granular medium, Love (1927), Weber (1966).
std::vector<double> body_stresses(const ViewedState& state, const DirectShearCase& test) {
  const ContactNetwork& network = state.micro.network;
  std::vector<double> moment(network.body_position.size(), 0.0);  // N m
  const auto add = [&](int body, const Vec3& force_of_body, const Vec3& point) {
    const auto b = static_cast<std::size_t>(body);
    moment.at(b) += dot(force_of_body, point - network.body_position.at(b));
  };
  for (const Contact& c : network.contacts) {
    const Vec3 force = force_on_second(c);  // of i on j: what body i presses with, so compression is positive
    add(c.body_i, force, c.point);
    add(c.body_j, force * -1.0, c.point);
  }
  for (const WallContact& c : network.wall_contacts) add(c.body, force_on_second(c), c.point);
  const std::size_t n_grains = state.n_grains();
  for (std::size_t b = 0; b < moment.size(); ++b) {
    double volume = 0.0;
    if (b < n_grains) {
      const double r = state.ball_radius[b * k_grain_balls];
      volume =
          k_grain_balls * 4.0 / 3.0 * std::numbers::pi * r * r * r * test.rubber.density / test.rubber_solid_density;
    } else {
      volume = state.clump_mass[b - n_grains] / test.gravel.density;
    }
    moment[b] /= 3.0 * volume;
  }
  return moment;
}

JsonList in_mm(const Vec3& v) { return {v.x * 1e3, v.y * 1e3, v.z * 1e3}; }

JsonObject state_as_json(const ViewedState& state, const Lattice& lattice, const DirectShearCase& test) {
  JsonObject out{{"displacement_mm", state.displacement * 1e3}};
  const std::size_t n_rubber_balls = state.n_grains() * k_grain_balls;
  auto rubber = columns_on(lattice, std::span(state.ball_position).first(n_rubber_balls));
  const GrainPrediction prediction = grain_prediction();
  for (std::vector<std::int32_t>& column : rubber) column = prediction_residuals(column, prediction);
  out.push_back({"rubber", packed(joined(rubber), k_signed16)});
  out.push_back({"clump_position", packed(joined(columns_on(lattice, state.clump_position)), k_unsigned16)});
  std::array<std::vector<std::int32_t>, 4> turns;
  for (const Quaternion& q : state.clump_orientation) {
    const std::array<double, 4> parts{q.w, q.x, q.y, q.z};
    for (std::size_t k = 0; k < 4; ++k) {
      turns[k].push_back(static_cast<std::int32_t>(std::round(std::clamp(parts[k], -1.0, 1.0) * k_quaternion_scale)));
    }
  }
  std::vector<std::int32_t> orientation;
  for (const auto& column : turns) orientation.insert(orientation.end(), column.begin(), column.end());
  out.push_back({"clump_orientation", packed(orientation, k_signed16)});

  const Scaled stress = scaled(body_stresses(state, test), 32767.0);
  out.push_back({"stress_step_kPa", stress.step * 1e-3});
  out.push_back({"body_stress", packed(stress.numbers, k_signed16)});
  const Scaled strain = scaled(rubber_report(state.micro.rubber).grain_bond_strain, 32767.0);
  out.push_back({"strain_step", strain.step});
  out.push_back({"bond_strain", packed(strain.numbers, k_signed16)});

  // One line for each pair of grains that touch, whatever the number of their contacts.
  const std::vector<Contact> pairs = merge_pairs(state.micro.network.contacts);
  std::vector<std::int32_t> body_i, body_j;
  std::vector<double> force;
  double sum = 0.0;
  for (const Contact& c : pairs) {
    body_i.push_back(c.body_i);
    body_j.push_back(c.body_j);
    force.push_back(std::max(c.normal_force, 0.0));
    sum += force.back();
  }
  const Scaled forces = scaled(force, 65535.0);
  out.push_back({"contact_body_i", packed(body_i, k_ascending32)});
  out.push_back({"contact_body_j", packed(body_j, k_plain32)});
  out.push_back({"force_step_N", forces.step});
  out.push_back({"contact_force", packed(forces.numbers, k_unsigned16)});
  out.push_back({"strong_threshold_N", pairs.empty() ? 0.0 : sum / static_cast<double>(pairs.size())});
  JsonList walls;
  for (const ViewedState::Plane& wall : state.walls) {
    walls.emplace_back(JsonObject{
        {"name", wall.name}, {"corner_mm", in_mm(wall.corner)}, {"u_mm", in_mm(wall.u)}, {"v_mm", in_mm(wall.v)}});
  }
  out.push_back({"walls", std::move(walls)});
  return out;
}

/// Radii and shapes, from the first state.
void add_sizes(const ViewedState& first, JsonObject& out) {
  const std::size_t n_rubber_balls = first.n_grains() * k_grain_balls;
  std::vector<Vec3> place;
  std::vector<double> sizes, rubber_radius;
  std::vector<std::int32_t> count(first.clump_position.size(), 0);
  for (std::size_t g = 0; g < first.n_grains(); ++g) rubber_radius.push_back(first.ball_radius[g * k_grain_balls]);
  for (std::size_t ball = n_rubber_balls; ball < first.ball_position.size(); ++ball) {
    const auto clump = static_cast<std::size_t>(first.ball_body[ball]) - first.n_grains();
    ++count.at(clump);
    place.push_back(to_body(frame_of(normalized(first.clump_orientation[clump])),
                            first.ball_position[ball] - first.clump_position[clump]));
  }
  double largest = 0.0;
  for (const Vec3& p : place) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  for (const double r : first.ball_radius) largest = std::max(largest, r);
  const double step = std::max(k_finest_step, largest / k_most_steps);
  const auto steps = [step](double length) { return static_cast<std::int32_t>(std::round(length / step)); };
  std::vector<std::int32_t> grain_radii, pebble_places, pebble_radii;
  for (const double r : rubber_radius) grain_radii.push_back(steps(r));
  for (const Vec3& p : place) pebble_places.insert(pebble_places.end(), {steps(p.x), steps(p.y), steps(p.z)});
  for (std::size_t ball = n_rubber_balls; ball < first.ball_radius.size(); ++ball) {
    pebble_radii.push_back(steps(first.ball_radius[ball]));
  }
  out.push_back({"radius_step_mm", step * 1e3});
  out.push_back({"rubber_radius", packed(grain_radii, k_unsigned16)});
  JsonList prediction;
  for (const std::array<int, 3>& row : grain_prediction()) prediction.emplace_back(JsonList{row[0], row[1], row[2]});
  out.push_back({"rubber_prediction", std::move(prediction)});
  out.push_back({"clump_pebbles", packed(count, k_byte)});
  out.push_back({"pebble_position", packed(pebble_places, k_signed16)});
  out.push_back({"pebble_radius", packed(pebble_radii, k_unsigned16)});
}

std::vector<ViewedState> read_viewed_states(const std::filesystem::path& path, const hdf5::Handle& file,
                                            std::size_t most) {
  const std::vector<StoredFrame> frames = read_outline(path).frames;
  const hdf5::Handle group = hdf5::open_group(file, "frames");
  std::vector<ViewedState> states;
  for (const std::size_t k : chosen_states(frames.size(), most)) {
    states.push_back(read_viewed_state(path, group, frames[k]));
    const bool fits = states.back().ball_position.size() == states.front().ball_position.size() &&
                      states.back().clump_position.size() == states.front().clump_position.size();
    if (!fits)
      throw IoError(fmt::format("{}: states {} and {} hold different grains", path.string(), frames.front().name,
                                frames[k].name));
  }
  if (states.empty()) throw MissingFileError(fmt::format("{}: holds no state yet", path.string()));
  return states;
}

}  // namespace

std::vector<std::size_t> chosen_states(std::size_t available, std::size_t most) {
  std::vector<std::size_t> out;
  const std::size_t n = std::min(available, std::max<std::size_t>(most, 2));
  for (std::size_t k = 0; k < n; ++k) out.push_back(n == 1 ? 0 : (k * (available - 1) + (n - 1) / 2) / (n - 1));
  return out;
}

JsonObject view_of(const std::filesystem::path& results, std::size_t most) {
  const hdf5::Handle file = open_results(results);
  const std::string resolved = hdf5::read_text(hdf5::open_group(file, "meta"), "resolved_toml");
  const DirectShearCase test = std::get<DirectShearCase>(parse_case(resolved, "resolved.toml").test);
  std::vector<ViewedState> states;
  try {
    states = read_viewed_states(results, file, most);
  } catch (const std::out_of_range&) {
    throw IoError(fmt::format("{}: a state names a ball, body or wall that is not there", results.string()));
  }
  const Lattice lattice = lattice_around(states);
  JsonObject out{{"origin_mm", in_mm(lattice.origin)},
                 {"step_mm", in_mm(lattice.step)},
                 {"rubber_grains", static_cast<std::int64_t>(states.front().n_grains())},
                 {"clumps", static_cast<std::int64_t>(states.front().clump_position.size())}};
  add_sizes(states.front(), out);
  JsonList list;
  for (const ViewedState& state : states) list.emplace_back(state_as_json(state, lattice, test));
  out.push_back({"states", std::move(list)});
  return out;
}

}  // namespace dem
