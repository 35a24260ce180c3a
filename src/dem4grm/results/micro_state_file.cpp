// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/micro_state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

using hdf5::Handle;

/// Columns of equal length or an IoError.
void expect_rows(std::size_t rows, std::size_t wanted, const char* what) {
  if (rows != wanted) throw IoError(fmt::format("{} has {} rows where {} belong", what, rows, wanted));
}

std::vector<Wall> read_walls(const Handle& frame) {
  const Handle group = hdf5::open_group(frame, "walls");
  const std::vector<std::string> names = hdf5::read_texts(group, "name");
  const std::vector<Vec3> corner = hdf5::read_vectors(group, "corner");
  const std::vector<double> lengths = hdf5::read_dataset(group, "lengths");
  expect_rows(corner.size(), names.size(), "walls/corner");
  expect_rows(lengths.size(), 2 * names.size(), "walls/lengths");
  std::vector<Wall> walls(names.size());
  for (std::size_t w = 0; w < walls.size(); ++w) {
    walls[w].name = names[w];
    walls[w].corner = corner[w];
    walls[w].length_u = lengths[2 * w];
    walls[w].length_v = lengths[2 * w + 1];
  }
  return walls;
}

/// Places and materials of the bodies: rubber grains, then clumps.
void read_bodies(const Handle& frame, const std::vector<std::uint8_t>& material, ContactNetwork& out) {
  const std::vector<std::int64_t> body = hdf5::read_whole_numbers(hdf5::open_group(frame, "balls"), "body");
  out.body_position = hdf5::read_vectors(hdf5::open_group(frame, "rubber_grains"), "centre");
  const std::vector<Vec3> clumps = hdf5::read_vectors(hdf5::open_group(frame, "clumps"), "position");
  out.body_position.insert(out.body_position.end(), clumps.begin(), clumps.end());
  out.body_material.resize(out.body_position.size(), k_rubber);
  expect_rows(body.size(), material.size(), "balls/body");
  for (std::size_t ball = 0; ball < body.size(); ++ball) {
    out.body_material.at(static_cast<std::size_t>(body[ball])) = material[ball] == k_rubber ? k_rubber : k_gravel;
  }
}

/// The datasets of the contacts of a state.
struct StoredContacts {
  explicit StoredContacts(const Handle& group)
      : ball_i(hdf5::read_whole_numbers(group, "ball_i")),
        ball_j(hdf5::read_whole_numbers(group, "ball_j")),
        wall(hdf5::read_whole_numbers(group, "wall")),
        body_i(hdf5::read_whole_numbers(group, "body_i")),
        body_j(hdf5::read_whole_numbers(group, "body_j")),
        point(hdf5::read_vectors(group, "point")),
        normal(hdf5::read_vectors(group, "normal")),
        shear_force(hdf5::read_vectors(group, "shear_force")),
        normal_force(hdf5::read_dataset(group, "normal_force")),
        friction(hdf5::read_dataset(group, "friction")),
        is_sliding(hdf5::read_bytes(group, "is_sliding")) {
    for (const std::size_t rows :
         {ball_j.size(), wall.size(), body_i.size(), body_j.size(), point.size(), normal.size(), shear_force.size(),
          normal_force.size(), friction.size(), is_sliding.size()}) {
      expect_rows(rows, ball_i.size(), "a dataset of contacts");
    }
  }

  std::vector<std::int64_t> ball_i, ball_j, wall, body_i, body_j;
  std::vector<Vec3> point, normal, shear_force;
  std::vector<double> normal_force, friction;
  std::vector<std::uint8_t> is_sliding;
};

/// What contacts with balls and with walls have in common.
template <class AnyContact>
void take_row(const StoredContacts& columns, std::size_t row, AnyContact& c) {
  c.point = columns.point[row];
  c.normal = columns.normal[row];
  c.normal_force = columns.normal_force[row];
  c.shear_force = columns.shear_force[row];
  c.friction = columns.friction[row];
  c.is_sliding = columns.is_sliding[row] != 0;
}

