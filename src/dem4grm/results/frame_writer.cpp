// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/frame_writer.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/micro/contact_network.hpp"
#include "dem4grm/micro/rubber_strain.hpp"

namespace dem {
namespace {

using hdf5::Handle;

void append(std::vector<double>& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }

void write_balls(const Handle& frame, const Simulation& s) {
  const auto n = static_cast<std::size_t>(s.balls.n_balls());
  std::vector<double> position, velocity, radius;
  std::vector<std::int32_t> body;
  std::vector<std::uint8_t> material;
  position.reserve(3 * n);
  velocity.reserve(3 * n);
  for (int id = 0; id < s.balls.n_balls(); ++id) {
    const int index = s.balls.index_of_id(id);
    append(position, s.balls.position(index));
    append(velocity, s.balls.velocity(index));
    radius.push_back(s.balls.radius_of_id(id));
    body.push_back(s.body_of_ball(id));
    material.push_back(s.material_of_ball(id));
  }
  const Handle group = hdf5::create_group(frame, "balls");
  hdf5::write_dataset(group, {"position", "m", "centre"}, position, 3);
  hdf5::write_dataset(group, {"velocity", "m/s", "half a time step before the position"}, velocity, 3);
  hdf5::write_dataset(group, {"radius", "m", "radius"}, radius);
  hdf5::write_dataset(group, {"body", "1", "id of the body: rubber grains first, then clumps"}, body);
  hdf5::write_dataset(group, {"material", "1", "0 gravel, 1 rubber"}, material);
}

void write_clumps(const Handle& frame, const Simulation& s) {
  std::vector<double> position, orientation, velocity, spin, mass, size;
  std::vector<std::int32_t> shape;
  for (const Clump& c : s.clumps.clumps) {
    append(position, c.position);
    const Quaternion& q = c.orientation;
    orientation.insert(orientation.end(), {q.w, q.x, q.y, q.z});
    append(velocity, c.velocity);
    append(spin, c.spin);
    mass.push_back(c.mass);
    size.push_back(c.size);
    shape.push_back(c.shape);
  }
  std::vector<std::string> names;
  for (const ClumpTemplate& t : s.scene.shapes) names.push_back(t.name);
  const Handle group = hdf5::create_group(frame, "clumps");
  hdf5::write_dataset(group, {"position", "m", "centroid"}, position, 3);
  hdf5::write_dataset(group, {"orientation", "1", "quaternion w, x, y, z from principal axes to space"}, orientation,
                      4);
  hdf5::write_dataset(group, {"velocity", "m/s", "half a time step before the position"}, velocity, 3);
  hdf5::write_dataset(group, {"spin", "rad/s", "angular velocity in space axes"}, spin, 3);
  hdf5::write_dataset(group, {"mass", "kg", "mass"}, mass);
  hdf5::write_dataset(group, {"sieve_size", "m", "smallest square opening that the grain passes"}, size);
  hdf5::write_dataset(group, {"shape", "1", "row of shape_names"}, shape);
  hdf5::write_dataset(group, {"shape_names", "1", "names of the clump shapes"}, names);
}

void write_rubber_grains(const Handle& frame, const Simulation& s) {
  std::vector<double> centre;
  for (int g = 0; g < s.balls.n_grains; ++g) append(centre, body_position(s, g));
  const Handle group = hdf5::create_group(frame, "rubber_grains");
  hdf5::write_dataset(group, {"centre", "m", "mean of the 35 ball centres"}, centre, 3);
}

struct ContactColumns {
  std::vector<std::int32_t> ball_i, ball_j, wall, body_i, body_j;
  std::vector<double> point, normal, normal_force, shear_force, friction;
  std::vector<std::uint8_t> is_sliding;
};

/// What contacts with balls and with walls have in common.
template <class AnyContact>
void take_contact(ContactColumns& columns, const AnyContact& c) {
  append(columns.point, c.point);
  append(columns.normal, c.normal);
  columns.normal_force.push_back(c.normal_force);
  append(columns.shear_force, c.shear_force);
  columns.friction.push_back(c.friction);
  columns.is_sliding.push_back(c.is_sliding ? 1 : 0);
}

ContactColumns collect_contacts(const Simulation& s) {
  const ContactNetwork network = contact_network_of(s);
  ContactColumns columns;
  for (const Contact& c : network.contacts) {
    columns.ball_i.push_back(c.ball_i);
    columns.ball_j.push_back(c.ball_j);
    columns.wall.push_back(-1);
    columns.body_i.push_back(c.body_i);
    columns.body_j.push_back(c.body_j);
    take_contact(columns, c);
  }
  for (const WallContact& c : network.wall_contacts) {
    columns.ball_i.push_back(c.ball);
    columns.ball_j.push_back(-1);
    columns.wall.push_back(c.wall);
    columns.body_i.push_back(c.body);
    columns.body_j.push_back(-1);
    take_contact(columns, c);
  }
  return columns;
}

void write_contacts(const Handle& frame, const Simulation& s) {
  const ContactColumns c = collect_contacts(s);
  const Handle group = hdf5::create_group(frame, "contacts");
  hdf5::write_dataset(group, {"ball_i", "1", "id of the first ball"}, c.ball_i);
  hdf5::write_dataset(group, {"ball_j", "1", "id of the second ball, -1 for a wall"}, c.ball_j);
  hdf5::write_dataset(group, {"wall", "1", "row of walls, -1 between balls"}, c.wall);
  hdf5::write_dataset(group, {"body_i", "1", "id of the first body"}, c.body_i);
  hdf5::write_dataset(group, {"body_j", "1", "id of the second body, -1 for a wall"}, c.body_j);
  hdf5::write_dataset(group, {"point", "m", "contact point"}, c.point, 3);
  hdf5::write_dataset(group, {"normal", "1", "unit vector from i to j or to the wall"}, c.normal, 3);
  hdf5::write_dataset(group, {"normal_force", "N", "compression positive"}, c.normal_force);
  hdf5::write_dataset(group, {"shear_force", "N", "on i, perpendicular to the normal"}, c.shear_force, 3);
  hdf5::write_dataset(group, {"friction", "1", "friction coefficient of the contact"}, c.friction);
  hdf5::write_dataset(group, {"is_sliding", "1", "1 when the shear force is at its Coulomb limit"}, c.is_sliding);
}

void write_bonds(const Handle& frame, const Simulation& s) {
  const RubberState rubber = rubber_state_of(s);
  const Handle group = hdf5::create_group(frame, "bonds");
  hdf5::write_attribute(group, "bonds_per_grain", static_cast<std::int64_t>(k_grain_bonds));
  hdf5::write_dataset(group, {"rest_length", "m", "distance of bonded ball centres at rest, of each grain"},
                      rubber.rest_length);
  hdf5::write_dataset(group, {"length", "m", "distance of the two ball centres"}, rubber.bond_length);
  hdf5::write_dataset(group, {"normal_force", "N", "without the dashpot; compression positive"},
                      rubber.bond_normal_force);
  hdf5::write_dataset(group, {"shear_force", "N", "magnitude"}, rubber.bond_shear_force);
  hdf5::write_dataset(group, {"moment", "N m", "magnitude, bending and twisting"}, rubber.bond_moment);
  hdf5::write_dataset(group, {"is_broken", "1", "1 when broken"}, rubber.is_broken);
}

void write_walls(const Handle& frame, const Simulation& s) {
  std::vector<std::string> names;
  std::vector<double> corner, u, v, lengths, force, velocity, friction;
  std::vector<std::int32_t> carrier;
  for (std::size_t w = 0; w < s.walls.size(); ++w) {
    const Wall& wall = s.walls[w];
    names.push_back(wall.name);
    append(corner, wall.corner);
    append(u, wall.u);
    append(v, wall.v);
    lengths.insert(lengths.end(), {wall.length_u, wall.length_v});
    append(force, s.reactions[w].force);
    append(velocity, wall.velocity);
    friction.push_back(wall.friction);
    carrier.push_back(wall.carrier);
  }
  const Handle group = hdf5::create_group(frame, "walls");
  hdf5::write_dataset(group, {"name", "1", "name"}, names);
  hdf5::write_dataset(group, {"corner", "m", "corner of the rectangle"}, corner, 3);
  hdf5::write_dataset(group, {"u", "1", "unit vector along the first side"}, u, 3);
  hdf5::write_dataset(group, {"v", "1", "unit vector along the second side; grains are where u x v points"}, v, 3);
  hdf5::write_dataset(group, {"lengths", "m", "of the sides along u and v"}, lengths, 2);
  hdf5::write_dataset(group, {"force", "N", "of the grains on the wall"}, force, 3);
  hdf5::write_dataset(group, {"velocity", "m/s", "velocity"}, velocity, 3);
  hdf5::write_dataset(group, {"friction", "1", "friction coefficient"}, friction);
  hdf5::write_dataset(group,
                      {"carrier", "1", "row of the plate that a rib belongs to, whose force holds that of the rib; -1"},
                      carrier);
}

}  // namespace

void write_frame(const Handle& parent, const std::string& name, const Simulation& state, const FrameInfo& info) {
  const Handle frame = hdf5::create_group(parent, name);
  hdf5::write_attribute(frame, "displacement", info.displacement);
  hdf5::write_attribute(frame, "displacement_unit", std::string("m"));
  hdf5::write_attribute(frame, "state_hash", info.state_hash);
  hdf5::write_attribute(frame, "time", state.time);
  hdf5::write_attribute(frame, "time_unit", std::string("s"));
  hdf5::write_attribute(frame, "time_step", state.dt);
  hdf5::write_attribute(frame, "step", state.steps);
  write_balls(frame, state);
  write_clumps(frame, state);
  write_rubber_grains(frame, state);
  write_contacts(frame, state);
  write_bonds(frame, state);
  write_walls(frame, state);
}

}  // namespace dem
