// SPDX-License-Identifier: BSD-3-Clause
// One rubber grain between plates far beyond small strain, against a separate program and a scaling law.
#include <fmt/format.h>

#include <cmath>

#include "dem4grm/lab/grain_compression.hpp"
#include "dem4grm/verify/grain_checks.hpp"

namespace dem::verify {

namespace {

std::vector<CompressionRow> compress(const GrainCompressionCase& test) {
  LabObserver silent;
  return run_grain_compression(test, silent).rows;
}

/// Value of a record at a displacement; a row is a mean over its interval and belongs to the middle of it.
template <class Read>
double value_at(const std::vector<CompressionRow>& rows, double displacement, const Read& read) {
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const CompressionRow &a = rows[k - 1], &b = rows[k];
    if (b.displacement < displacement) continue;
    const double width = b.displacement - a.displacement;
    const double t = (displacement - (a.displacement - 0.5 * width)) / width;
    return read(a) + t * (read(b) - read(a));
  }
  return NAN;
}

double load_of(const CompressionRow& r) { return r.load; }
double ratio_of(const CompressionRow& r) { return r.poisson_ratio; }

struct Point {
  double displacement, load;
};

constexpr double k_grain_height = 4.150e-3;  // m, outer, of the published grain

constexpr const char* k_program = "separate explicit program for one grain";
constexpr const char* k_second_program = "second separate program, loads at single displacements";

void hold_loads(Findings& findings, const std::string& setting, const std::vector<CompressionRow>& rows,
                const std::vector<Point>& points, double tolerance, const char* source = k_program) {
  for (const Point& p : points) {
    findings.relative(fmt::format("load at {:.2f} mm, {}", p.displacement * 1e3, setting), "N", p.load,
                      value_at(rows, p.displacement, load_of), tolerance, source);
  }
}

/// One line or one row of points of the picture; both kinds of entries have a displacement and a load.
template <class Entry>
void add_series(Picture& picture, const std::string& label, bool is_reference, const std::vector<Entry>& entries) {
  Series s{label, is_reference, {}, {}};
  for (const Entry& e : entries) {
    s.x.push_back(e.displacement * 1e3);
    s.y.push_back(e.load);
  }
  picture.series.push_back(s);
}

/// What the first program says about plates of one friction.
struct PlateReference {
  std::string setting, plates;  ///< names of its loads, and of its curve and Poisson's ratios
  std::vector<Point> loads;
  std::vector<std::pair<double, double>> ratios;  ///< strain, Poisson's ratio
};

void hold_against_plates(Findings& findings, Picture& picture, const std::vector<CompressionRow>& rows,
                         const PlateReference& reference) {
  hold_loads(findings, reference.setting, rows, reference.loads, 0.08);
  add_series(picture, "engine, " + reference.plates, false, rows);
  add_series(picture, "separate program, " + reference.plates, true, reference.loads);
  for (const auto& [strain, ratio] : reference.ratios) {
    findings.absolute(fmt::format("Poisson's ratio at {:.0f} % strain, {}", 100.0 * strain, reference.plates), "1",
                      ratio, value_at(rows, strain * k_grain_height, ratio_of), 0.02, k_program);
  }
}

GrainCompressionCase case_of_second_program() {
  GrainCompressionCase test;
  test.ball_radius = 0.63e-3;
  test.strain = 0.31;
  test.integration.local_damping = 0.7;
  return test;
}

/// The same program with linear springs that have the friction of the rubber, on rough and on smooth plates.
void check_frictional_springs(Findings& findings) {
  GrainCompressionCase test = case_of_second_program();
  test.bond.spring_friction = 0.27;
  hold_loads(findings, "r = 0.63 mm, springs with friction 0.27", compress(test),
             {{0.25e-3, 4.34}, {0.50e-3, 9.11}, {0.75e-3, 17.2}, {1.00e-3, 29.0}, {1.25e-3, 42.7}}, 0.02,
             k_second_program);
  test.walls.friction = 0.0;
  hold_loads(findings, "r = 0.63 mm, springs with friction 0.27, smooth plates", compress(test),
             {{0.25e-3, 3.55}, {0.50e-3, 7.59}, {0.75e-3, 14.8}, {1.00e-3, 24.8}, {1.25e-3, 36.6}}, 0.02,
             k_second_program);
}

/// Without linear springs and with much local damping, as in that program.
void check_second_program(Findings& findings) {
  GrainCompressionCase test = case_of_second_program();
  test.bond.linear_spring = false;
  const auto rows = compress(test);
  const std::string setting = "r = 0.63 mm, no linear springs";
  hold_loads(findings, setting, rows,
             {{0.25e-3, 3.86}, {0.50e-3, 8.18}, {0.75e-3, 16.1}, {1.00e-3, 27.4}, {1.25e-3, 40.6}}, 6e-3,
             k_second_program);
  const std::pair<double, double> ratios[] = {{0.25e-3, 0.25}, {0.50e-3, 0.26}, {0.75e-3, 0.24}, {1.25e-3, 0.22}};
  for (const auto& [displacement, ratio] : ratios) {
    findings.absolute(fmt::format("Poisson's ratio at {:.2f} mm, {}", displacement * 1e3, setting), "1", ratio,
                      value_at(rows, displacement, ratio_of), 0.01, k_second_program);
  }
}

}  // namespace

