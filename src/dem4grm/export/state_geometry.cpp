// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/export/state_geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "dem4grm/core/error.hpp"
#include "dem4grm/micro/height_profile.hpp"
#include "dem4grm/micro/strong_network.hpp"

namespace dem {
namespace {

constexpr double k_to_mm = 1e3, k_to_kPa = 1e-3, k_to_deg = 180.0 / std::numbers::pi;
constexpr float k_no_number = std::numeric_limits<float>::quiet_NaN();

using Reals = VtkArray::Reals;
using Wholes = VtkArray::Wholes;
using Flags = VtkArray::Flags;

void append_scaled(Reals& values, const Vec3& v, double factor = 1.0) {
  for (const double x : {v.x, v.y, v.z}) values.push_back(static_cast<float>(x * factor));
}

Reals scaled(std::span<const double> values, double factor = 1.0) {
  Reals out;
  out.reserve(values.size());
  for (const double v : values) out.push_back(static_cast<float>(v * factor));
  return out;
}

Reals scaled(std::span<const Vec3> vectors, double factor) {
  Reals out;
  out.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) append_scaled(out, v, factor);
  return out;
}

Reals lengths_of(std::span<const Vec3> vectors, double factor) {
  Reals out;
  for (const Vec3& v : vectors) out.push_back(static_cast<float>(norm(v) * factor));
  return out;
}

/// A point of its own and a vertex on it for each place, m.
void add_vertices(VtkPolyData& data, std::span<const Vec3> places) {
  data.kind = VtkCells::vertices;
  for (const Vec3& place : places) data.add_cell({data.add_point(place)});
}

/// What clumps and rubber grains have in common, for the bodies [begin, begin + count).
void add_body_arrays(const ShownState& state, std::size_t begin, std::size_t count, VtkPolyData& data) {
  Wholes body;
  for (std::size_t b = begin; b < begin + count; ++b) body.push_back(static_cast<std::int32_t>(b));
  const auto of_bodies = [&](const auto& values) { return std::span(values).subspan(begin, count); };
  const std::span<const int> contacts = of_bodies(state.loads.contacts);
  data.point_data.push_back({"body", std::move(body)});
  data.point_data.push_back({"displacement_mm", scaled(of_bodies(state.displacement), k_to_mm), 3});
  data.point_data.push_back({"rotation_deg", lengths_of(of_bodies(state.rotation), k_to_deg)});
  data.point_data.push_back({"rotation_vector_deg", scaled(of_bodies(state.rotation), k_to_deg), 3});
  data.point_data.push_back({"contacts", Wholes(contacts.begin(), contacts.end())});
  data.point_data.push_back({"mean_stress_kPa", scaled(of_bodies(state.loads.mean_stress), k_to_kPa)});
}

/// Mean strain of the bonds of each rubber grain that are not broken; not a number when all are.
std::vector<double> mean_bond_strains(const RubberState& rubber) {
  return rubber.n_grains() > 0 ? rubber_report(rubber).grain_bond_strain : std::vector<double>{};
}

/// Columns of contacts as they are collected.
struct ContactArrays {
  Wholes kind, body_i, body_j, wall;
  Flags strong, sliding;
  Reals normal_force, shear_force, shear_vector, point, normal, force_at_ends;

  template <class AnyContact>
  void take(const AnyContact& c, bool is_strong) {
    strong.push_back(is_strong ? 1 : 0);
    sliding.push_back(c.is_sliding ? 1 : 0);
    normal_force.push_back(static_cast<float>(c.normal_force));
    shear_force.push_back(static_cast<float>(norm(c.shear_force)));
    append_scaled(shear_vector, c.shear_force);
    append_scaled(point, c.point, k_to_mm);
    append_scaled(normal, c.normal);
    force_at_ends.insert(force_at_ends.end(), 2, static_cast<float>(c.normal_force));
  }
};

void add_contact_arrays(ContactArrays arrays, VtkPolyData& data) {
  data.point_data = {{"normal_force_N", std::move(arrays.force_at_ends)}};
  data.cell_data = {{"kind", std::move(arrays.kind)},
                    {"strong", std::move(arrays.strong)},
                    {"sliding", std::move(arrays.sliding)},
                    {"normal_force_N", std::move(arrays.normal_force)},
                    {"shear_force_N", std::move(arrays.shear_force)},
                    {"shear_vector_N", std::move(arrays.shear_vector), 3},
                    {"normal", std::move(arrays.normal), 3},
                    {"point_mm", std::move(arrays.point), 3},
                    {"body_i", std::move(arrays.body_i)},
                    {"body_j", std::move(arrays.body_j)},
                    {"wall", std::move(arrays.wall)}};
}

}  // namespace

