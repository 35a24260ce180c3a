// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/lab/shear_curve.hpp"

#include <algorithm>
#include <cmath>

namespace dem {

namespace {

constexpr double k_peak_window = 0.1e-3;      // m
constexpr double k_dilation_window = 1.0e-3;  // m
constexpr double k_hardening_zone = 1.0e-3;   // m
constexpr double k_residual_zone = 2.0e-3;    // m

/// First row of the window that ends at row `last` and is `width` long.
std::size_t window_begin(std::span<const ShearRow> rows, std::size_t last, double width) {
  const double interval = rows.size() > 1 ? rows[1].displacement - rows[0].displacement : width;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(width / interval)));
  return last + 1 >= count ? last + 1 - count : 0;
}

double mean_stress(std::span<const ShearRow> rows) {
  double sum = 0.0;
  for (const ShearRow& r : rows) sum += r.shear_stress;
  return sum / static_cast<double>(rows.size());
}

double mean_normal_stress(std::span<const ShearRow> rows) {
  double sum = 0.0;
  for (const ShearRow& r : rows) sum += r.normal_stress;
  return sum / static_cast<double>(rows.size());
}

/// The displacement is the middle of the first and the last row, as that of the peak has always been.
ShearPoint point_of(std::span<const ShearRow> rows) {
  double rise = 0.0;
  for (const ShearRow& r : rows) rise += r.vertical_displacement;
  return {0.5 * (rows.front().displacement + rows.back().displacement), rise / static_cast<double>(rows.size()),
          mean_normal_stress(rows)};
}

/// Least-squares slope of the plate's height against displacement.
double rise(std::span<const ShearRow> rows) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const double x0 = rows.front().displacement;
  for (const ShearRow& r : rows) {
    const double x = r.displacement - x0, y = r.vertical_displacement;
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(rows.size());
  const double spread = sxx - sx * sx / n;
  return spread > 0.0 ? (sxy - sx * sy / n) / spread : 0.0;
}

/// The rows of a window; its displacement is the middle of what they were averaged over.
Stage stage_of(std::span<const ShearRow> rows, std::size_t begin, std::size_t last, double start) {
  const double before = begin > 0 ? rows[begin - 1].displacement : start;
  return {0.5 * (before + rows[last].displacement), dilatancy_of(rows.subspan(begin, last + 1 - begin))};
}

/// Rows of [0, k_dilatancy_window] after the start and later, for a record that is that long.
void read_dilatancy(std::span<const ShearRow> rows, double start, ShearCurve& c) {
  for (const ShearRow& r : rows) {
    if (-r.vertical_displacement <= c.contraction) continue;
    c.contraction = -r.vertical_displacement;
    c.displacement_at_contraction = r.displacement;
  }
  if (rows.back().displacement - start >= 0.999 * k_residual_zone) {
    c.residual = stage_of(rows, window_begin(rows, rows.size() - 1, k_residual_zone), rows.size() - 1, start);
  }
  for (std::size_t last = 0; last < rows.size(); ++last) {
    if (rows[last].displacement - start < 0.999 * k_dilatancy_window) continue;
    const Stage now = stage_of(rows, window_begin(rows, last, k_dilatancy_window), last, start);
    const auto off_peak = [&](const Stage& s) { return std::fabs(s.displacement - c.displacement_at_peak); };
    if (!(off_peak(c.at_peak) <= off_peak(now))) c.at_peak = now;
    if (!(c.fastest_dilation.dilatancy.rate >= now.dilatancy.rate)) c.fastest_dilation = now;
  }
}

}  // namespace

Dilatancy dilatancy_of(std::span<const ShearRow> rows) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (rows.size() < 2) return {nan, nan, nan};
  const double ratio = mean_stress(rows) / mean_normal_stress(rows), rate = rise(rows);
  return {ratio, rate, ratio - rate};
}

Dilatancy last_dilatancy(std::span<const ShearRow> rows) {
  if (rows.empty()) return dilatancy_of(rows);
  return dilatancy_of(rows.subspan(window_begin(rows, rows.size() - 1, k_dilatancy_window)));
}

ShearCurve read_shear_curve(std::span<const ShearRow> rows, double start) {
  ShearCurve c;
  if (rows.empty() || rows.back().displacement - start < k_peak_window) return c;
  const double end = rows.back().displacement;
  double steepest = -1e300;
  for (std::size_t last = 0; last < rows.size(); ++last) {
    const std::size_t begin = window_begin(rows, last, k_peak_window);
    if (rows[last].displacement - start >= 0.999 * k_peak_window) {
      const double mean = mean_stress(rows.subspan(begin, last + 1 - begin));
      if (!(mean <= c.peak_stress)) {
        c.peak_stress = mean;
        c.peak_point = point_of(rows.subspan(begin, last + 1 - begin));
      }
    }
    if (rows[last].displacement - start >= 0.999 * k_dilation_window) {
      const std::size_t from = window_begin(rows, last, k_dilation_window);
      steepest = std::max(steepest, rise(rows.subspan(from, last + 1 - from)));
    }
  }
  c.displacement_at_peak = c.peak_point.displacement;
  c.is_hardening = c.displacement_at_peak > end - k_hardening_zone;
  if (end - start >= 0.999 * k_residual_zone) {
    const auto zone = rows.subspan(window_begin(rows, rows.size() - 1, k_residual_zone));
    c.residual_stress = mean_stress(zone);
    c.residual_point = point_of(zone);
  }
  const auto half =
      std::find_if(rows.begin(), rows.end(), [&](const ShearRow& r) { return r.shear_stress >= 0.5 * c.peak_stress; });
  if (start == 0.0 && half != rows.end() && half->displacement > 0.0) {
    c.secant_stiffness = half->shear_stress / half->displacement;
  }
  if (steepest > -1e300) c.dilation_angle = std::atan(steepest);
  c.vertical_displacement_at_end = rows.back().vertical_displacement;
  read_dilatancy(rows, start, c);
  return c;
}

}  // namespace dem
