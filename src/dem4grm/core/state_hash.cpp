// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/core/state_hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace dem {

struct StateHash::State {
  XXH3_state_t* handle = XXH3_createState();
  State() { XXH3_128bits_reset(handle); }
  ~State() { XXH3_freeState(handle); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

StateHash::StateHash() : state_(std::make_unique<State>()) {}
StateHash::~StateHash() = default;

void StateHash::add_bytes(const void* data, std::size_t bytes) { XXH3_128bits_update(state_->handle, data, bytes); }

std::string StateHash::text() const {
  const XXH128_hash_t h = XXH3_128bits_digest(state_->handle);
  return fmt::format("{:016x}{:016x}", h.high64, h.low64);
}

}  // namespace dem
