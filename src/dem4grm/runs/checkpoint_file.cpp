// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/checkpoint_file.hpp"

#include <fmt/format.h>

#include <array>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/output_file.hpp"
#include "dem4grm/results/sealed_file.hpp"
#include "dem4grm/results/state_group.hpp"
#include "dem4grm/version.hpp"

namespace dem {
namespace {

bool is_whole(const std::filesystem::path& path) {
  try {
    check_seal(path);
    return true;
  } catch (const IoError&) {
    return false;
  }
}

void write_draft(const std::filesystem::path& draft, const StateArchive& state, const CheckpointFacts& facts) {
  hdf5::Handle file = hdf5::create_file(draft, k_seal_bytes);
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
  seal_file(draft);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const StateArchive& state, const CheckpointFacts& facts,
                      const std::filesystem::path& older) {
  std::filesystem::path draft = path;
  draft += ".tmp";
  std::error_code ignored;
  std::filesystem::remove(draft, ignored);  // a link that somebody put there would be followed
  try {
    naming_file(path, [&] { write_draft(draft, state, facts); });
  } catch (const IoError&) {
    std::filesystem::remove(draft, ignored);
    throw;
  }
  // A damaged one is written over: kept, it would take the place of the whole one before it.
  publish_file(draft, path, is_whole(path) ? older : std::filesystem::path());
}

StoredCheckpoint read_checkpoint(const std::filesystem::path& path) {
  check_seal(path);
  return naming_file(path, [&] {
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

std::optional<NewestCheckpoint> read_newest_checkpoint(const std::filesystem::path& path,
                                                       const std::filesystem::path& older) {
  std::string reasons;
  bool is_any_there = false;
  for (const std::filesystem::path& file : {path, older}) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) continue;
    is_any_there = true;
    try {
      NewestCheckpoint out{read_checkpoint(file), {}};
      if (!reasons.empty()) out.note = fmt::format("{}; goes on from the one before it, {}", reasons, file.string());
      return out;
    } catch (const IoError& e) {
      reasons += (reasons.empty() ? "" : "\n") + std::string(e.what());
    }
  }
  if (!is_any_there) return std::nullopt;
  throw IoError(fmt::format("{}\nno checkpoint can be read; remove {} and {} to start the run anew", reasons,
                            path.filename().string(), older.filename().string()));
}

}  // namespace dem
