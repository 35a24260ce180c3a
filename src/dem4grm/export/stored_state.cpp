// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/export/stored_state.hpp"

#include <fmt/format.h>

#include <array>
#include <variant>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/grains/rubber_size.hpp"
#include "dem4grm/micro/height_profile.hpp"
#include "dem4grm/results/micro_state_file.hpp"
#include "dem4grm/results/stored_grains.hpp"

namespace dem {
namespace {

std::vector<int> integers_in(const hdf5::Handle& group, const char* name) {
  const std::vector<std::int64_t> values = hdf5::read_whole_numbers(group, name);
  return {values.begin(), values.end()};
}

void check_rows(std::size_t rows, std::size_t wanted, const char* what) {
  if (rows != wanted) throw IoError(fmt::format("{} has {} rows where {} belong", what, rows, wanted));
}

void read_clumps(const hdf5::Handle& frame, StoredState& out) {
  const hdf5::Handle group = hdf5::open_group(frame, "clumps");
  const std::vector<double> q = hdf5::read_dataset(group, "orientation");
  for (std::size_t k = 0; k + 3 < q.size(); k += 4) out.orientation.push_back({q[k], q[k + 1], q[k + 2], q[k + 3]});
  out.clump_velocity = hdf5::read_vectors(group, "velocity");
  out.clump_spin = hdf5::read_vectors(group, "spin");
  out.clump_mass = hdf5::read_dataset(group, "mass");
  out.clump_size = hdf5::read_dataset(group, "sieve_size");
  out.clump_shape = integers_in(group, "shape");
  const std::size_t n = out.clump_mass.size();
  for (const std::size_t rows : {q.size() / 4, out.clump_velocity.size(), out.clump_spin.size(), out.clump_size.size(),
                                 out.clump_shape.size()}) {
    check_rows(rows, n, "a dataset of clumps");
  }
}

void read_walls(const hdf5::Handle& frame, StoredState& out) {
  const hdf5::Handle group = hdf5::open_group(frame, "walls");
  const std::vector<std::string> name = hdf5::read_texts(group, "name");
  const std::vector<Vec3> corner = hdf5::read_vectors(group, "corner"), u = hdf5::read_vectors(group, "u"),
                          v = hdf5::read_vectors(group, "v"), force = hdf5::read_vectors(group, "force"),
                          velocity = hdf5::read_vectors(group, "velocity");
  const std::vector<double> lengths = hdf5::read_dataset(group, "lengths"),
                            friction = hdf5::read_dataset(group, "friction");
  const std::vector<int> carrier = integers_in(group, "carrier");
  for (const std::size_t rows : {corner.size(), u.size(), v.size(), force.size(), velocity.size(), lengths.size() / 2,
                                 friction.size(), carrier.size()}) {
    check_rows(rows, name.size(), "a dataset of walls");
  }
  for (std::size_t w = 0; w < name.size(); ++w) {
    out.walls.push_back({name[w], corner[w], u[w], v[w], lengths[2 * w], lengths[2 * w + 1], force[w], velocity[w],
                         friction[w], carrier[w]});
  }
}

/// Volume of each body that is solid, m3.
std::vector<double> solid_volumes(const StoredState& state, const GrainDensities& densities) {
  std::vector<double> volume;
  for (std::size_t g = 0; g < state.n_rubber(); ++g) {
    volume.push_back(
        rubber_solid_volume(state.packing.radius[g * k_grain_balls], densities.rubber_balls, densities.rubber_solid));
  }
  for (const double mass : state.clump_mass) volume.push_back(mass / densities.gravel);
  return volume;
}

}  // namespace

StoredState read_stored_state(const hdf5::Handle& file, const std::string& name) {
  const hdf5::Handle frame = hdf5::open_group(hdf5::open_group(file, "frames"), name);
  StoredState out;
  out.name = name;
  out.displacement = hdf5::read_number_attribute(frame, "displacement");
  out.packing = read_packing(frame);
  out.ball_velocity = hdf5::read_vectors(hdf5::open_group(frame, "balls"), "velocity");
  check_rows(out.ball_velocity.size(), out.packing.position.size(), "balls/velocity");
  out.micro = read_micro_state(frame);
  const RubberState& rubber = out.micro.rubber;
  for (std::size_t g = 0; g < rubber.n_grains(); ++g) {
    out.orientation.push_back(grain_orientation(
        std::span(rubber.ball_position).subspan(g * k_grain_balls, k_grain_balls), rubber.rest_length[g]));
  }
  read_clumps(frame, out);
  check_rows(out.orientation.size(), out.micro.network.body_position.size(), "the list of orientations");
  read_walls(frame, out);
  return out;
}

GrainDensities read_densities(const hdf5::Handle& file) {
  const TestCase test =
      parse_case(hdf5::read_text(hdf5::open_group(file, "meta"), "resolved_toml"), "resolved.toml").test;
  if (const auto* shear = std::get_if<DirectShearCase>(&test)) {
    return {shear->gravel.density, shear->rubber.density, shear->rubber_solid_density};
  }
  return {DirectShearCase{}.gravel.density, std::get<GrainCompressionCase>(test).rubber.density,
          DirectShearCase{}.rubber_solid_density};
}

BodyLoads body_loads(const StoredState& state, const GrainDensities& densities) {
  const ContactNetwork& network = state.micro.network;
  BodyLoads out{std::vector<int>(state.n_bodies(), 0), std::vector<double>(state.n_bodies(), 0.0)};
  const auto take = [&](int body, const Vec3& force, const Vec3& point) {
    const auto b = static_cast<std::size_t>(body);
    ++out.contacts[b];
    out.mean_stress[b] -= dot(force, point - network.body_position[b]);
  };
  for (const Contact& c : network.contacts) {
    const Vec3 on_second = force_on_second(c);
    take(c.body_i, on_second * -1.0, c.point);
    take(c.body_j, on_second, c.point);
  }
  for (const WallContact& c : network.wall_contacts) take(c.body, force_on_second(c) * -1.0, c.point);
  const std::vector<double> volume = solid_volumes(state, densities);
  for (std::size_t b = 0; b < volume.size(); ++b) out.mean_stress[b] /= 3.0 * volume[b];
  return out;
}

}  // namespace dem
