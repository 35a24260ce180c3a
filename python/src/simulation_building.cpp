// SPDX-License-Identifier: BSD-3-Clause
// Materials, grains and walls of a test of one's own.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "dem4grm/verify/scenes.hpp"
#include "simulation_binding.hpp"

namespace dem {

namespace py = pybind11;

namespace {

Material material(const std::string& name) {
  if (name == "gravel") return k_gravel;
  if (name == "rubber") return k_rubber;
  throw std::invalid_argument("a grain is of 'gravel' or of 'rubber', not of '" + name + "'");
}

/// A unit quaternion (w, x, y, z) from four numbers of any length but zero.
Quaternion orientation(const std::array<double, 4>& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0.0)) throw std::invalid_argument("an orientation is a quaternion (w, x, y, z) that is not zero");
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

int add_shape(OwnTest& t, const std::string& name, const Numbers& pebbles) {
  if (pebbles.ndim() != 2 || pebbles.shape(1) != 4) {
    throw std::invalid_argument("pebbles must have the shape [n, 4]: x, y, z, radius");
  }
  std::vector<Pebble> list;
  const double* row = pebbles.data();
  for (py::ssize_t k = 0; k < pebbles.shape(0); ++k, row += 4) list.push_back({{row[0], row[1], row[2]}, row[3]});
  t.scene.shapes.push_back(make_clump_template(name, std::move(list)));
  return static_cast<int>(t.scene.shapes.size()) - 1;
}

int shape_named(OwnTest& t, const std::string& name) {
  const auto& shapes = t.scene.shapes;
  const auto known = std::find_if(shapes.begin(), shapes.end(), [&](const ClumpTemplate& s) { return s.name == name; });
  if (known != shapes.end()) return static_cast<int>(known - shapes.begin());
  const ClumpTemplate* standard = find_clump_template(name);
  if (standard == nullptr) throw std::invalid_argument("no clump shape has the name '" + name + "'");
  t.scene.shapes.push_back(*standard);
  return static_cast<int>(shapes.size()) - 1;
}

int add_clump(OwnTest& t, const std::string& shape, const Triple& position, double size,
              const std::array<double, 4>& turn, const std::string& of) {
  if (!(size > 0.0)) throw std::invalid_argument("a clump needs a positive sieve size");
  const Material kind = material(of);
  t.scene.clumps.push_back({shape_named(t, shape), size, {vector(position), orientation(turn)}, kind});
  return static_cast<int>(t.scene.clumps.size()) - 1;
}

int add_ball(OwnTest& t, const Triple& position, double radius, const std::string& of) {
  if (!(radius > 0.0)) throw std::invalid_argument("a ball needs a positive radius");
  return static_cast<int>(verify::add_sphere(t.scene, vector(position), radius, material(of)));
}

int add_rubber_grain(OwnTest& t, const Triple& position, const std::array<double, 4>& turn) {
  t.scene.grains.push_back({vector(position), orientation(turn)});
  return static_cast<int>(t.scene.grains.size()) - 1;
}

int add_wall(OwnTest& t, const std::string& name, const Triple& corner, const Triple& u, const Triple& v,
             double friction) {
  Wall wall = make_wall(name, vector(corner), vector(u), vector(v));
  if (!(wall.length_u > 0.0) || !(wall.length_v > 0.0) || std::fabs(dot(wall.u, wall.v)) > 1e-9) {
    throw std::invalid_argument("the sides of a rectangle stand square to each other and have a length");
  }
  wall.friction = friction;
  t.scene.wall_list.push_back(std::move(wall));
  return static_cast<int>(t.scene.wall_list.size()) - 1;
}

}  // namespace

