// SPDX-License-Identifier: BSD-3-Clause
// A state as named arrays. One function for each type lists its parts and serves both directions, so what is saved is
// what is loaded.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "dem4grm/core/aligned_array.hpp"
#include "dem4grm/core/quaternion.hpp"
#include "dem4grm/core/vec3.hpp"

namespace dem {

using StateData = std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>>;

/// One named array of a saved state.
struct StateEntry {
  std::string name;  ///< parts of the path joined by '.'
  StateData data;
};

/// Takes a state apart, or puts it together again. Loading throws IoError when an entry is missing, of another type or
/// of another length than the state has room for.
class StateArchive {
 public:
  /// For saving.
  StateArchive() = default;
  /// For loading what entries() gave.
  explicit StateArchive(std::vector<StateEntry> entries) : entries_(std::move(entries)), is_loading_(true) {}

  [[nodiscard]] bool is_loading() const { return is_loading_; }
  [[nodiscard]] const std::vector<StateEntry>& entries() const { return entries_; }
  /// True when loading and the group was saved.
  [[nodiscard]] bool has_group(std::string_view name) const;

  /// Puts a name in front of all that is exchanged inside `content`.
  template <class Content>
  void group(std::string_view name, const Content& content) {
    const std::size_t before = prefix_.size();
    prefix_ += name;
    prefix_ += '.';
    content();
    prefix_.resize(before);
  }

  void exchange(std::string_view name, double& value) { exchange_one<double>(name, value); }
  void exchange(std::string_view name, Vec3& value);
  void exchange(std::string_view name, Quaternion& value);
  void exchange(std::string_view name, std::string& value);
  /// Whole numbers and truth values.
  template <class Whole>
  requires std::is_integral_v<Whole>
  void exchange(std::string_view name, Whole& value) { exchange_one<std::int64_t>(name, value); }

  /// Any length; a list that is loaded takes the length that was saved.
  void exchange(std::string_view name, std::vector<double>& values) { exchange_list<double>(name, values); }
  template <class Whole>
  requires std::is_integral_v<Whole>
  void exchange(std::string_view name, std::vector<Whole>& values) { exchange_list<std::int64_t>(name, values); }

  /// A length that the state has by its construction: another one is an error.
  void exchange_fixed(std::string_view name, std::span<double> values) { exchange_span<double>(name, values); }
  void exchange_fixed(std::string_view name, std::span<unsigned char> values) {
    exchange_span<std::uint8_t>(name, values);
  }
  /// Any length.
  void exchange(std::string_view name, AlignedArray<double>& values);

 private:
  template <class Stored, class Value>
  void exchange_one(std::string_view name, Value& value) {
    if (!is_loading_) {
      put(name, std::vector<Stored>{static_cast<Stored>(value)});
    } else {
      value = static_cast<Value>(take<Stored>(name, 1).front());
    }
  }
  template <class Stored, class Value>
  void exchange_list(std::string_view name, std::vector<Value>& values) {
    if (!is_loading_) {
      put(name, std::vector<Stored>(values.begin(), values.end()));
    } else {
      const std::vector<Stored>& stored = take<Stored>(name, k_any_length);
      values.assign(stored.begin(), stored.end());
    }
  }
  template <class Stored, class Value>
  void exchange_span(std::string_view name, std::span<Value> values) {
    if (!is_loading_) {
      put(name, std::vector<Stored>(values.begin(), values.end()));
    } else {
      const std::vector<Stored>& stored = take<Stored>(name, values.size());
      std::copy(stored.begin(), stored.end(), values.begin());
    }
  }

  static constexpr std::size_t k_any_length = static_cast<std::size_t>(-1);
  void put(std::string_view name, StateData data);
  const StateData& find(const std::string& full_name);
  [[noreturn]] static void throw_misfit(const std::string& full_name);

  template <class Stored>
  const std::vector<Stored>& take(std::string_view name, std::size_t length) {
    const std::string full_name = prefix_ + std::string(name);
    const auto* values = std::get_if<std::vector<Stored>>(&find(full_name));
    if (values == nullptr || (length != k_any_length && values->size() != length)) throw_misfit(full_name);
    return *values;
  }

  std::vector<StateEntry> entries_;
  bool is_loading_ = false;
  std::string prefix_;
  std::size_t next_ = 0;  ///< where the next entry is expected: loading asks in the order of saving
};

}  // namespace dem
