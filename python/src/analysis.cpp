// SPDX-License-Identifier: BSD-3-Clause
// Micro-mechanics of stored states and of networks that are given as arrays; sieve analyses.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/stress_tensor.hpp"
#include "dem4grm/results/micro_text.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/results/sealed_file.hpp"
#include "dem4grm/results/sieve_report.hpp"
#include "micro_options.hpp"
#include "module.hpp"

namespace dem {

namespace py = pybind11;

namespace {

/// True for the second of two words, false for the first.
bool is_second(const std::string& word, const char* name, const char* first, const char* second) {
  if (word != first && word != second) {
    throw std::invalid_argument(std::string(name) + " must be '" + first + "' or '" + second + "', not '" + word + "'");
  }
  return word == second;
}

/// A network as arrays; those that are not given are empty.
struct NetworkArrays {
  Numbers normal;        ///< [n, 3]
  Numbers normal_force;  ///< [n] N
  Numbers shear_force;   ///< [n, 3] N
  Numbers branch;        ///< [n, 3] m
  WholeNumbers kind;     ///< [n] 0 g-g, 1 g-r, 2 r-r
  WholeNumbers sliding;  ///< [n]
  WholeNumbers body;     ///< [n, 2]
  double volume = 0.0;   ///< m3
};

void set_bodies(const NetworkArrays& given, std::vector<Contact>& contacts, int n_bodies) {
  if (given.body.ndim() != 2 || given.body.shape(1) != 2 ||
      static_cast<std::size_t>(given.body.shape(0)) != contacts.size()) {
    throw std::invalid_argument("bodies must have the shape [n, 2]");
  }
  const int* body = given.body.data();
  for (Contact& c : contacts) {
    c.body_i = *body++;
    c.body_j = *body++;
    if (std::min(c.body_i, c.body_j) < 0 || std::max(c.body_i, c.body_j) >= n_bodies) {
      throw std::invalid_argument("bodies must be from 0 to the number of bodies less one");
    }
  }
}

/// Bodies of the materials that the kinds of their contacts tell: one in a contact g-r counts as gravel when any contact says
/// so. Coordination does not look at it, and the shares of rattlers are only given for all bodies together.
StoredMicroState network_from(const NetworkArrays& given, int n_bodies) {
  const std::span<const Vec3> normals = vectors_in(given.normal, "normals");
  const std::size_t n = normals.size();
  StoredMicroState out;
  ContactNetwork& network = out.state.network;
  network.contacts.resize(n);
  for (std::size_t k = 0; k < n; ++k) network.contacts[k].normal = normals[k];
  const auto forces = numbers_in(given.normal_force, "normal_force", n);
  for (std::size_t k = 0; k < n; ++k) network.contacts[k].normal_force = forces[k];
  if (given.shear_force.size() > 0) {
    const std::span<const Vec3> shear = vectors_in(given.shear_force, "shear_force");
    if (shear.size() != n) throw std::invalid_argument("shear_force must have as many rows as normals");
    for (std::size_t k = 0; k < n; ++k) network.contacts[k].shear_force = shear[k];
  }
  if (given.branch.size() > 0) {
    const std::span<const Vec3> branches = vectors_in(given.branch, "branches");
    if (branches.size() != n) throw std::invalid_argument("branches must have as many rows as normals");
    for (std::size_t k = 0; k < n; ++k) network.contacts[k].branch = branches[k];
  }
  if (given.kind.size() > 0) {
    const auto kinds = numbers_in(given.kind, "kinds", n);
    for (std::size_t k = 0; k < n; ++k) {
      if (kinds[k] < 0 || kinds[k] > 2) throw std::invalid_argument("kinds are 0 (g-g), 1 (g-r) and 2 (r-r)");
      network.contacts[k].kind = static_cast<PairKind>(kinds[k]);
    }
  }
  if (given.sliding.size() > 0) {
    const auto sliding = numbers_in(given.sliding, "sliding", n);
    for (std::size_t k = 0; k < n; ++k) network.contacts[k].is_sliding = sliding[k] != 0;
  }
  if (given.body.size() > 0) {
    set_bodies(given, network.contacts, n_bodies);
  } else {
    for (Contact& c : network.contacts) c.body_j = 1;
    n_bodies = 2;
  }
  network.body_position.resize(static_cast<std::size_t>(n_bodies));
  network.body_material.resize(static_cast<std::size_t>(n_bodies), k_gravel);
  network.box.area = given.volume;
  network.box.height = 1.0;
  return out;
}

MicroWords words_from(int bins, const std::string& level, const std::string& mean, const std::string& strong,
                      const std::string& projection, int resamples, std::uint64_t seed) {
  return {bins, level, mean, strong, projection, resamples, seed};
}

void bind_micro(py::module_& m) {
  m.def("check_seal", &check_seal_once);
  m.def("analyse_state", [](const std::filesystem::path& path, std::optional<double> displacement, int bins,
                            const std::string& level, const std::string& mean, const std::string& strong,
                            const std::string& projection, int resamples, std::uint64_t seed) {
    const MicroOptions options = options_from(words_from(bins, level, mean, strong, projection, resamples, seed));
    return analysed(read_micro_state(results_in(path), displacement), options);
  });
  m.def("analyse_network",
        [](const Numbers& normals, const Numbers& normal_force, const Numbers& shear_force, const Numbers& branches,
           const WholeNumbers& kinds, const WholeNumbers& sliding, const WholeNumbers& bodies, int n_bodies,
           double volume, int bins, const std::string& level, const std::string& mean, const std::string& strong,
           const std::string& projection, int resamples, std::uint64_t seed) {
          const MicroOptions options = options_from(words_from(bins, level, mean, strong, projection, resamples, seed));
          return analysed(
              network_from({normals, normal_force, shear_force, branches, kinds, sliding, bodies, volume}, n_bodies),
              options);
        });
  m.def("fabric_tensor",
        [](const Numbers& normals) { return array_of(fabric_tensor(vectors_in(normals, "normals"))); });
  m.def("stress_tensor", [](const Numbers& force, const Numbers& branch, double volume) {
    const std::span<const Vec3> forces = vectors_in(force, "forces"), branches = vectors_in(branch, "branches");
    if (forces.size() != branches.size()) throw std::invalid_argument("forces and branches must have as many rows");
    if (!(volume > 0.0)) throw std::invalid_argument("the volume must be positive");
    Tensor3 sum;
    for (std::size_t k = 0; k < forces.size(); ++k) sum += outer(forces[k], branches[k]);
    return array_of(sum * (1.0 / volume));
  });
}

}  // namespace

MicroOptions options_from(const MicroWords& words) {
  MicroOptions out;
  out.bins = words.bins;
  out.level = is_second(words.level, "level", "contact", "pair") ? ContactLevel::pair : ContactLevel::contact;
  out.force_mean =
      is_second(words.mean, "mean", "orientations", "contacts") ? ForceMean::contacts : ForceMean::orientations;
  out.strong =
      is_second(words.strong, "strong", "normal", "magnitude") ? StrongMeasure::magnitude : StrongMeasure::normal_force;
  out.projection =
      is_second(words.projection, "projection", "all", "near-plane") ? Projection::near_plane : Projection::all;
  out.resamples = words.resamples;
  out.seed = words.seed;
  if (const std::string problem = problem_of(out); !problem.empty()) throw std::invalid_argument(problem);
  return out;
}

py::tuple analysed(const StoredMicroState& stored, const MicroOptions& options) {
  std::string json, csv;
  {
    const py::gil_scoped_release unlocked;
    const MicroAnalysis analysis = analyse(stored.state, options);
    json = json_text(micro_as_json(stored, analysis));
    csv = histogram_csv(analysis);
  }
  return py::make_tuple(json, csv);
}

void bind_analysis(py::module_& m) {
  bind_micro(m);
  m.def("sieve", [](const std::filesystem::path& path, const std::vector<double>& openings) {
    std::string json, csv;
    {
      const py::gil_scoped_release unlocked;
      const SieveReport report = sieve_report(read_stored_grains(path), openings);
      json = json_text(sieve_json(report));
      csv = sieve_csv(report);
    }
    return py::make_tuple(json, csv);
  });
}

}  // namespace dem
