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
#include "dem4grm/results/sealed_file.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

constexpr std::int64_t k_format = 1;  // raised when a reader of older files would be misled

/// Lets `make` write a draft beside the file, seals it, and gives it the name of the file; removes it when that fails.
template <class Make>
void replace_sealed(const std::filesystem::path& path, const Make& make) {
  std::filesystem::path draft = path;
  draft += ".tmp";
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);  // a link that somebody put there would be followed
  try {
    naming_file(path, [&] {
      make(draft);
      seal_file(draft);
    });
  } catch (const IoError&) {
    std::filesystem::remove(draft, ignored);
    throw;
  }
  publish_file(draft, path);
}

/// A copy to be changed. Its seal must fit, since the copy gets a new one, under which old damage would hide. A file of an older build has
/// none, and no room for one at its beginning: its content goes into a file that has.
void copy_for_change(const std::filesystem::path& path, const std::filesystem::path& draft) {
  check_seal_once(path);
  if (has_seal(path)) {
    copy_to_new_file(path, draft);
    return;
  }
  const hdf5::Handle from = hdf5::open_file(path, hdf5::Access::read);
  hdf5::Handle to = hdf5::create_file(draft, k_seal_bytes);
  for (const std::string& name : hdf5::names_in(from)) hdf5::copy_group(from, name, to);
  to.close("the file cannot be closed");
}

void write_meta(const hdf5::Handle& file, const ResultsOrigin& origin) {
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
  const hdf5::Handle file = open_results(path);
  if (hdf5::read_text(hdf5::open_group(file, "meta"), "resolved_toml") != origin.resolved_toml) return false;
  std::vector<std::string> wanted;
  for (const FrameInfo& f : frames) wanted.push_back(frame_name(f.number));
  return hdf5::names_in(file) == std::vector<std::string>{"frames", "meta"} &&
         hdf5::names_in(hdf5::open_group(file, "frames")) == wanted;
}

}  // namespace

void change_sealed_file(const std::filesystem::path& path, const std::function<void(const hdf5::Handle&)>& change) {
  replace_sealed(path, [&](const std::filesystem::path& draft) {
    copy_for_change(path, draft);
    hdf5::Handle file = hdf5::open_file(draft, hdf5::Access::write);
    change(file);
    file.close("the file cannot be closed");
  });
}

ResultsFile::ResultsFile(std::filesystem::path path, const ResultsOrigin& origin, std::span<const FrameInfo> kept)
    : path_(std::move(path)) {
  if (holds_just(path_, origin, kept)) return;  // a copy has the same content, but not the same bytes
  replace_sealed(path_, [&](const std::filesystem::path& draft) {
    hdf5::Handle file = hdf5::create_file(draft, k_seal_bytes);
    write_meta(file, origin);
    const hdf5::Handle old = open_results(path_), from = hdf5::open_group(old, "frames");
    const hdf5::Handle to = hdf5::create_group(file, "frames");
    for (const FrameInfo& f : kept) hdf5::copy_group(from, frame_name(f.number), to);
    file.close("the file cannot be closed");
  });
}

ResultsFile::ResultsFile(std::filesystem::path path, const ResultsOrigin& origin) : path_(std::move(path)) {
  replace_sealed(path_, [&](const std::filesystem::path& draft) {
    hdf5::Handle file = hdf5::create_file(draft, k_seal_bytes);
    write_meta(file, origin);
    hdf5::create_group(file, "frames");
    file.close("the file cannot be closed");
  });
}

void ResultsFile::add_frame(const Simulation& state, const FrameInfo& info) {
  change_sealed_file(path_, [&](const hdf5::Handle& file) {
    write_frame(hdf5::open_group(file, "frames"), frame_name(info.number), state, info);
  });
}

void ResultsFile::add_tables(std::span<const NamedTable> tables) {
  change_sealed_file(path_, [&](const hdf5::Handle& file) {
    for (const NamedTable& named : tables) {
      const hdf5::Handle place = hdf5::create_group(file, named.group);
      for (std::size_t c = 0; c < named.table->columns().size(); ++c) {
        const ColumnInfo& column = named.table->columns()[c];
        hdf5::write_dataset(place,
                            {std::string(column.name), std::string(column.unit), std::string(column.description)},
                            named.table->values_of(c));
      }
    }
  });
}

hdf5::Handle open_results(const std::filesystem::path& path) {
  check_seal_once(path);
  return hdf5::open_file(path, hdf5::Access::read);
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
