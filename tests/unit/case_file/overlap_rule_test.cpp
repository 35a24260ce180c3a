// SPDX-License-Identifier: BSD-3-Clause
// Overlaps that can be told from stress and modulus.
#include "dem4grm/case_file/overlap_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/laws/mixing.hpp"

namespace dem {
namespace {

TEST(OverlapRule, CarriesTheStressOfASquareArray) {
  for (const double stress : {30e3, 100e3}) {
    for (const double modulus : {1e6, 90e6}) {
      for (const double ratio : {0.0, 0.3}) {
        const double r = 2.5e-3, overlap = r * foreseen_overlap(stress, modulus, ratio);
        const double effective = mix({modulus, ratio}, {modulus, ratio}).effective_modulus;
        const double force = 4.0 / 3.0 * effective * std::sqrt(0.5 * r) * std::pow(overlap, 1.5);
        EXPECT_NEAR(force / (stress * 4.0 * r * r), 1.0, 1e-12);
      }
    }
  }
}

TEST(OverlapRule, PublishedMaterialsStayFarBelowTheLimit) {
  EXPECT_NEAR(foreseen_overlap(100e3, 90e6, 0.3), 0.0222, 1e-4);
  EXPECT_NEAR(foreseen_overlap(100e3, 12e6, 0.5), 0.0684, 1e-3);
}

}  // namespace
}  // namespace dem
