// SPDX-License-Identifier: BSD-3-Clause
// OwnTest as Python sees it; dem4grm/simulation.py makes the class Simulation of it.
#include <omp.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "beside.hpp"
#include "dem4grm/engine/observe.hpp"
#include "micro_options.hpp"
#include "module.hpp"
#include "simulation_binding.hpp"

namespace dem {

namespace py = pybind11;

namespace {

/// In the calling thread, with the lock released; Ctrl-C ends it after a whole step.
void run_here(OwnTest& t, std::int64_t steps) {
  using Clock = std::chrono::steady_clock;
  constexpr std::int64_t k_at_least = 16;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto restore = [before](int*) { omp_set_num_threads(before); };
  int nothing = 0;
  const std::unique_ptr<int, decltype(restore)> restored(&nothing, restore);
  volatile std::sig_atomic_t never = 0;
  while (steps > 0) {
    {
      const py::gil_scoped_release unlocked;
      const auto end = Clock::now() + k_look_interval;
      do {
        const std::int64_t now = std::min(steps, k_at_least);
        t.run(now, never);
        steps -= now;
      } while (steps > 0 && Clock::now() < end);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void run_in_threads(OwnTest& t, std::int64_t steps) {
  volatile std::sig_atomic_t stop = 0;
  run_beside<int>(
      [&](Letterbox<int>&) {
        omp_set_num_threads(t.threads);
        t.run(steps, stop);
      },
      [](const int&) {}, [] {}, [&] { stop = 1; });
}

void run_steps(OwnTest& t, std::int64_t steps) {
  const InUse claimed(t);
  if (t.threads == 1) {
    run_here(t, steps);
  } else {
    run_in_threads(t, steps);
  }
}

py::dict energy(OwnTest& t) {
  const InUse claimed(t);
  const Simulation& s = t.state();
  const EnergyReport e = s.energy();
  py::dict out;
  out["kinetic"] = e.kinetic;
  out["contact_strain"] = e.contact_strain;
  out["bond_strain"] = e.bond_strain;
  out["gravity"] = gravity_energy(s);
  out["boundary_work"] = e.boundary_work;
  out["slip"] = e.slip;
  out["dashpot"] = e.dashpot;
  out["local_damping"] = e.local_damping;
  out["breakage"] = e.breakage;
  return out;
}

/// One value of each member of a list.
template <class Thing, class Take>
auto column(const std::vector<Thing>& things, const Take& take) {
  std::vector<std::decay_t<decltype(take(things.front()))>> values;
  values.reserve(things.size());
  for (const Thing& thing : things) values.push_back(take(thing));
  return array_of(std::move(values));
}

py::dict contacts(OwnTest& t) {
  const InUse claimed(t);
  const ContactNetwork network = contact_network_of(t.state());
  const std::vector<Contact>& list = network.contacts;
  using Flag = unsigned char;
  py::dict out;
  out["ball_i"] = column(list, [](const Contact& c) { return c.ball_i; });
  out["ball_j"] = column(list, [](const Contact& c) { return c.ball_j; });
  out["body_i"] = column(list, [](const Contact& c) { return c.body_i; });
  out["body_j"] = column(list, [](const Contact& c) { return c.body_j; });
  out["kind"] = column(list, [](const Contact& c) { return static_cast<int>(c.kind); });
  out["point"] = column(list, [](const Contact& c) { return c.point; });
  out["normal"] = column(list, [](const Contact& c) { return c.normal; });
  out["normal_force"] = column(list, [](const Contact& c) { return c.normal_force; });
  out["shear_force"] = column(list, [](const Contact& c) { return c.shear_force; });
  out["branch"] = column(list, [](const Contact& c) { return c.branch; });
  out["is_sliding"] = column(list, [](const Contact& c) { return static_cast<Flag>(c.is_sliding); });
  return out;
}

py::dict wall_contacts(OwnTest& t) {
  const InUse claimed(t);
  const ContactNetwork network = contact_network_of(t.state());
  const std::vector<WallContact>& list = network.wall_contacts;
  py::dict out;
  out["ball"] = column(list, [](const WallContact& c) { return c.ball; });
  out["body"] = column(list, [](const WallContact& c) { return c.body; });
  out["wall"] = column(list, [](const WallContact& c) { return c.wall; });
  out["point"] = column(list, [](const WallContact& c) { return c.point; });
  out["normal"] = column(list, [](const WallContact& c) { return c.normal; });
  out["normal_force"] = column(list, [](const WallContact& c) { return c.normal_force; });
  out["shear_force"] = column(list, [](const WallContact& c) { return c.shear_force; });
  return out;
}

/// [n_clumps, 3] of a vector in every clump, in the memory of the simulation.
py::array clump_view(const py::object& self, Vec3 Clump::*member) {
  auto& t = self.cast<OwnTest&>();
  const InUse claimed(t);
  const std::vector<Clump>& clumps = t.state().clumps.clumps;
  if (clumps.empty()) return array_of(std::vector<Vec3>{});
  return view_of(&(clumps.front().*member).x, {static_cast<py::ssize_t>(clumps.size()), 3},
                 {sizeof(Clump), sizeof(double)}, self);
}

/// [n_pebbles, 3], or [n_pebbles] of radii with width 1, from a number of the record on.
py::array pebble_view(const py::object& self, std::size_t first, py::ssize_t width) {
  auto& t = self.cast<OwnTest&>();
  const InUse claimed(t);
  const BallStore& balls = t.state().balls;
  if (balls.n_pebbles == 0)
    return array_of(std::vector<double>{},
                    width == 1 ? std::vector<py::ssize_t>{0} : std::vector<py::ssize_t>{0, width});
  const double* at = balls.state.data() + balls.first_pebble_index() + first;
  const py::ssize_t n = balls.n_pebbles, record = k_pebble_record * sizeof(double), number = sizeof(double);
  return width == 1 ? view_of(at, {n}, {record}, self) : view_of(at, {n, width}, {record, number}, self);
}

/// [n_grains, 35, 3], a copy: in the simulation the balls of several grains lie side by side.
py::array rubber_balls(OwnTest& t, Vec3 (BallStore::*read)(int) const) {
  const InUse claimed(t);
  const BallStore& balls = t.state().balls;
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(balls.n_rubber_balls()) * 3);
  for (int id = 0; id < balls.n_rubber_balls(); ++id) {
    const Vec3 v = (balls.*read)(balls.index_of_id(id));
    values.insert(values.end(), {v.x, v.y, v.z});
  }
  return array_of(std::move(values), {balls.n_grains, k_grain_balls, 3});
}

}  // namespace

void bind_state(OwnClass& c) {
  c.def_property_readonly("is_built", &OwnTest::is_built)
      .def("build",
           [](OwnTest& t) {
             const InUse claimed(t);
             t.build();
           })
      .def("run", &run_steps)
      .def("fix_time_step",
           [](OwnTest& t, double dt) {
             const InUse claimed(t);
             t.fix_time_step(dt);
           })
      .def("choose_time_step",
           [](OwnTest& t, double stress) {
             const InUse claimed(t);
             return t.choose_time_step(stress);
           })
      .def_property(
          "threads", [](const OwnTest& t) { return t.threads; },
          [](OwnTest& t, int threads) {
            if (threads < 1) throw std::invalid_argument("a simulation has at least one thread");
            check_threads(threads);
            t.threads = threads;
          })
      .def_property_readonly("time_step",
                             [](OwnTest& t) {
                               const InUse claimed(t);
                               return t.state().dt;
                             })
      .def_property_readonly("time",
                             [](OwnTest& t) {
                               const InUse claimed(t);
                               return t.state().time;
                             })
      .def_property_readonly("steps",
                             [](OwnTest& t) {
                               const InUse claimed(t);
                               return t.state().steps;
                             })
      .def_property_readonly("state_hash",
                             [](OwnTest& t) {
                               const InUse claimed(t);
                               return t.state().state_hash();
                             })
      .def_property_readonly("unbalanced_ratio",
                             [](OwnTest& t) {
                               const InUse claimed(t);
                               return balance(t.state()).ratio();
                             })
      .def("energy", &energy)
      .def("contacts", &contacts)
      .def("wall_contacts", &wall_contacts)
      .def("clump_positions", [](const py::object& self) { return clump_view(self, &Clump::position); })
      .def("clump_velocities", [](const py::object& self) { return clump_view(self, &Clump::velocity); })
      .def("clump_spins", [](const py::object& self) { return clump_view(self, &Clump::spin); })
      .def("clump_masses",
           [](OwnTest& t) {
             const InUse claimed(t);
             return column(t.state().clumps.clumps, [](const Clump& b) { return b.mass; });
           })
      .def("clump_volumes",
           [](OwnTest& t) {
             const InUse claimed(t);
             return column(t.state().clumps.clumps, [](const Clump& b) { return b.volume; });
           })
      .def("pebble_positions", [](const py::object& self) { return pebble_view(self, 0, 3); })
      .def("pebble_velocities", [](const py::object& self) { return pebble_view(self, 3, 3); })
      .def("pebble_radii", [](const py::object& self) { return pebble_view(self, k_pebble_radius_at, 1); })
      .def("pebble_clumps",
           [](OwnTest& t) {
             const InUse claimed(t);
             return array_of(std::vector<int>(t.state().clumps.clump_of_pebble));
           })
      .def("rubber_positions", [](OwnTest& t) { return rubber_balls(t, &BallStore::position); })
      .def("rubber_velocities", [](OwnTest& t) { return rubber_balls(t, &BallStore::velocity); })
      .def("rubber_ball_mass",
           [](OwnTest& t) {
             const InUse claimed(t);
             return t.state().rubber().ball_mass;
           })
      .def("stop_grains",
           [](OwnTest& t) {
             const InUse claimed(t);
             t.state().reset_velocities();
           })
      .def("analyse",
           [](OwnTest& t, int bins, const std::string& level, const std::string& mean, const std::string& strong,
              const std::string& projection, int resamples, std::uint64_t seed) {
             const MicroOptions options = options_from({bins, level, mean, strong, projection, resamples, seed});
             const InUse claimed(t);
             return analysed({"live", 0.0, t.state().state_hash(), micro_state_of(t.state())}, options);
           })
      .def("save",
           [](OwnTest& t, const std::filesystem::path& path) {
             const InUse claimed(t);
             t.save(path);
           })
      .def_static("load", &OwnTest::load);
}

void bind_simulation(py::module_& m) {
  bind_materials(m);
  OwnClass own(m, "OwnTest");
  own.def(py::init<>());
  bind_building(own);
  bind_state(own);
  bind_walls(own);
}

}  // namespace dem
