// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/results/state_group.hpp"

namespace dem {
namespace {

StateData read_entry(const hdf5::Handle& group, const std::string& name) {
  switch (hdf5::dataset_kind(group, name)) {
    case hdf5::DatasetKind::real:
      return hdf5::read_dataset(group, name);
    case hdf5::DatasetKind::whole:
      return hdf5::read_whole_numbers(group, name);
    case hdf5::DatasetKind::byte:
      return hdf5::read_bytes(group, name);
  }
  return {};
}

}  // namespace

void write_state(const hdf5::Handle& group, const StateArchive& state) {
  for (const StateEntry& entry : state.entries()) {
    std::visit([&](const auto& values) { hdf5::write_dataset(group, {entry.name, "SI", ""}, values); }, entry.data);
  }
}

StateArchive read_state(const hdf5::Handle& group) {
  std::vector<StateEntry> entries;
  for (const std::string& name : hdf5::names_in(group)) entries.push_back({name, read_entry(group, name)});
  return StateArchive(std::move(entries));
}

}  // namespace dem
