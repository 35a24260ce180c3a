// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/core/state_archive.hpp"

#include <algorithm>
#include <utility>

#include "dem4grm/core/error.hpp"

namespace dem {

bool StateArchive::has_group(std::string_view name) const {
  const std::string start = prefix_ + std::string(name) + ".";
  return is_loading_ &&
         std::any_of(entries_.begin(), entries_.end(), [&](const StateEntry& e) { return e.name.starts_with(start); });
}

void StateArchive::exchange(std::string_view name, Vec3& value) {
  std::vector<double> parts{value.x, value.y, value.z};
  exchange_span<double>(name, std::span(parts));
  value = {parts[0], parts[1], parts[2]};
}

void StateArchive::exchange(std::string_view name, Quaternion& value) {
  std::vector<double> parts{value.w, value.x, value.y, value.z};
  exchange_span<double>(name, std::span(parts));
  value = {parts[0], parts[1], parts[2], parts[3]};
}

void StateArchive::exchange(std::string_view name, std::string& value) {
  std::vector<std::uint8_t> bytes(value.begin(), value.end());
  exchange_list<std::uint8_t>(name, bytes);
  value.assign(bytes.begin(), bytes.end());
}

void StateArchive::exchange(std::string_view name, AlignedArray<double>& values) {
  if (!is_loading_) {
    put(name, std::vector<double>(values.begin(), values.end()));
  } else {
    values.resize(0);
    values.assign(take<double>(name, k_any_length));
  }
}

void StateArchive::put(std::string_view name, StateData data) {
  entries_.push_back({prefix_ + std::string(name), std::move(data)});
}

const StateData& StateArchive::find(const std::string& full_name) {
  if (next_ >= entries_.size() || entries_[next_].name != full_name) {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const StateEntry& e) { return e.name == full_name; });
    if (found == entries_.end()) throw IoError("the saved state has no '" + full_name + "'");
    next_ = static_cast<std::size_t>(found - entries_.begin());
  }
  return entries_[next_++].data;
}

void StateArchive::throw_misfit(const std::string& full_name) {
  throw IoError("the saved state has another type or length of '" + full_name + "' than this case needs");
}

}  // namespace dem
