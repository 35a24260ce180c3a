// SPDX-License-Identifier: BSD-3-Clause
// Slits that let grains out, for shapes whose pebbles are known.
#include "dem4grm/specimen/slit_sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dem4grm/grains/rubber_size.hpp"

namespace dem {
namespace {

SpecimenSettings gravel_of(std::vector<std::string> shapes) {
  SpecimenSettings s;
  s.rubber_content = 0.0;
  s.gravel_grading = {{3e-3, 0.0}, {4e-3, 0.0}, {8e-3, 1.0}};  // nothing passes 4 mm
  s.clump_shapes = std::move(shapes);
  return s;
}

TEST(SlitSizes, OfSpheresAreTheirDiameter) {
  const SlitSizes sizes = slit_sizes(gravel_of({"sphere"}), 1610, 1150);
  EXPECT_NEAR(sizes.passes, 4e-3, 1e-9);
  EXPECT_NEAR(sizes.enters, 4e-3, 1e-9);
}

TEST(SlitSizes, TheThickestPebbleOfTheThinnestShapeDecides) {
  // Two pebbles in a row, radii 2 and 1: the grain passes a square opening of 4, the thickness of the large one.
  SpecimenSettings s = gravel_of({"sphere", "pair"});
  s.clump_templates = {{"pair", {{{0, 0, 0}, 2.0}, {{2.5, 0, 0}, 1.0}}}};
  EXPECT_NEAR(slit_sizes(s, 1610, 1150).passes, 4e-3, 1e-6);
  EXPECT_NEAR(slit_sizes(s, 1610, 1150).enters, 2e-3, 1e-6);
  // Three equal ones in a triangle: the opening is wider than a pebble, the slit is not.
  s.clump_templates = {{"pair", {{{0, 0, 0}, 1.0}, {{1.2, 0, 0}, 1.0}, {{0.6, 1.0, 0}, 1.0}}}};
  const SlitSizes flat = slit_sizes(s, 1610, 1150);
  EXPECT_LT(flat.passes, 3.5e-3);
  EXPECT_EQ(flat.passes, flat.enters);
  EXPECT_NE(flat.grain.find("pair"), std::string::npos) << flat.grain;
}

TEST(SlitSizes, RubberPassesAtItsSizeAndLetsBallsInBefore) {
  SpecimenSettings s;
  s.rubber_content = 1.0;
  s.rubber_grading = {{3.6e-3, 0.0}, {3.8e-3, 1.0}};
  const SlitSizes sizes = slit_sizes(s, 1610, 1150);
  EXPECT_EQ(sizes.passes, 3.6e-3);
  EXPECT_NEAR(sizes.enters, 2 * 3.6e-3 / 5.899, 1e-6);
  // In a mixture the smaller of both counts, and gravel that is not there does not.
  s.rubber_content = 0.5;
  s.gravel_grading = {{3.0e-3, 0.0}, {8e-3, 1.0}};
  s.clump_shapes = {"sphere"};
  EXPECT_NEAR(slit_sizes(s, 1610, 1150).passes, 3.0e-3, 1e-9);
  s.rubber_content = 1.0;
  EXPECT_EQ(slit_sizes(s, 1610, 1150).passes, 3.6e-3);
  EXPECT_TRUE(std::isinf(slit_sizes({}, 1610, 1150).passes));
}

}  // namespace
}  // namespace dem
