// SPDX-License-Identifier: BSD-3-Clause
// 128-bit fingerprint of a state (XXH3): equal bits give equal text.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace dem {

/// Collects values in the order in which they are added.
class StateHash {
 public:
  StateHash();
  ~StateHash();
  StateHash(const StateHash&) = delete;
  StateHash& operator=(const StateHash&) = delete;

  void add_bytes(const void* data, std::size_t bytes);
  template <class T>
  void add(const T& value) {
    add_bytes(&value, sizeof value);
  }
  template <class T>
  void add(std::span<const T> values) {
    add_bytes(values.data(), values.size_bytes());
  }

  /// 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dem
