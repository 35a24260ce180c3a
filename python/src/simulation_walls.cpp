// SPDX-License-Identifier: BSD-3-Clause
// Walls of a test of one's own: what they feel and how they move.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "simulation_binding.hpp"

namespace dem {

namespace py = pybind11;

namespace {

Wall& wall_of(OwnTest& t, int wall) { return t.state().walls.at(static_cast<std::size_t>(wall)); }

void set_friction(OwnTest& t, const std::array<double, 3>& between, const std::array<double, 2>& walls) {
  FrictionTable table;
  table.between_grains[k_gravel][k_gravel] = between[0];
  table.between_grains[k_gravel][k_rubber] = table.between_grains[k_rubber][k_gravel] = between[1];
  table.between_grains[k_rubber][k_rubber] = between[2];
  table.against_walls = {walls[0], walls[1]};
  t.state().set_friction(table);
}

}  // namespace

void bind_walls(OwnClass& c) {
  const auto get = [](auto take) {
    return [take](OwnTest& t, int wall) {
      const InUse claimed(t);
      return take(t.state(), static_cast<std::size_t>(wall), wall_of(t, wall));
    };
  };
  c.def("wall_corner", get([](Simulation&, std::size_t, const Wall& w) { return triple(w.corner); }))
      .def("wall_normal", get([](Simulation&, std::size_t, const Wall& w) { return triple(w.normal); }))
      .def("wall_sides", get([](Simulation&, std::size_t, const Wall& w) {
             return std::pair(triple(w.u * w.length_u), triple(w.v * w.length_v));
           }))
      .def("wall_velocity", get([](Simulation&, std::size_t, const Wall& w) { return triple(w.velocity); }))
      .def("wall_friction", get([](Simulation&, std::size_t, const Wall& w) { return w.friction; }))
      .def("wall_force", get([](Simulation& s, std::size_t k, const Wall&) { return triple(s.reactions[k].force); }))
      .def("wall_stiffness", get([](Simulation& s, std::size_t k, const Wall&) { return s.reactions[k].stiffness; }))
      .def("wall_n_contacts", get([](Simulation& s, std::size_t k, const Wall&) { return s.reactions[k].contacts; }))
      .def("set_wall_velocity",
           [](OwnTest& t, int wall, const Triple& v) {
             const InUse claimed(t);
             wall_of(t, wall).velocity = vector(v);
           })
      .def("set_wall_friction",
           [](OwnTest& t, int wall, double friction) {
             const InUse claimed(t);
             wall_of(t, wall).friction = friction;
             t.state().invalidate_candidates();
           })
      .def("remove_wall",
           [](OwnTest& t, int wall) {
             const InUse claimed(t);
             wall_of(t, wall).is_solid = false;
             t.state().invalidate_candidates();
           })
      .def("set_plate",
           [](OwnTest& t, int wall, double force, double stress, const std::array<int, 4>& sides, double gain,
              double cap) {
             const InUse claimed(t);
             std::erase_if(t.plates, [&](const LoadedPlate& p) { return p.servo.wall == wall; });
             std::erase_if(t.motions, [&](const WallMotion& p) { return p.wall == wall; });
             t.plates.push_back({{wall, force, gain, cap}, stress, sides});
           })
      .def("set_motion",
           [](OwnTest& t, int wall, const Numbers& times, const Numbers& velocities) {
             const InUse claimed(t);
             const auto rows = vectors_in(velocities, "velocities");
             const auto at = numbers_in(times, "times", rows.size());
             if (at.empty() || std::adjacent_find(at.begin(), at.end(), std::greater_equal<>()) != at.end()) {
               throw std::invalid_argument("times must ascend, and there must be at least one");
             }
             std::erase_if(t.plates, [&](const LoadedPlate& p) { return p.servo.wall == wall; });
             std::erase_if(t.motions, [&](const WallMotion& p) { return p.wall == wall; });
             t.motions.push_back({wall, {at.begin(), at.end()}, {rows.begin(), rows.end()}});
           })
      .def("free_wall",
           [](OwnTest& t, int wall) {
             const InUse claimed(t);
             std::erase_if(t.plates, [&](const LoadedPlate& p) { return p.servo.wall == wall; });
             std::erase_if(t.motions, [&](const WallMotion& p) { return p.wall == wall; });
           })
      .def("set_friction",
           [](OwnTest& t, const std::array<double, 3>& between, const std::array<double, 2>& walls) {
             const InUse claimed(t);
             set_friction(t, between, walls);
           })
      .def("friction", [](OwnTest& t) {
        const InUse claimed(t);
        const FrictionTable& f = t.state().friction;
        return std::vector<double>{f.between_grains[0][0], f.between_grains[0][1], f.between_grains[1][1],
                                   f.against_walls[0], f.against_walls[1]};
      });
}

}  // namespace dem