void check_grain_compression(Findings& findings) {
  const PlateReference rough{"published values",
                             "friction 0.27",
                             {{0.20e-3, 2.93},
                              {0.41e-3, 6.57},
                              {0.61e-3, 11.1},
                              {0.82e-3, 18.9},
                              {1.03e-3, 28.7},
                              {1.23e-3, 39.8},
                              {1.65e-3, 64.5}},
                             {{0.08, 0.35}, {0.32, 0.30}}};
  const PlateReference smooth{"smooth plates",
                              "smooth plates",
                              {{0.20e-3, 2.45}, {0.41e-3, 5.54}, {0.61e-3, 9.7}, {0.82e-3, 16.5}, {1.03e-3, 25.0}},
                              {{0.08, 0.40}, {0.24, 0.42}}};
  const std::vector<Point> soft{{0.41e-3, 6.01}, {0.61e-3, 9.8}, {0.82e-3, 15.7}, {1.03e-3, 23.0}, {1.23e-3, 31.3}};
  Picture picture{
      "grain-compression", "One rubber grain between two plates", "approach of the plates, mm", "load, N", {}};
  GrainCompressionCase test;
  test.strain = 0.41;
  hold_against_plates(findings, picture, compress(test), rough);
  test.strain = 0.26;
  test.walls.friction = 0.0;
  hold_against_plates(findings, picture, compress(test), smooth);
  test.strain = 0.31;
  test.walls.friction = 0.70;
  test.rubber.poisson_ratio = 0.3;
  hold_loads(findings, "rubber Poisson's ratio 0.3", compress(test), soft, 0.08);
  findings.picture(picture);
  check_second_program(findings);
  check_frictional_springs(findings);
  findings.remark(
      "The tolerance of 8 % is wide because the loads of the first program are means over wider intervals and "
      "read "
      "from a table of three digits: most of the difference is a shift along the approach by less than 0.02 mm. The "
      "second program gave loads at single displacements, and there the tolerance is 0.6 % without "
      "springs and 2 % with springs that have friction.");
}

void check_grain_scaling(Findings& findings) {
  GrainCompressionCase test;
  test.strain = 0.2;
  test.records = 20;
  const auto base = compress(test);
  test.ball_radius *= 2.0;
  test.plate_velocity *= 2.0;
  const auto large = compress(test);
  test.bond.modulus *= 0.5;
  test.rubber.shear_modulus *= 0.5;
  test.walls.shear_modulus *= 0.5;
  const auto large_soft = compress(test);
  for (const std::size_t k : {4U, 9U, 14U, 19U}) {
    const std::string at = fmt::format("at {:.0f} % strain", 100.0 * base[k].strain);
    findings.relative("load of twice the radius over the load, " + at, "1", 4.0, large[k].load / base[k].load, 0.01,
                      "F = E r^2 f(strain; G/E)");
    findings.relative("load of twice the radius and half the moduli over the load, " + at, "1", 2.0,
                      large_soft[k].load / base[k].load, 0.01, "F = E r^2 f(strain; G/E)");
  }
}

}  // namespace dem::verify
