// SPDX-License-Identifier: BSD-3-Clause
// Units, and the reading and writing of quantities.
#include "dem4grm/core/quantity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <fmt/format.h>

namespace dem {
namespace {

/// SI value = number * 10^power_of_ten * factor / divisor.
struct Unit {
  std::string_view name;
  Dimension dimension;
  int power_of_ten;
  double factor = 1.0;
  double divisor = 1.0;
};

// Within a dimension: the order of messages, and from small to large for format_quantity.
constexpr std::array k_units{
    Unit{"um", Dimension::length, -6},
    Unit{"mm", Dimension::length, -3},
    Unit{"cm", Dimension::length, -2},
    Unit{"m", Dimension::length, 0},
    Unit{"mm/min", Dimension::speed, -3, 1.0, 60.0},
    Unit{"mm/s", Dimension::speed, -3},
    Unit{"cm/s", Dimension::speed, -2},
    Unit{"m/s", Dimension::speed, 0},
    Unit{"Pa", Dimension::stress, 0},
    Unit{"kPa", Dimension::stress, 3},
    Unit{"MPa", Dimension::stress, 6},
    Unit{"GPa", Dimension::stress, 9},
    Unit{"N/mm2", Dimension::stress, 6},
    Unit{"kg/m3", Dimension::density, 0},
    Unit{"g/cm3", Dimension::density, 3},
    Unit{"us", Dimension::time, -6},
    Unit{"ms", Dimension::time, -3},
    Unit{"s", Dimension::time, 0},
    Unit{"deg", Dimension::angle, 0, std::numbers::pi, 180.0},
    Unit{"rad", Dimension::angle, 0},
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Where the parts of a decimal number end; all zero when the text does not begin with one.
struct DecimalParts {
  std::size_t mantissa_end = 0;
  std::size_t end = 0;
};

DecimalParts split_decimal(std::string_view text) {
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  std::size_t digits = 0;
  while (at < text.size() && is_digit(text[at])) ++at, ++digits;
  if (at < text.size() && text[at] == '.') {
    ++at;
    while (at < text.size() && is_digit(text[at])) ++at, ++digits;
  }
  if (digits == 0) return {};
  DecimalParts parts{at, at};
  // An exponent counts only when digits follow, so that a unit may begin with the letter e.
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
    const std::size_t exponent_begin = at;
    while (at < text.size() && is_digit(text[at])) ++at;
    if (at > exponent_begin) parts.end = at;
  }
  return parts;
}

/// Exponent as written; clamped, because a longer one leaves the range of a double whatever the mantissa of a file
/// of at most a megabyte is.
int read_exponent(std::string_view text) {
  constexpr int k_limit = 10'000'000;
  bool negative = false;
  if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
    negative = text.front() == '-';
    text.remove_prefix(1);
  }
  int exponent = 0;
  for (const char c : text) exponent = std::min(k_limit, exponent * 10 + (c - '0'));
  return negative ? -exponent : exponent;
}

/// Lower case, without blanks and powers signs, micro as u: for "did you mean".
std::string plain_unit(std::string_view unit) {
  std::string plain;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const std::string_view rest = unit.substr(i);
    if (rest.starts_with("\u00b5") || rest.starts_with("\u03bc")) {
      plain += 'u';
      ++i;
    } else if (rest.starts_with("\u00b2") || rest.starts_with("\u00b3")) {
      plain += rest.starts_with("\u00b2") ? '2' : '3';
      ++i;
    } else if (unit[i] >= 'A' && unit[i] <= 'Z') {
      plain += static_cast<char>(unit[i] - 'A' + 'a');
    } else if (!is_blank(unit[i]) && unit[i] != '^' && unit[i] != '*') {
      plain += unit[i];
    }
  }
  return plain;
}

const Unit* find_unit(std::string_view name) {
  const auto* found =
      std::find_if(k_units.begin(), k_units.end(), [name](const Unit& unit) { return unit.name == name; });
  return found == k_units.end() ? nullptr : found;
}

std::string_view with_article(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "a plain number";
    case Dimension::length:
      return "a length";
    case Dimension::speed:
      return "a speed";
    case Dimension::stress:
      return "a stress";
    case Dimension::density:
      return "a density";
    case Dimension::time:
      return "a time";
    case Dimension::angle:
      return "an angle";
  }
  return "";
}

std::string takes_units(Dimension dimension) {
  return fmt::format("{} takes {}", with_article(dimension), accepted_units(dimension));
}

std::string unknown_unit_problem(std::string_view unit, Dimension dimension) {
  if (unit.front() == ',' || unit.front() == '_' || unit.front() == '\'') {
    return unit.front() == ',' ? "has a comma in the number; write it with a decimal point, as 5.6"
                               : "has a separator in the number; write the digits without one";
  }
  const std::string wanted = plain_unit(unit);
  std::string problem = fmt::format("has the unknown unit \"{}\"; {}", unit, takes_units(dimension));
  for (const Unit& known : k_units) {
    if (known.dimension == dimension && plain_unit(known.name) == wanted) {
      return problem + fmt::format("; did you mean \"{}\"?", known.name);
    }
  }
  return problem;
}

/// Decimal exponent of the leading digit of a finite value that is not zero.
int leading_exponent(double value) {
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific);
  const std::string_view text(buffer.data(), static_cast<std::size_t>(end.ptr - buffer.data()));
  return read_exponent(text.substr(text.find('e') + 1));
}

