// SPDX-License-Identifier: BSD-3-Clause
// Earth pressure at rest of a box whose wall forces are written down by hand.
#include "dem4grm/lab/before_shear.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mixture_scene.hpp"

namespace dem {
namespace {

TEST(LateralStress, IsForceOverAreaOfEachPairOfSidesOverThatOfThePlates) {
  const test::MixtureOptions options;
  const BoxSettings box = test::mixture_box(options);  // 7 by 5 cells, 4 high
  Simulation s(test::mixture_scene(options));
  const double height = s.walls[ShearBox::k_top_plate].corner.z;
  const double plate = box.length * box.width, end = box.width * height, side = box.length * height;
  const auto put = [&](int wall, const Vec3& force) { s.reactions.at(static_cast<std::size_t>(wall)).force = force; };
  constexpr int k_upper = ShearBox::k_top_plate;
  put(ShearBox::k_bottom_plate, {0, 0, -99e3 * plate});
  put(ShearBox::k_top_plate, {0, 0, 101e3 * plate});  // 100 kPa in the mean
  // Along x 50 and 30 kPa, each side in two parts and with forces along it that must not count.
  put(ShearBox::k_side_x_min, {-20e3 * end, 7.0, 5.0});
  put(ShearBox::k_side_x_min + k_upper, {-30e3 * end, 7.0, 5.0});
  put(ShearBox::k_side_x_max, {10e3 * end, 0, 0});
  put(ShearBox::k_side_x_max + k_upper, {20e3 * end, 0, 0});
  // Across 60 kPa.
  put(ShearBox::k_side_y_min, {3.0, -60e3 * side, 0});
  put(ShearBox::k_side_y_max + k_upper, {3.0, 60e3 * side, 0});
  const LateralStress k0 = measure_lateral_stress(s, box);
  EXPECT_NEAR(k0.k0_x, 0.40, 1e-12);
  EXPECT_NEAR(k0.k0_y, 0.60, 1e-12);
}

TEST(LateralStress, IsNoNumberWithoutLoad) {
  const test::MixtureOptions options;
  const Simulation s(test::mixture_scene(options));
  EXPECT_TRUE(std::isnan(measure_lateral_stress(s, test::mixture_box(options)).k0_x));
}

}  // namespace
}  // namespace dem