void bind_materials(py::module_& m) {
  py::class_<MaterialSettings>(m, "Material",
                               "Density (kg/m3), friction coefficient, shear modulus (Pa), Poisson's ratio.")
      .def(py::init([](double density, double friction, double shear_modulus, double poisson_ratio) {
             return MaterialSettings{density, friction, shear_modulus, poisson_ratio};
           }),
           py::arg("density"), py::arg("friction"), py::arg("shear_modulus"), py::arg("poisson_ratio"))
      .def_readwrite("density", &MaterialSettings::density)
      .def_readwrite("friction", &MaterialSettings::friction)
      .def_readwrite("shear_modulus", &MaterialSettings::shear_modulus)
      .def_readwrite("poisson_ratio", &MaterialSettings::poisson_ratio);
  py::class_<BondSettings>(m, "Bond", "The bonds inside of rubber grains; docs/theory/parallel-bond.md.")
      .def_readwrite("modulus", &BondSettings::modulus)
      .def_readwrite("stiffness_ratio", &BondSettings::stiffness_ratio)
      .def_readwrite("radius_multiplier", &BondSettings::radius_multiplier)
      .def_readwrite("moment_scale", &BondSettings::moment_scale)
      .def_readwrite("damping_ratio", &BondSettings::damping_ratio)
      .def_readwrite("tensile_strength", &BondSettings::tensile_strength)
      .def_readwrite("shear_strength", &BondSettings::shear_strength)
      .def_property(
          "breakable", [](const BondSettings& b) { return b.form == BondForm::incremental; },
          [](BondSettings& b, bool breaks) { b.form = breaks ? BondForm::incremental : BondForm::history_free; });
  py::class_<ContactSettings>(m, "ContactLaw", "Options of every contact outside of a grain; docs/theory/contact.md.")
      .def_readwrite("hz_mode", &ContactSettings::hz_mode)
      .def_readwrite("normal_damping_ratio", &ContactSettings::normal_damping_ratio)
      .def_readwrite("shear_damping_ratio", &ContactSettings::shear_damping_ratio)
      .def_readwrite("dashpot_mode", &ContactSettings::dashpot_mode);
}

void bind_building(OwnClass& c) {
  c.def("add_shape", &add_shape)
      .def("add_clump", &add_clump)
      .def("add_ball", &add_ball)
      .def("add_rubber_grain", &add_rubber_grain)
      .def("add_wall", &add_wall)
      .def("set_start",
           [](OwnTest& t, bool is_rubber, int number, const Triple& velocity, const Triple& spin) {
             t.starts.push_back({is_rubber, number, vector(velocity), vector(spin)});
           })
      .def_property(
          "gravel", [](OwnTest& t) { return &t.scene.gravel; },
          [](OwnTest& t, const MaterialSettings& m) { t.scene.gravel = m; },
          py::return_value_policy::reference_internal)
      .def_property(
          "rubber", [](OwnTest& t) { return &t.scene.rubber; },
          [](OwnTest& t, const MaterialSettings& m) { t.scene.rubber = m; },
          py::return_value_policy::reference_internal)
      .def_property(
          "wall_material", [](OwnTest& t) { return &t.scene.walls; },
          [](OwnTest& t, const MaterialSettings& m) { t.scene.walls = m; }, py::return_value_policy::reference_internal)
      .def_property_readonly(
          "bond", [](OwnTest& t) { return &t.scene.bond; }, py::return_value_policy::reference_internal)
      .def_property_readonly(
          "contact_law", [](OwnTest& t) { return &t.scene.contact; }, py::return_value_policy::reference_internal)
      .def_property(
          "gravity", [](const OwnTest& t) { return triple(t.scene.gravity); },
          [](OwnTest& t, const Triple& g) { t.scene.gravity = vector(g); })
      .def_property(
          "local_damping", [](const OwnTest& t) { return t.scene.integration.local_damping; },
          [](OwnTest& t, double alpha) { t.scene.integration.local_damping = alpha; })
      .def_property(
          "time_step_safety", [](const OwnTest& t) { return t.scene.integration.time_step_safety; },
          [](OwnTest& t, double share) { t.scene.integration.time_step_safety = share; })
      .def_property(
          "rubber_ball_radius", [](const OwnTest& t) { return t.scene.rubber_ball_radius; },
          [](OwnTest& t, double r) { t.scene.rubber_ball_radius = r; })
      .def_property_readonly("n_clumps", [](const OwnTest& t) { return t.scene.clumps.size(); })
      .def_property_readonly("n_rubber_grains", [](const OwnTest& t) { return t.scene.grains.size(); })
      .def_property_readonly("wall_names", [](const OwnTest& t) {
        std::vector<std::string> names;
        for (const Wall& w : t.scene.wall_list) names.push_back(w.name);
        return names;
      });
}

}  // namespace dem
