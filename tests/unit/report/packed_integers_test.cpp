// SPDX-License-Identifier: BSD-3-Clause
// Packed numbers are read back by a decoder that is written anew here, from the words of web/src/data.ts.
#include "dem4grm/report/packed_integers.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <vector>

namespace dem {
namespace {

std::string from_base64(const std::string& text) {
  std::string out;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    int value = 0;
    if (c >= 'A' && c <= 'Z')
      value = c - 'A';
    else if (c >= 'a' && c <= 'z')
      value = c - 'a' + 26;
    else if (c >= '0' && c <= '9')
      value = c - '0' + 52;
    else
      value = c == '+' ? 62 : 63;
    bits = bits << 6 | static_cast<unsigned>(value);
    count += 6;
    if (count >= 8) out += static_cast<char>(bits >> (count -= 8) & 0xFF);
  }
  return out;
}

std::vector<std::int64_t> unpacked(const JsonObject& packed) {
  const auto n = static_cast<std::size_t>(number_in(packed, "count"));
  const auto bytes = static_cast<std::size_t>(number_in(packed, "bytes"));
  const std::string compressed = from_base64(text_in(packed, "data"));
  std::vector<unsigned char> planes(n * bytes + 1);
  uLongf size = planes.size();
  EXPECT_EQ(uncompress(planes.data(), &size, reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()),
            Z_OK);
  EXPECT_EQ(size, n * bytes);
  std::vector<std::int64_t> out;
  const std::int64_t modulus = std::int64_t{1} << (8 * bytes);
  std::int64_t before = 0;
  for (std::size_t k = 0; k < n; ++k) {
    std::int64_t value = 0;
    for (std::size_t plane = 0; plane < bytes; ++plane) value += std::int64_t{planes[plane * n + k]} << (8 * plane);
    if (is_set_in(packed, "zigzag")) value = value % 2 == 0 ? value / 2 : -(value + 1) / 2;
    if (is_set_in(packed, "delta")) value = ((before + value) % modulus + modulus) % modulus;
    before = value;
    out.push_back(value);
  }
  return out;
}

TEST(PackedIntegers, ComeBackInEveryForm) {
  const std::vector<std::int32_t> small{0, 1, 255, 7, 128}, positive{0, 65535, 3, 3, 40000},
      ascending{2, 3, 3, 70000, 70001};
  const std::vector<std::int32_t> either{0, -1, 1, 32767, -32768, 12};
  const auto expect_back = [](const std::vector<std::int32_t>& numbers, const PackingRule& rule) {
    const std::vector<std::int64_t> expected(numbers.begin(), numbers.end());
    EXPECT_EQ(unpacked(packed(numbers, rule)), expected) << rule.bytes << rule.is_signed << rule.is_delta;
  };
  expect_back(small, {1, false, false});
  expect_back(positive, {2, false, false});
  expect_back(positive, {2, false, true});  // differences wrap round
  expect_back(either, {2, true, false});
  expect_back(ascending, {4, false, true});
  expect_back(ascending, {4, false, false});
  expect_back({std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max(), -1},
              {4, true, false});
  expect_back({}, {2, true, true});
}

TEST(PackedIntegers, Base64IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64_text(""), "");
  EXPECT_EQ(base64_text("f"), "Zg==");
  EXPECT_EQ(base64_text("fo"), "Zm8=");
  EXPECT_EQ(base64_text("foo"), "Zm9v");
  EXPECT_EQ(base64_text("foobar"), "Zm9vYmFy");
}

TEST(PackedIntegers, SmallDifferencesTakeLittle) {
  std::vector<std::int32_t> steady;
  for (int k = 0; k < 10'000; ++k) steady.push_back(3 * k);
  EXPECT_LT(text_in(packed(steady, {4, false, true}), "data").size(), 400U);
}

}  // namespace
}  // namespace dem
