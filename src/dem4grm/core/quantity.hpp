// SPDX-License-Identifier: BSD-3-Clause
// Quantities with units as text ("60 kPa") to and from SI values, without loss of a bit and without a locale.
//
// Reading shifts the decimal exponent of the written number by the unit's power of ten and converts once, so that
// "5.6 mm" is the double nearest to 0.0056, the same as the literal 5.6e-3. Dividing by 1000 after the conversion would
// round twice. Writing goes the same way back from the shortest decimal text of the SI value, so a written quantity
// always reads as the identical double.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dem {

/// What a quantity measures. `none` stands for plain numbers.
enum class Dimension : std::uint8_t { none, length, speed, stress, density, time, angle };

/// Outcome of reading text: a SI value, or the end of a sentence that begins with the text read
/// (`has no unit; a stress takes Pa, kPa, MPa, GPa or N/mm2`).
struct ParsedQuantity {
  std::optional<double> value;
  std::string problem;
};

/// "length", "speed", "stress", ...; "number" for `none`.
std::string_view dimension_name(Dimension dimension);

/// All units of a dimension, in the order in which people should meet them: "Pa, kPa, MPa, GPa or N/mm2".
std::string accepted_units(Dimension dimension);

/// The unit that a hint proposes: "kPa", "mm", "mm/s", ...; empty for `none`.
std::string_view usual_unit(Dimension dimension);

/// Reads "60 kPa", "60kPa", "2 mm/s", "30e200 Pa". A dimension of `none` takes a plain decimal number.
/// Never throws; what is wrong is said in `problem`.
ParsedQuantity parse_quantity(std::string_view text, Dimension dimension);

/// The SI value in a unit of the dimension that keeps the number readable; parse_quantity gives the same bits back.
/// The value must be finite. Plain decimal text for `none`.
std::string format_quantity(double value, Dimension dimension);

/// The number written in all of `text` times ten to `power_of_ten`, rounded once; nothing when the text is not a plain
/// decimal number (sign, digits, point, exponent) or when the value leaves the range of a double.
std::optional<double> parse_decimal(std::string_view text, int power_of_ten = 0);

/// Shortest text of `value` / ten to `power_of_ten`; parse_decimal(text, power_of_ten) gives the same bits back.
/// The value must be finite.
std::string format_decimal(double value, int power_of_ten = 0);

/// The number that format_decimal writes: of 0.00268 and -3 it is 2.68, which a product with 1000 may miss by a last bit.
double scaled_decimal(double value, int power_of_ten);

}  // namespace dem
