// SPDX-License-Identifier: BSD-3-Clause
// What a verification case finds: numbers held against numbers that others made, and curves for the manual.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// How an obtained value is held against the expected one.
enum class Comparison {
  relative,  ///< error = |obtained / expected - 1|, must not exceed the tolerance
  absolute,  ///< error = |obtained - expected|, must not exceed the tolerance
  at_most,   ///< expected is an upper limit; error = what lies above it
  at_least,  ///< expected is a lower limit; error = what lies below it
};

/// One checked quantity.
struct Check {
  std::string quantity;  ///< what was measured, with the values of the parameters it was measured at
  std::string unit;      ///< of expected and obtained; "1" when dimensionless
  double expected = 0.0, obtained = 0.0, tolerance = 0.0;
  Comparison comparison = Comparison::relative;
  std::string source;  ///< where the expected value comes from

  /// See Comparison; a value that is no number gives an error that is none either.
  [[nodiscard]] double error() const;
  [[nodiscard]] bool passes() const;
};

/// One line of a picture, or points when it stands for numbers of others.
struct Series {
  std::string label;
  bool is_reference = false;  ///< drawn as points
  std::vector<double> x, y;   ///< same length
};

/// A curve for the manual; `name` is unique and serves as the name of a file.
struct Picture {
  std::string name, title, x_label, y_label;
  std::vector<Series> series;
};

/// Where a running case puts its results.
class Findings {
 public:
  /// Held to |obtained / expected - 1| <= tolerance; expected must not be 0.
  void relative(std::string quantity, std::string unit, double expected, double obtained, double tolerance,
                std::string source);
  /// Held to |obtained - expected| <= tolerance, in the unit of both.
  void absolute(std::string quantity, std::string unit, double expected, double obtained, double tolerance,
                std::string source);
  void at_most(std::string quantity, std::string unit, double limit, double obtained, std::string source);
  void at_least(std::string quantity, std::string unit, double limit, double obtained, std::string source);
  void picture(Picture picture);
  /// A sentence for the manual, about what the numbers show.
  void remark(std::string text);

  [[nodiscard]] const std::vector<Check>& checks() const { return checks_; }
  [[nodiscard]] const std::vector<Picture>& pictures() const { return pictures_; }
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  std::vector<Check> checks_;
  std::vector<Picture> pictures_;
  std::vector<std::string> remarks_;
};

}  // namespace dem
