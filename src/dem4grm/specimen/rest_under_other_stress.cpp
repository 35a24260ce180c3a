// SPDX-License-Identifier: BSD-3-Clause
// A saved specimen that is to be given another normal stress.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "dem4grm/specimen/rest.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "dem4grm/specimen/stage_names.hpp"

namespace dem {

void rest_under_other_stress(std::vector<StateEntry>& state) {
  const auto at = [&](std::string_view name) {
    return std::find_if(state.begin(), state.end(), [&](const StateEntry& e) { return e.name == name; });
  };
  if (const auto held = at("rest.held"); held != state.end()) {
    held->data = std::vector<std::int64_t>{0};
    return;
  }
  // A finished specimen has no place in a stage any more: it gets one at the beginning of the last.
  StateArchive place;
  std::string stage = stage_name::k_final_friction;
  std::size_t station = 0;
  std::int64_t steps = 0;
  RestState rest;
  place.exchange("stage", stage);
  place.exchange("station", station);
  place.exchange("station_steps", steps);
  place.group("rest", [&] { exchange(place, rest); });
  if (const auto old = at("stage"); old != state.end()) state.erase(old);
  state.insert(state.end(), place.entries().begin(), place.entries().end());
}

}  // namespace dem
