// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/results_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"

namespace dem {
namespace {

constexpr std::size_t k_named = 5;  // of the damaged parts, in a message

/// Everything below a group; damage is noted, and the rest is looked at all the same.
void check_group(const hdf5::Handle& group, const std::string& path, ResultsCheck& out) {
  std::vector<std::string> names;
  try {
    names = hdf5::names_in(group);
  } catch (const IoError&) {
    out.damaged.push_back(path.empty() ? "/" : path);
    return;
  }
  for (const std::string& name : names) {
    std::string place = path;
    if (!place.empty()) place += '/';
    place += name;
    try {
      if (hdf5::is_group(group, name)) {
        check_group(hdf5::open_group(group, name), place, out);
        continue;
      }
      ++out.datasets;
      if (!hdf5::read_through(group, name)) ++out.without_checksum;
    } catch (const IoError&) {
      out.damaged.push_back(place);
    }
  }
}

}  // namespace

ResultsCheck check_results(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw MissingFileError(fmt::format("{}: no such file", path.string()));
  const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
  ResultsCheck out;
  check_group(file, "", out);
  try {
    for (const std::string& state : hdf5::names_in(hdf5::open_group(file, "frames"))) {
      const std::string place = "frames/" + state;
      const bool is_damaged = std::any_of(out.damaged.begin(), out.damaged.end(), [&](const std::string& d) {
        return d == place || d.starts_with(place + "/");
      });
      if (!is_damaged) out.whole_states.push_back(state);
    }
  } catch (const IoError&) {  // then no state can be reached
  }
  return out;
}

std::string verdict_of(const std::filesystem::path& path, const ResultsCheck& check) {
  if (check.damaged.empty()) {
    if (check.without_checksum == 0) return fmt::format("whole: {} datasets fit their checksums", check.datasets);
    return fmt::format("{} datasets can be read; {} have no checksum, so damage within them would not be noticed",
                       check.datasets, check.without_checksum);
  }
  std::string parts;
  for (std::size_t k = 0; k < std::min(k_named, check.damaged.size()); ++k) {
    parts += (k > 0 ? ", " : "") + check.damaged[k];
  }
  if (check.damaged.size() > k_named) parts += fmt::format(" and {} more", check.damaged.size() - k_named);
  throw IoError(fmt::format("{}: is damaged: {}; {}", path.string(), parts,
                            check.whole_states.empty()
                                ? "no state is whole"
                                : fmt::format("whole states: {}", fmt::join(check.whole_states, ", "))));
}

}  // namespace dem
