// SPDX-License-Identifier: BSD-3-Clause
// "did you mean": the known name that lies nearest to a mistyped one.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace dem {

/// Number of inserted, deleted, replaced or swapped characters that turn `a` into `b`, without regard to case.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The nearest of the names if it is near enough to be meant; the first one of equals. A name of which the given one
/// is a part counts as near.
std::optional<std::string_view> nearest_name(std::string_view name, std::span<const std::string_view> names);

}  // namespace dem
