// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/results_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/file_names.hpp"
#include "dem4grm/results/frame_writer.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

constexpr std::int64_t k_format = 1;  // raised when a reader of older files would be misled

/// Runs an addition between opening and closing; errors name the file.
template <class Addition>
void add_to_file(const std::filesystem::path& path, const Addition& addition) {
  try {
    hdf5::Handle file = hdf5::open_file(path, hdf5::Access::write);
    addition(file);
    file.close("the file cannot be closed");
  } catch (const IoError& e) {
    const std::string shown = path.string();
    if (std::string_view(e.what()).starts_with(shown)) throw;
    throw IoError(fmt::format("{}: {}", shown, e.what()));
  }
}

std::string frame_name(int number) { return fmt::format("{:04}", number); }

std::size_t rows_of(const hdf5::Handle& frame, const std::string& group, const std::string& dataset) {
  const std::vector<std::size_t> shape = hdf5::dataset_shape(hdf5::open_group(frame, group), dataset);
  return shape.empty() ? 0 : shape.front();
}

StoredFrame read_frame(const hdf5::Handle& frames, const std::string& name) {
  const hdf5::Handle frame = hdf5::open_group(frames, name);
  StoredFrame out;
  out.name = name;
  out.displacement = hdf5::read_number_attribute(frame, "displacement");
  out.state_hash = hdf5::read_text_attribute(frame, "state_hash");
  out.balls = rows_of(frame, "balls", "radius");
  out.clumps = rows_of(frame, "clumps", "mass");
  out.rubber_grains = rows_of(frame, "rubber_grains", "centre");
  out.contacts = rows_of(frame, "contacts", "normal_force");
  out.bonds = rows_of(frame, "bonds", "length");
  return out;
}

/// True when a file has /meta of this case, these frames, and nothing else.
bool holds_just(const std::filesystem::path& path, const ResultsOrigin& origin, std::span<const FrameInfo> frames) {
  const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
  if (hdf5::read_text(hdf5::open_group(file, "meta"), "resolved_toml") != origin.resolved_toml) return false;
  std::vector<std::string> wanted;
  for (const FrameInfo& f : frames) wanted.push_back(frame_name(f.number));
  return hdf5::names_in(file) == std::vector<std::string>{"frames", "meta"} &&
         hdf5::names_in(hdf5::open_group(file, "frames")) == wanted;
}

}  // namespace

ResultsFile::ResultsFile(std::filesystem::path path, const ResultsOrigin& origin, std::span<const FrameInfo> kept)
    : path_(std::move(path)) {
  if (holds_just(path_, origin, kept)) return;  // a copy has the same content, but not the same bytes
  std::filesystem::path draft = path_;
  draft += ".tmp";
  const ResultsFile fresh(draft, origin);
  add_to_file(draft, [&](const hdf5::Handle& file) {
    const hdf5::Handle old = hdf5::open_file(path_, hdf5::Access::read);
    const hdf5::Handle from = hdf5::open_group(old, "frames"), to = hdf5::open_group(file, "frames");
    for (const FrameInfo& f : kept) hdf5::copy_group(from, frame_name(f.number), to);
  });
  publish_file(draft, path_);
}

ResultsFile::ResultsFile(std::filesystem::path path, const ResultsOrigin& origin) : path_(std::move(path)) {
  hdf5::create_file(path_).close(path_.string() + ": cannot be written");
  add_to_file(path_, [&](const hdf5::Handle& file) {
    const hdf5::Handle meta = hdf5::create_group(file, "meta");
    hdf5::write_attribute(meta, "program", std::string("dem4grm"));
    hdf5::write_attribute(meta, "format", k_format);
    hdf5::write_attribute(meta, "version", std::string(k_version));
    hdf5::write_attribute(meta, "commit", std::string(k_commit));
    hdf5::write_attribute(meta, "compiler", std::string(k_compiler));
    hdf5::write_attribute(meta, "test", origin.test);
    hdf5::write_attribute(meta, "case", origin.case_name);
    const std::array<std::string, 1> source{origin.case_text}, resolved{origin.resolved_toml};
    hdf5::write_dataset(meta, {"case_text", "1", "the case file as it was read"}, source);
    hdf5::write_dataset(meta, {"resolved_toml", "1", "every key of the case with its value"}, resolved);
    hdf5::create_group(file, "frames");
  });
}

void ResultsFile::add_frame(const Simulation& state, const FrameInfo& info) {
  add_to_file(path_, [&](const hdf5::Handle& file) {
    write_frame(hdf5::open_group(file, "frames"), frame_name(info.number), state, info);
  });
}

void ResultsFile::add_table(const std::string& group, const TableFile& table) {
  add_to_file(path_, [&](const hdf5::Handle& file) {
    const hdf5::Handle place = hdf5::create_group(file, group);
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
      const ColumnInfo& column = table.columns()[c];
      hdf5::write_dataset(place, {std::string(column.name), std::string(column.unit), std::string(column.description)},
                          table.values_of(c));
    }
  });
}

std::filesystem::path results_in(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return path;
  std::filesystem::path results = path / file_name::k_results;
  if (!std::filesystem::exists(results, error)) {
    throw MissingFileError(fmt::format("{}: has no {}, so no state to look at", path.string(), file_name::k_results));
  }
  return results;
}

StoredResults read_outline(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw MissingFileError(fmt::format("{}: no such file", path.string()));
  try {
    const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    StoredResults out;
    out.test = hdf5::read_text_attribute(meta, "test");
    out.case_name = hdf5::read_text_attribute(meta, "case");
    out.version = hdf5::read_text_attribute(meta, "version");
    out.commit = hdf5::read_text_attribute(meta, "commit");
    const hdf5::Handle frames = hdf5::open_group(file, "frames");
    for (const std::string& name : hdf5::names_in(frames)) out.frames.push_back(read_frame(frames, name));
    const std::vector<std::string> groups = hdf5::names_in(file);
    const auto has = [&](const char* name) { return std::find(groups.begin(), groups.end(), name) != groups.end(); };
    if (has("shear")) out.table_rows = rows_of(file, "shear", "displacement_mm");
    if (has("compression")) out.table_rows = rows_of(file, "compression", "strain");
    return out;
  } catch (const IoError& e) {
    const std::string shown = path.string();
    if (std::string_view(e.what()).starts_with(shown)) throw;
    throw IoError(fmt::format("{}: {}; the file is damaged or no result of dem4grm", shown, e.what()));
  }
}

}  // namespace dem
