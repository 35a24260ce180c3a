// SPDX-License-Identifier: BSD-3-Clause
// Quantities: exact reading, exact way back, and one message for each way of getting it wrong.
#include "dem4grm/core/quantity.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace dem {
namespace {

double value_of(std::string_view text, Dimension dimension) {
  const ParsedQuantity parsed = parse_quantity(text, dimension);
  EXPECT_TRUE(parsed.value.has_value()) << text << " " << parsed.problem;
  return parsed.value.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string problem_of(std::string_view text, Dimension dimension) {
  const ParsedQuantity parsed = parse_quantity(text, dimension);
  EXPECT_FALSE(parsed.value.has_value()) << text;
  return parsed.problem;
}

TEST(Quantity, ReadsEveryUnitToTheNearestDouble) {
  EXPECT_EQ(value_of("60 kPa", Dimension::stress), 60e3);
  EXPECT_EQ(value_of("60kPa", Dimension::stress), 60e3);
  EXPECT_EQ(value_of("  60\tkPa ", Dimension::stress), 60e3);
  EXPECT_EQ(value_of("90 MPa", Dimension::stress), 90e6);
  EXPECT_EQ(value_of("80 GPa", Dimension::stress), 80e9);
  EXPECT_EQ(value_of("0.1 N/mm2", Dimension::stress), 0.1e6);
  EXPECT_EQ(value_of("30e200 Pa", Dimension::stress), 30e200);
  EXPECT_EQ(value_of("+1.5E+3Pa", Dimension::stress), 1500.0);
  EXPECT_EQ(value_of("5.6 mm", Dimension::length), 5.6e-3);
  EXPECT_EQ(value_of("0.627 mm", Dimension::length), 0.627e-3);
  EXPECT_EQ(value_of("627 um", Dimension::length), 627e-6);
  EXPECT_EQ(value_of("10 cm", Dimension::length), 0.1);
  EXPECT_EQ(value_of(".5 m", Dimension::length), 0.5);
  EXPECT_EQ(value_of("2 mm/s", Dimension::speed), 0.002);
  EXPECT_EQ(value_of("3 cm/s", Dimension::speed), 0.03);
  EXPECT_EQ(value_of("-0.5 m/s", Dimension::speed), -0.5);
  EXPECT_DOUBLE_EQ(value_of("1 mm/min", Dimension::speed), 1e-3 / 60.0);
  EXPECT_EQ(value_of("2710 kg/m3", Dimension::density), 2710.0);
  EXPECT_EQ(value_of("2.71 g/cm3", Dimension::density), 2710.0);
  EXPECT_EQ(value_of("1 us", Dimension::time), 1e-6);
  EXPECT_EQ(value_of("3 ms", Dimension::time), 3e-3);
  EXPECT_EQ(value_of("180 deg", Dimension::angle), std::numbers::pi);
  EXPECT_EQ(value_of("0.27", Dimension::none), 0.27);
}

TEST(Quantity, EachMistakeHasItsOwnMessage) {
  EXPECT_EQ(problem_of("60", Dimension::stress), "has no unit; a stress takes Pa, kPa, MPa, GPa or N/mm2");
  EXPECT_EQ(problem_of("60 kN", Dimension::stress),
            "has the unknown unit \"kN\"; a stress takes Pa, kPa, MPa, GPa or N/mm2");
  EXPECT_EQ(problem_of("60 kpa", Dimension::stress),
            "has the unknown unit \"kpa\"; a stress takes Pa, kPa, MPa, GPa or N/mm2; did you mean \"kPa\"?");
  EXPECT_EQ(problem_of("60 mm", Dimension::stress),
            "is a length, not a stress; a stress takes Pa, kPa, MPa, GPa or N/mm2");
  EXPECT_EQ(problem_of("10 \u00b5m", Dimension::length),
            "has the unknown unit \"\u00b5m\"; a length takes um, mm, cm or m; did you mean \"um\"?");
  EXPECT_EQ(problem_of("2710 kg/m\u00b3", Dimension::density),
            "has the unknown unit \"kg/m\u00b3\"; a density takes kg/m3 or g/cm3; did you mean \"kg/m3\"?");
  EXPECT_EQ(problem_of("kPa", Dimension::stress), "does not begin with a number");
  EXPECT_EQ(problem_of("", Dimension::stress), "does not begin with a number");
  EXPECT_EQ(problem_of("inf Pa", Dimension::stress), "does not begin with a number");
  EXPECT_EQ(problem_of("- Pa", Dimension::stress), "does not begin with a number");
  EXPECT_EQ(problem_of("5,6 mm", Dimension::length),
            "has a comma in the number; write it with a decimal point, as 5.6");
  EXPECT_EQ(problem_of("1e400 Pa", Dimension::stress), "is beyond the range of a number");
  EXPECT_EQ(problem_of("1e99999999999999999999 Pa", Dimension::stress), "is beyond the range of a number");
  EXPECT_EQ(problem_of("0.3 mm", Dimension::none), "must be a plain number, without \"mm\"");
}

TEST(Quantity, WritesInTheWordsOfTheLaboratory) {
  EXPECT_EQ(format_quantity(60e3, Dimension::stress), "60 kPa");
  EXPECT_EQ(format_quantity(90e6, Dimension::stress), "90 MPa");
  EXPECT_EQ(format_quantity(80e9, Dimension::stress), "80 GPa");
  EXPECT_EQ(format_quantity(30e200, Dimension::stress), "3e201 Pa");
  EXPECT_EQ(format_quantity(0.0, Dimension::stress), "0 Pa");
  EXPECT_EQ(format_quantity(0.627e-3, Dimension::length), "0.627 mm");
  EXPECT_EQ(format_quantity(1e-5, Dimension::length), "0.01 mm");
  EXPECT_EQ(format_quantity(0.1, Dimension::length), "100 mm");
  EXPECT_EQ(format_quantity(0.0, Dimension::length), "0 mm");
  EXPECT_EQ(format_quantity(0.002, Dimension::speed), "2 mm/s");
  EXPECT_EQ(format_quantity(1e-5, Dimension::speed), "0.01 mm/s");
  EXPECT_EQ(format_quantity(2710.0, Dimension::density), "2710 kg/m3");
  EXPECT_EQ(format_quantity(1.5e-6, Dimension::time), "1.5 us");
  EXPECT_EQ(format_quantity(0.25, Dimension::none), "0.25");
}

TEST(Quantity, WhatIsWrittenReadsAsTheSameBits) {
  std::uint64_t bits = 88172645463325252ULL;  // xorshift: every exponent, subnormal numbers too
  for (int trial = 0; trial < 200000; ++trial) {
    bits ^= bits << 13;
    bits ^= bits >> 7;
    bits ^= bits << 17;
    const auto value = std::bit_cast<double>(bits);
    if (!std::isfinite(value)) continue;
    const auto dimension = static_cast<Dimension>(trial % 7);
    const std::string text = format_quantity(value, dimension);
    const ParsedQuantity back = parse_quantity(text, dimension);
    ASSERT_TRUE(back.value.has_value()) << text << " " << back.problem;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(*back.value), bits) << text;
  }
}

TEST(Quantity, DecimalShiftIsExact) {
  EXPECT_EQ(parse_decimal("5.6", -3), 5.6e-3);
  EXPECT_EQ(parse_decimal("14.3", -2), 0.143);
  EXPECT_EQ(format_decimal(5.6e-3, -3), "5.6");
  EXPECT_EQ(format_decimal(1234567.0), "1234567");
  EXPECT_EQ(format_decimal(-0.00012), "-0.00012");
  EXPECT_EQ(format_decimal(1e-9), "1e-9");
  for (int k = 100; k < 1000; ++k) EXPECT_EQ(scaled_decimal(k / 1e5, -3), k / 1e2);
  EXPECT_EQ(scaled_decimal(0.0, -3), 0.0);
  EXPECT_FALSE(parse_decimal("5.6 ").has_value());
  EXPECT_FALSE(parse_decimal("0x10").has_value());
  EXPECT_FALSE(parse_decimal("").has_value());
  EXPECT_FALSE(parse_decimal("nan").has_value());
}

}  // namespace
}  // namespace dem
