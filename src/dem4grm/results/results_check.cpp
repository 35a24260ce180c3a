// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/results_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dem4grm/core/error.hpp"
#include "dem4grm/results/hdf5_handle.hpp"
#include "dem4grm/results/sealed_file.hpp"

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

SealState seal_state_of(const std::filesystem::path& path) {
  if (!has_seal(path)) return SealState::none;
  try {
    check_seal(path);
    return SealState::fits;
  } catch (const IoError&) {
    return SealState::broken;
  }
}

std::string named_parts(const std::vector<std::string>& damaged) {
  std::string parts;
  for (std::size_t k = 0; k < std::min(k_named, damaged.size()); ++k) parts += (k > 0 ? ", " : "") + damaged[k];
  if (damaged.size() > k_named) parts += fmt::format(" and {} more", damaged.size() - k_named);
  return parts;
}

}  // namespace

ResultsCheck check_results(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw MissingFileError(fmt::format("{}: no such file", path.string()));
  const hdf5::Handle file = hdf5::open_file(path, hdf5::Access::read);
  ResultsCheck out;
  out.seal = seal_state_of(path);
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
  if (!check.damaged.empty()) {
    throw IoError(fmt::format("{}: is damaged: {}; {}", path.string(), named_parts(check.damaged),
                              check.whole_states.empty()
                                  ? "no state is whole"
                                  : fmt::format("whole states: {}", fmt::join(check.whole_states, ", "))));
  }
  if (check.seal == SealState::broken) {
    throw IoError(fmt::format(
        "{}: does not fit its seal: a name, an attribute or the description of a dataset is damaged, or another "
        "program has written to the file; its {} datasets fit their checksums",
        path.string(), check.datasets));
  }
  if (check.seal == SealState::fits)
    return fmt::format("whole: every byte fits the seal ({} datasets)", check.datasets);
  return fmt::format(
      "no seal: damage to names and descriptions would not be noticed; {} datasets can be read, {} without a checksum",
      check.datasets, check.without_checksum);
}

}  // namespace dem
