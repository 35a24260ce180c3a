// SPDX-License-Identifier: BSD-3-Clause
// Whole numbers as short text for a page: differences, byte planes, zlib, base64 (the reader is web/src/view/unpack.ts).
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "dem4grm/results/json_text.hpp"

namespace dem {

struct PackingRule {
  int bytes = 2;           ///< of each number: 1, 2 or 4; larger values are cut, so the caller sees to the range
  bool is_signed = false;  ///< zigzag: 0, -1, 1, -2 ... become 0, 1, 2, 3
  bool is_delta = false;   ///< each number but the first as the difference to the one before, modulo 2^(8 bytes)
};

/// One object: count, bytes, zigzag, delta, data. Byte planes (all lowest bytes, then all next ones) are compressed with zlib and
/// written in base64. The same numbers give the same text.
JsonObject packed(std::span<const std::int32_t> numbers, const PackingRule& rule);

/// Bytes in base64 with padding (RFC 4648).
std::string base64_text(std::string_view bytes);

}  // namespace dem