/// The largest unit of the ladder in which the number is at least 1; the smallest of it for smaller numbers. Beyond
/// what anyone writes with a prefix, the SI unit itself.
const Unit& best_unit(double value, Dimension dimension) {
  std::vector<std::string_view> ladder;
  switch (dimension) {
    case Dimension::none:
      break;
    case Dimension::length:
      ladder = {"mm", "m"};
      break;
    case Dimension::speed:
      ladder = {"mm/s", "m/s"};
      break;
    case Dimension::stress:
      ladder = {"Pa", "kPa", "MPa", "GPa"};
      break;
    case Dimension::density:
      ladder = {"kg/m3"};
      break;
    case Dimension::time:
      ladder = {"us", "ms", "s"};
      break;
    case Dimension::angle:
      ladder = {"rad"};
      break;
  }
  // Millimetres are the words of the laboratory up to ten metres.
  const int rise = dimension == Dimension::length || dimension == Dimension::speed ? 1 : 0;
  const int leading = value == 0.0 ? 0 : leading_exponent(value);
  const Unit* best = find_unit(ladder.front());
  for (const std::string_view name : ladder) {
    const Unit* unit = find_unit(name);
    if (leading >= unit->power_of_ten + rise) best = unit;
  }
  if (leading > 15) {
    for (const std::string_view name : ladder) {
      if (find_unit(name)->power_of_ten == 0) best = find_unit(name);
    }
  }
  return *best;
}

}  // namespace

std::string_view dimension_name(Dimension dimension) {
  if (dimension == Dimension::none) return "number";
  const std::string_view name = with_article(dimension);
  return name.substr(name.find(' ') + 1);
}

std::string accepted_units(Dimension dimension) {
  std::vector<std::string_view> names;
  for (const Unit& unit : k_units) {
    if (unit.dimension == dimension) names.push_back(unit.name);
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

std::string_view usual_unit(Dimension dimension) {
  switch (dimension) {
    case Dimension::none:
      return "";
    case Dimension::length:
      return "mm";
    case Dimension::speed:
      return "mm/s";
    case Dimension::stress:
      return "kPa";
    case Dimension::density:
      return "kg/m3";
    case Dimension::time:
      return "us";
    case Dimension::angle:
      return "deg";
  }
  return "";
}

std::optional<double> parse_decimal(std::string_view text, int power_of_ten) {
  const DecimalParts parts = split_decimal(text);
  if (parts.end == 0 || parts.end != text.size()) return std::nullopt;
  std::string_view mantissa = text.substr(0, parts.mantissa_end);
  if (mantissa.front() == '+') mantissa.remove_prefix(1);  // from_chars takes no plus sign
  const int exponent = parts.end > parts.mantissa_end ? read_exponent(text.substr(parts.mantissa_end + 1)) : 0;
  const std::string shifted = fmt::format("{}e{}", mantissa, exponent + power_of_ten);
  double value = 0.0;
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  if (error != std::errc{} || end != shifted.data() + shifted.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string format_decimal(double value, int power_of_ten) {
  if (value == 0.0) return std::signbit(value) ? "-0" : "0";
  std::array<char, 40> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific);
  std::string_view text(buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data()));
  const std::string_view sign = text.front() == '-' ? "-" : "";
  text.remove_prefix(sign.size());
  const std::size_t e = text.find('e');
  const int exponent = read_exponent(text.substr(e + 1)) - power_of_ten;
  const char first = text.front();
  const std::string_view fraction = e > 2 ? text.substr(2, e - 2) : std::string_view();
  if (exponent < -5 || exponent > 8) {
    return fmt::format("{}{}{}{}e{}", sign, first, fraction.empty() ? "" : ".", fraction, exponent);
  }
  if (exponent < 0) return fmt::format("{}0.{:0>{}}{}{}", sign, "", -exponent - 1, first, fraction);
  const auto whole = static_cast<std::size_t>(exponent);  // digits of the fraction that move before the point
  if (whole >= fraction.size()) return fmt::format("{}{}{:0<{}}", sign, first, fraction, whole);
  return fmt::format("{}{}{}.{}", sign, first, fraction.substr(0, whole), fraction.substr(whole));
}

double scaled_decimal(double value, int power_of_ten) {
  return parse_decimal(format_decimal(value, power_of_ten)).value_or(0.0);
}

ParsedQuantity parse_quantity(std::string_view text, Dimension dimension) {
  text = trimmed(text);
  const DecimalParts parts = split_decimal(text);
  if (parts.end == 0) return {std::nullopt, "does not begin with a number"};
  const std::string_view number = text.substr(0, parts.end);
  const std::string_view unit_name = trimmed(text.substr(parts.end));
  if (dimension == Dimension::none) {
    if (!unit_name.empty()) return {std::nullopt, fmt::format("must be a plain number, without \"{}\"", unit_name)};
  } else if (unit_name.empty()) {
    return {std::nullopt, "has no unit; " + takes_units(dimension)};
  }
  Unit unit{"", dimension, 0};
  if (dimension != Dimension::none) {
    const Unit* found = find_unit(unit_name);
    if (found == nullptr) return {std::nullopt, unknown_unit_problem(unit_name, dimension)};
    if (found->dimension != dimension) {
      return {std::nullopt, fmt::format("is {}, not {}; {}", with_article(found->dimension), with_article(dimension),
                                        takes_units(dimension))};
    }
    unit = *found;
  }
  const std::optional<double> value = parse_decimal(number, unit.power_of_ten);
  if (!value) return {std::nullopt, "is beyond the range of a number"};
  return {*value * unit.factor / unit.divisor, {}};
}

std::string format_quantity(double value, Dimension dimension) {
  if (dimension == Dimension::none) return format_decimal(value);
  const Unit& unit = best_unit(value, dimension);
  return fmt::format("{} {}", format_decimal(value, unit.power_of_ten), unit.name);
}

}  // namespace dem
