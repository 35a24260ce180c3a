// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/checkpoint_file.hpp"

#include <fmt/format.h>

#include <array>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/state_group.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

/// Errors of the library name the object; the user needs the file.
template <class Work>
auto naming_file(const std::filesystem::path& path, const char* hint, const Work& work) {
  try {
    return work();
  } catch (const IoError& e) {
    const std::string shown = path.string();
    throw IoError(std::string_view(e.what()).starts_with(shown) ? fmt::format("{}{}", e.what(), hint)
                                                                : fmt::format("{}: {}{}", shown, e.what(), hint));
  }
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const StateArchive& state, const CheckpointFacts& facts) {
  std::filesystem::path draft = path;
  draft += ".tmp";
  naming_file(path, "", [&] {
    hdf5::Handle file = hdf5::create_file(draft);
    {
      const hdf5::Handle meta = hdf5::create_group(file, "meta");
      hdf5::write_attribute(meta, "program", std::string("dem4grm checkpoint"));
      hdf5::write_attribute(meta, "format", k_state_format);
      hdf5::write_attribute(meta, "version", std::string(k_version));
      hdf5::write_attribute(meta, "commit", std::string(k_commit));
      hdf5::write_attribute(meta, "wall_time", facts.wall_time);
      const std::array<std::string, 1> resolved{facts.resolved_toml};
      hdf5::write_dataset(meta, {"resolved_toml", "1", "every key of the case with its value"}, resolved);
      write_state(hdf5::create_group(file, "state"), state);
    }
    file.close("the file cannot be closed");
  });
  publish_file(draft, path);
}

StoredCheckpoint read_checkpoint(const std::filesystem::path& path) {
  const char* hint = "; remove the file to start the run anew";
  return naming_file(path, hint, [&] {
    const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
    const hdf5::Handle meta = hdf5::open_group(file, "meta");
    if (hdf5::read_text_attribute(meta, "program") != "dem4grm checkpoint") throw IoError("is no checkpoint");
    const double format = hdf5::read_number_attribute(meta, "format");
    if (format != static_cast<double>(k_state_format)) {
      throw IoError(fmt::format("has format {}, this program reads {}", format, k_state_format));
    }
    StoredCheckpoint out;
    out.facts.wall_time = hdf5::read_number_attribute(meta, "wall_time");
    out.facts.commit = hdf5::read_text_attribute(meta, "commit");
    out.facts.resolved_toml = hdf5::read_text(meta, "resolved_toml");
    out.state = read_state(hdf5::open_group(file, "state"));
    return out;
  });
}

}  // namespace dem
