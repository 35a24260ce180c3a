// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/report/packed_integers.hpp"

#include <zlib.h>

#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr int k_compression = 9;  // slowest, smallest: a page is made once and opened often

std::uint32_t zigzag(std::uint32_t value, std::uint32_t mask, int bits) {
  const bool is_negative = (value >> (bits - 1) & 1U) != 0;
  return ((value << 1) ^ (is_negative ? ~0U : 0U)) & mask;
}

std::string byte_planes(std::span<const std::int32_t> numbers, const PackingRule& rule) {
  const std::size_t n = numbers.size();
  const int bits = 8 * rule.bytes;
  const std::uint32_t mask = rule.bytes == 4 ? ~0U : (1U << bits) - 1U;
  std::string planes(n * static_cast<std::size_t>(rule.bytes), '\0');
  std::uint32_t before = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const auto now = static_cast<std::uint32_t>(numbers[k]);
    std::uint32_t value = (rule.is_delta ? now - before : now) & mask;
    if (rule.is_signed) value = zigzag(value, mask, bits);
    for (std::size_t plane = 0; plane < static_cast<std::size_t>(rule.bytes); ++plane) {
      planes[plane * n + k] = static_cast<char>(value >> (8 * plane) & 0xFFU);
    }
    before = now;
  }
  return planes;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  // zlib's interface is C: it takes bytes as unsigned characters.
  const int result =
      compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), k_compression);
  if (result != Z_OK) throw Error(ExitCode::memory, "zlib cannot compress the view of a specimen");
  out.resize(size);
  return out;
}

}  // namespace

std::string base64_text(std::string_view bytes) {
  constexpr std::string_view k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t k) {
    return k < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) : 0U;
  };
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::uint32_t triple = byte(k) << 16 | byte(k + 1) << 8 | byte(k + 2);
    out += k_letters[triple >> 18];
    out += k_letters[triple >> 12 & 63U];
    out += k + 1 < bytes.size() ? k_letters[triple >> 6 & 63U] : '=';
    out += k + 2 < bytes.size() ? k_letters[triple & 63U] : '=';
  }
  return out;
}

JsonObject packed(std::span<const std::int32_t> numbers, const PackingRule& rule) {
  return {{"count", static_cast<std::int64_t>(numbers.size())},
          {"bytes", rule.bytes},
          {"zigzag", rule.is_signed},
          {"delta", rule.is_delta},
          {"data", base64_text(compressed(byte_planes(numbers, rule)))}};
}

}  // namespace dem
