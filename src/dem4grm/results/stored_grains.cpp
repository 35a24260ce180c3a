// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/stored_grains.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dem4grm/case_file/case_file.hpp"
#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/results_file.hpp"
#include "dem4grm/specimen/sieve_analysis.hpp"
#include "dem4grm/walls/shear_box.hpp"

namespace dem {
namespace {

std::filesystem::path file_in(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw MissingFileError(fmt::format("{}: no such file", path.string()));
  if (!std::filesystem::is_directory(path, ignored)) return path;
  for (const char* name : {file_name::k_specimen, file_name::k_results}) {
    if (std::filesystem::exists(path / name, ignored)) return path / name;
  }
  throw MissingFileError(fmt::format("{}: holds neither {} nor {}; a run writes them when its specimen is ready",
                                     path.string(), file_name::k_specimen, file_name::k_results));
}

std::vector<Vec3> read_normals(const hdf5::Handle& frame) {
  const hdf5::Handle contacts = hdf5::open_group(frame, "contacts");
  const std::vector<Vec3> all = hdf5::read_vectors(contacts, "normal");
  const std::vector<std::int64_t> wall = hdf5::read_whole_numbers(contacts, "wall");
  if (wall.size() != all.size()) throw IoError("the contacts of the state do not fit together");
  std::vector<Vec3> between;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (wall[c] < 0) between.push_back(all[c]);
  }
  return between;
}

StoredGrains read_first_state(const std::filesystem::path& path) {
  const hdf5::Handle file = open_results(path);
  const hdf5::Handle meta = hdf5::open_group(file, "meta");
  if (hdf5::read_text_attribute(meta, "test") != "direct_shear") {
    throw Error(ExitCode::usage, fmt::format("{}: is of no direct shear test: it holds no specimen", path.string()));
  }
  StoredGrains out;
  out.file = path;
  out.test = std::get<DirectShearCase>(parse_case(hdf5::read_text(meta, "resolved_toml"), "resolved.toml").test);
  const hdf5::Handle frames = hdf5::open_group(file, "frames");
  const std::vector<std::string> names = hdf5::names_in(frames);
  if (names.empty()) throw IoError("the file holds no state yet");
  out.state = names.front();
  const hdf5::Handle frame = hdf5::open_group(frames, out.state);
  out.displacement = hdf5::read_number_attribute(frame, "displacement");
  out.packing = read_packing(frame);
  out.normals = read_normals(frame);
  const std::vector<Vec3> corners = hdf5::read_vectors(hdf5::open_group(frame, "walls"), "corner");
  if (corners.size() < static_cast<std::size_t>(ShearBox::k_walls)) throw IoError("the walls are no shear box");
  out.plate_height = corners[ShearBox::k_top_plate].z;
  return out;
}

}  // namespace

Packing read_packing(const hdf5::Handle& frame) {
  const hdf5::Handle balls = hdf5::open_group(frame, "balls");
  Packing packing;
  packing.position = hdf5::read_vectors(balls, "position");
  packing.radius = hdf5::read_dataset(balls, "radius");
  const std::vector<std::int64_t> body = hdf5::read_whole_numbers(balls, "body");
  packing.body.assign(body.begin(), body.end());
  packing.n_rubber_grains =
      static_cast<int>(hdf5::dataset_shape(hdf5::open_group(frame, "rubber_grains"), "centre").at(0));
  const std::size_t n = packing.position.size();
  const bool is_whole = n > 0 && packing.radius.size() == n && packing.body.size() == n &&
                        static_cast<std::size_t>(packing.n_rubber_balls()) <= n &&
                        std::is_sorted(packing.body.begin(), packing.body.end()) &&
                        std::all_of(packing.radius.begin(), packing.radius.end(), [](double r) { return r > 0.0; });
  if (!is_whole) throw IoError("the balls of the state do not fit together");
  return packing;
}

StoredGrains read_stored_grains(const std::filesystem::path& path) {
  const std::filesystem::path file = file_in(path);
  try {
    return read_first_state(file);
  } catch (const Error& e) {
    const std::string shown = file.string();
    if (e.code() == ExitCode::usage || std::string_view(e.what()).starts_with(shown)) throw;
    throw IoError(fmt::format("{}: {}; the file is damaged or no result of dem4grm", shown, e.what()));
  }
}

Homogeneity homogeneity_of(const StoredGrains& stored) {
  const DirectShearCase& test = stored.test;
  const MeasuredGrains grains = measure_grains(stored.packing, test.rubber.density, test.rubber_solid_density);
  const Bounds room{{}, {test.box.length, test.box.width, stored.plate_height}};
  return measure_homogeneity(stored.packing, stored.normals, room, mean_size(grains),
                             test.rubber.density / test.rubber_solid_density);
}

}  // namespace dem
