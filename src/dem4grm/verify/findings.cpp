// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/findings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dem {

double Check::error() const {
  switch (comparison) {
    case Comparison::relative:
      return std::fabs(obtained / expected - 1.0);
    case Comparison::absolute:
      return std::fabs(obtained - expected);
    case Comparison::at_most:
      return std::isnan(obtained) ? obtained : std::max(0.0, obtained - expected);
    case Comparison::at_least:
      return std::isnan(obtained) ? obtained : std::max(0.0, expected - obtained);
  }
  return 0.0;
}

// Written so that a value that is no number fails.
bool Check::passes() const { return error() <= tolerance; }

void Findings::relative(std::string quantity, std::string unit, double expected, double obtained, double tolerance,
                        std::string source) {
  checks_.push_back(
      {std::move(quantity), std::move(unit), expected, obtained, tolerance, Comparison::relative, std::move(source)});
}

void Findings::absolute(std::string quantity, std::string unit, double expected, double obtained, double tolerance,
                        std::string source) {
  checks_.push_back(
      {std::move(quantity), std::move(unit), expected, obtained, tolerance, Comparison::absolute, std::move(source)});
}

void Findings::at_most(std::string quantity, std::string unit, double limit, double obtained, std::string source) {
  checks_.push_back(
      {std::move(quantity), std::move(unit), limit, obtained, 0.0, Comparison::at_most, std::move(source)});
}

void Findings::at_least(std::string quantity, std::string unit, double limit, double obtained, std::string source) {
  checks_.push_back(
      {std::move(quantity), std::move(unit), limit, obtained, 0.0, Comparison::at_least, std::move(source)});
}

void Findings::picture(Picture picture) { pictures_.push_back(std::move(picture)); }

void Findings::remark(std::string text) { remarks_.push_back(std::move(text)); }

}  // namespace dem