ShownState shown_state(const StoredState& first, const StoredState& now, const GrainDensities& densities) {
  const std::size_t n_bodies = now.n_bodies(), n_balls = now.packing.position.size();
  if (first.n_bodies() != n_bodies || first.packing.position.size() != n_balls) {
    throw IoError(fmt::format("the states {} and {} hold different grains", first.name, now.name));
  }
  ShownState out{now, {}, {}, {}, mean_bond_strains(now.micro.rubber), body_loads(now, densities)};
  for (std::size_t b = 0; b < n_bodies; ++b) {
    out.displacement.push_back(now.micro.network.body_position[b] - first.micro.network.body_position[b]);
    out.rotation.push_back(rotation_between(first.orientation[b], now.orientation[b]));
  }
  for (std::size_t k = 0; k < n_balls; ++k) {
    out.ball_displacement.push_back(now.packing.position[k] - first.packing.position[k]);
  }
  return out;
}

VtkPolyData balls_of(const ShownState& state) {
  const Packing& packing = state.now.packing;
  VtkPolyData data;
  add_vertices(data, packing.position);
  Flags kind;
  Reals rotation, stress, strain;
  for (const int body : packing.body) {
    const auto b = static_cast<std::size_t>(body);
    const bool is_rubber = b < state.now.n_rubber();
    kind.push_back(is_rubber ? k_rubber : k_gravel);
    rotation.push_back(static_cast<float>(norm(state.rotation[b]) * k_to_deg));
    stress.push_back(static_cast<float>(state.loads.mean_stress[b] * k_to_kPa));
    strain.push_back(is_rubber ? static_cast<float>(state.bond_strain[b]) : k_no_number);
  }
  data.point_data = {{"radius_mm", scaled(packing.radius, k_to_mm)},
                     {"kind", std::move(kind)},
                     {"body", Wholes(packing.body.begin(), packing.body.end())},
                     {"displacement_mm", scaled(state.ball_displacement, k_to_mm), 3},
                     {"velocity_mm_per_s", scaled(state.now.ball_velocity, k_to_mm), 3},
                     {"rotation_deg", std::move(rotation)},
                     {"mean_stress_kPa", std::move(stress)},
                     {"bond_strain", std::move(strain)}};
  return data;
}

VtkPolyData clumps_of(const ShownState& state) {
  const StoredState& now = state.now;
  const std::size_t begin = now.n_rubber(), count = now.clump_mass.size();
  VtkPolyData data;
  add_vertices(data, std::span(now.micro.network.body_position).subspan(begin, count));
  add_body_arrays(state, begin, count, data);
  Reals orientation;
  for (const Quaternion& q : std::span(now.orientation).subspan(begin, count)) {
    for (const double part : {q.w, q.x, q.y, q.z}) orientation.push_back(static_cast<float>(part));
  }
  data.point_data.push_back({"orientation", std::move(orientation), 4});
  data.point_data.push_back({"mass_g", scaled(now.clump_mass, 1e3)});
  data.point_data.push_back({"sieve_size_mm", scaled(now.clump_size, k_to_mm)});
  data.point_data.push_back({"shape", Wholes(now.clump_shape.begin(), now.clump_shape.end())});
  data.point_data.push_back({"velocity_mm_per_s", scaled(now.clump_velocity, k_to_mm), 3});
  data.point_data.push_back({"spin_rad_per_s", scaled(now.clump_spin, 1.0), 3});
  return data;
}

VtkPolyData rubber_grains_of(const ShownState& state) {
  const StoredState& now = state.now;
  const std::size_t count = now.n_rubber();
  VtkPolyData data;
  add_vertices(data, std::span(now.micro.network.body_position).first(count));
  add_body_arrays(state, 0, count, data);
  Wholes broken(count, 0);
  for (std::size_t b = 0; b < now.micro.rubber.is_broken.size(); ++b) {
    broken[b / k_grain_bonds] += now.micro.rubber.is_broken[b] != 0 ? 1 : 0;
  }
  data.point_data.push_back({"bond_strain", scaled(state.bond_strain)});
  data.point_data.push_back({"broken_bonds", std::move(broken)});
  return data;
}

