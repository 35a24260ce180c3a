// SPDX-License-Identifier: BSD-3-Clause
// Where the watchdog of a shear test stops it, on both sides of each limit. That it looks at all: tests/lab/watched_shear_test.cpp.
#include "dem4grm/lab/shear_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "dem4grm/core/error.hpp"

namespace dem {
namespace {

constexpr double k_target = 100e3;

/// Rows every 0.1 mm up to a displacement, m; those in the last millimetre hold one stress, the others the target.
std::vector<ShearRow> rows_to(double displacement, double late_stress) {
  std::vector<ShearRow> rows;
  for (int k = 1; 1e-4 * k <= displacement + 1e-9; ++k) {
    ShearRow row;
    row.displacement = 1e-4 * k;
    row.normal_stress = row.displacement > displacement - 1e-3 ? late_stress : k_target;
    rows.push_back(row);
  }
  return rows;
}

TEST(ShearWatch, GrainsMayMoveWithWhatTheyWereGivenAndNoMore) {
  EXPECT_NO_THROW(check_kinetic_energy(0.0, 0.0, 0.0));
  EXPECT_NO_THROW(check_kinetic_energy(0.999e-3, 1e-3, 2e-3));
  for (const double kinetic : {1.001e-3, 5.0, std::nan("")}) {
    EXPECT_THROW(check_kinetic_energy(kinetic, 1e-3, 2e-3), PhysicsError) << kinetic;
  }
  try {
    check_kinetic_energy(5.0, 1e-3, 2e-3);
  } catch (const PhysicsError& e) {
    const std::string text = e.what();
    for (const char* part : {"5 J", "0.001 J", "2.000 mm", "integration.time_step_safety"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(ShearWatch, APlateMayBeOffByThirtyPerCentOverAMillimetre) {
  for (const double factor : {0.71, 0.9, 1.0, 1.29}) {
    EXPECT_NO_THROW(check_plate_stress(rows_to(5e-3, factor * k_target), 5e-3, k_target)) << factor;
  }
  for (const double factor : {0.0, 0.69, 1.31, 4.0}) {
    EXPECT_THROW(check_plate_stress(rows_to(5e-3, factor * k_target), 5e-3, k_target), PhysicsError) << factor;
  }
  EXPECT_THROW(check_plate_stress(rows_to(5e-3, 40e3), 5e-3, 30e3), PhysicsError) << "of the stress that was asked for";
  EXPECT_NO_THROW(check_plate_stress(rows_to(0.9e-3, 0.0), 0.9e-3, k_target)) << "the start is no failure";
  EXPECT_NO_THROW(check_plate_stress({}, 5e-3, k_target)) << "right after a test went on";
  EXPECT_NO_THROW(check_plate_stress(rows_to(5e-3, 0.0), 5e-3, k_target, 4.5e-3)) << "of a test that was branched";
}

TEST(ShearWatch, OneCollapseWithinTheMillimetreIsNoFailure) {
  std::vector<ShearRow> rows = rows_to(5e-3, k_target);
  rows.back().normal_stress = 0.0;
  EXPECT_NO_THROW(check_plate_stress(rows, 5e-3, k_target));
}

}  // namespace
}  // namespace dem