void read_contacts(const Handle& frame, const std::vector<std::uint8_t>& material, ContactNetwork& out) {
  const StoredContacts columns(hdf5::open_group(frame, "contacts"));
  for (std::size_t row = 0; row < columns.ball_i.size(); ++row) {
    const Vec3& centre = out.body_position.at(static_cast<std::size_t>(columns.body_i[row]));
    if (columns.wall[row] >= 0) {
      WallContact c;
      c.ball = static_cast<int>(columns.ball_i[row]);
      c.body = static_cast<int>(columns.body_i[row]);
      c.wall = static_cast<int>(columns.wall[row]);
      take_row(columns, row, c);
      c.branch = c.point - centre;
      out.wall_contacts.push_back(c);
      continue;
    }
    Contact c;
    c.ball_i = static_cast<int>(columns.ball_i[row]);
    c.ball_j = static_cast<int>(columns.ball_j[row]);
    c.body_i = static_cast<int>(columns.body_i[row]);
    c.body_j = static_cast<int>(columns.body_j[row]);
    c.kind = kind_of(material.at(static_cast<std::size_t>(c.ball_i)), material.at(static_cast<std::size_t>(c.ball_j)));
    take_row(columns, row, c);
    c.branch = out.body_position.at(static_cast<std::size_t>(c.body_j)) - centre;
    out.contacts.push_back(c);
  }
}

RubberState read_rubber(const Handle& frame, std::size_t n_grains) {
  RubberState out;
  out.ball_position = hdf5::read_vectors(hdf5::open_group(frame, "balls"), "position");
  if (out.ball_position.size() < n_grains * k_grain_balls) throw IoError("balls/position is too short");
  out.ball_position.resize(n_grains * k_grain_balls);
  const Handle bonds = hdf5::open_group(frame, "bonds");
  out.rest_length = hdf5::read_dataset(bonds, "rest_length");
  expect_rows(out.rest_length.size(), n_grains, "bonds/rest_length");
  out.bond_length = hdf5::read_dataset(bonds, "length");
  out.bond_normal_force = hdf5::read_dataset(bonds, "normal_force");
  out.bond_shear_force = hdf5::read_dataset(bonds, "shear_force");
  out.bond_moment = hdf5::read_dataset(bonds, "moment");
  out.is_broken = hdf5::read_bytes(bonds, "is_broken");
  for (const std::size_t rows : {out.bond_length.size(), out.bond_normal_force.size(), out.bond_shear_force.size(),
                                 out.bond_moment.size(), out.is_broken.size()}) {
    expect_rows(rows, n_grains * k_grain_bonds, "a dataset of bonds");
  }
  return out;
}

}  // namespace

MicroState read_micro_state(const Handle& frame) {
  const std::vector<std::string> columns = hdf5::names_in(hdf5::open_group(frame, "contacts"));
  if (std::find(columns.begin(), columns.end(), "is_sliding") == columns.end()) {
    throw IoError("its contacts have no friction: written before states held it, run the case again");
  }
  const std::vector<std::uint8_t> material = hdf5::read_bytes(hdf5::open_group(frame, "balls"), "material");
  MicroState out;
  try {
    read_bodies(frame, material, out.network);
    out.network.box = find_sample_box(read_walls(frame));
    read_contacts(frame, material, out.network);
  } catch (const std::out_of_range&) {
    throw IoError("a contact names a ball or body that is not there");
  }
  out.rubber = read_rubber(frame, hdf5::dataset_shape(hdf5::open_group(frame, "rubber_grains"), "centre").front());
  return out;
}

const StoredFrame& choose_frame(const std::filesystem::path& path, const std::vector<StoredFrame>& frames,
                                std::optional<double> displacement) {
  if (frames.empty()) throw MissingFileError(fmt::format("{}: holds no state yet", path.string()));
  if (!displacement) return frames.back();
  const auto off = [&](const StoredFrame& f) { return std::fabs(f.displacement - *displacement); };
  const auto nearest =
      std::min_element(frames.begin(), frames.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
  if (off(*nearest) <= k_frame_reach) return *nearest;
  std::string list;
  for (const StoredFrame& f : frames) list += fmt::format("{}{:.3g}", list.empty() ? "" : ", ", f.displacement * 1e3);
  throw MissingFileError(fmt::format("{}: holds no state at {:.4g} mm; there are states at {} mm", path.string(),
                                     *displacement * 1e3, list));
}

StoredMicroState read_micro_state(const std::filesystem::path& results, std::optional<double> displacement) {
  const StoredResults outline = read_outline(results);
  if (outline.test != "direct_shear") {
    throw IoError(
        fmt::format("{}: is of a {} test; micro-mechanics needs a direct shear test", results.string(), outline.test));
  }
  const StoredFrame& frame = choose_frame(results, outline.frames, displacement);
  const Handle file = open_results(results);
  try {
    const Handle group = hdf5::open_group(hdf5::open_group(file, "frames"), frame.name);
    return {frame.name, frame.displacement, frame.state_hash, read_micro_state(group)};
  } catch (const IoError& e) {
    throw IoError(fmt::format("{}: state {} cannot be read: {}", results.string(), frame.name, e.what()));
  }
}

}  // namespace dem