VtkPolyData contacts_of(const ShownState& state) {
  const ContactNetwork& network = state.now.micro.network;
  VtkPolyData data;
  data.kind = VtkCells::lines;
  // No point is shared: what belongs to a contact can then stand at its ends too, where the tubes of ParaView look for it.
  const auto add_line = [&](const Vec3& from, const Vec3& to) {
    const std::int32_t begin = data.add_point(from);
    data.add_cell({begin, data.add_point(to)});
  };
  ContactArrays arrays;
  const std::vector<unsigned char> is_strong = strong_contacts(network.contacts, StrongMeasure::normal_force);
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const Contact& c = network.contacts[k];
    add_line(network.body_position[static_cast<std::size_t>(c.body_i)],
             network.body_position[static_cast<std::size_t>(c.body_j)]);
    arrays.kind.push_back(static_cast<std::int32_t>(c.kind));
    arrays.body_i.push_back(c.body_i);
    arrays.body_j.push_back(c.body_j);
    arrays.wall.push_back(-1);
    arrays.take(c, is_strong[k] != 0);
  }
  const double threshold = strong_network(network.contacts, StrongMeasure::normal_force).threshold;
  for (const WallContact& c : network.wall_contacts) {
    add_line(network.body_position[static_cast<std::size_t>(c.body)], c.point);
    arrays.kind.push_back(k_wall_contact);
    arrays.body_i.push_back(c.body);
    arrays.body_j.push_back(-1);
    arrays.wall.push_back(c.wall);
    arrays.take(c, c.normal_force > threshold);
  }
  add_contact_arrays(std::move(arrays), data);
  return data;
}

VtkPolyData bonds_of(const ShownState& state) {
  const RubberState& rubber = state.now.micro.rubber;
  VtkPolyData data;
  data.kind = VtkCells::lines;
  for (const Vec3& place : rubber.ball_position) data.add_point(place);
  Wholes grain;
  Reals strain;
  for (std::size_t b = 0; b < rubber.bond_length.size(); ++b) {
    const std::size_t g = b / k_grain_bonds;
    const SlotPair slots = k_bonds_of_grain[b % k_grain_bonds];
    const auto first = static_cast<std::int32_t>(g * k_grain_balls);
    data.add_cell({first + slots.i, first + slots.j});
    grain.push_back(static_cast<std::int32_t>(g));
    strain.push_back(static_cast<float>((rubber.rest_length[g] - rubber.bond_length[b]) / rubber.rest_length[g]));
  }
  data.cell_data = {{"strain", std::move(strain)},
                    {"normal_force_N", scaled(rubber.bond_normal_force)},
                    {"shear_force_N", scaled(rubber.bond_shear_force)},
                    {"moment_mN_m", scaled(rubber.bond_moment, 1e3)},
                    {"broken", Flags(rubber.is_broken.begin(), rubber.is_broken.end())},
                    {"body", std::move(grain)}};
  return data;
}

VtkPolyData walls_of(const ShownState& state) {
  VtkPolyData data;
  data.kind = VtkCells::polygons;
  VtkArray::Texts name;
  Wholes number, carrier;
  Reals force, velocity, friction;
  for (const StoredWall& wall : state.now.walls) {
    const Vec3 along = wall.u * wall.length_u, across = wall.v * wall.length_v;
    const std::int32_t first = data.add_point(wall.corner);
    for (const Vec3& corner : {wall.corner + along, wall.corner + along + across, wall.corner + across}) {
      data.add_point(corner);
    }
    data.add_cell({first, first + 1, first + 2, first + 3});
    name.push_back(wall.name);
    number.push_back(static_cast<std::int32_t>(number.size()));
    carrier.push_back(wall.carrier);
    append_scaled(force, wall.force);
    append_scaled(velocity, wall.velocity, k_to_mm);
    friction.push_back(static_cast<float>(wall.friction));
  }
  data.cell_data = {{"name", std::move(name)},         {"wall", std::move(number)},
                    {"force_N", std::move(force), 3},  {"velocity_mm_per_s", std::move(velocity), 3},
                    {"friction", std::move(friction)}, {"carrier", std::move(carrier)}};
  return data;
}

}  // namespace dem
