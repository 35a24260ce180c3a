// SPDX-License-Identifier: BSD-3-Clause
// What a ball centre sees of a rectangle, and the geometry of the shear box: plain space geometry by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dem4grm/walls/shear_box.hpp"
#include "dem4grm/walls/wall.hpp"

namespace {

using namespace dem;

const Wall& tilted() {
  // Sides of 5 along (3,4,0)/5 and 2 along z: normal (4,-3,0)/5.
  static const Wall w = make_wall("tilted", {1, 1, 1}, {3, 4, 0}, {0, 0, 2});
  return w;
}

void expect_vector(const Vec3& a, const Vec3& b) { EXPECT_LT(norm(a - b), 1e-14) << a.x << ' ' << a.y << ' ' << a.z; }

TEST(MakeWall, UnitVectorsAndRightHandedNormal) {
  expect_vector(tilted().u, {0.6, 0.8, 0});
  expect_vector(tilted().v, {0, 0, 1});
  expect_vector(tilted().normal, {0.8, -0.6, 0});
  EXPECT_DOUBLE_EQ(tilted().length_u, 5.0);
  EXPECT_DOUBLE_EQ(tilted().length_v, 2.0);
}

TEST(LookAt, FrontAndBackOfTheFace) {
  const Vec3 on = Vec3{1, 1, 1} + tilted().u * 2.0 + tilted().v * 0.5;
  for (const double h : {0.7, -0.3}) {
    const WallView view = look_at(tilted(), on + tilted().normal * h);
    EXPECT_TRUE(view.on_face);
    EXPECT_NEAR(view.distance, h, 1e-14);  // signed
    expect_vector(view.nearest, on);
    expect_vector(view.away, tilted().normal);
  }
}

TEST(LookAt, EdgesAndCorners) {
  // 3 along u beyond the far end and 4 above the plane: the edge, 5 away.
  const Vec3 end = Vec3{1, 1, 1} + tilted().u * 5.0 + tilted().v;
  const WallView edge = look_at(tilted(), end + tilted().u * 3.0 + tilted().normal * 4.0);
  EXPECT_FALSE(edge.on_face);
  EXPECT_NEAR(edge.distance, 5.0, 1e-14);
  expect_vector(edge.nearest, end);
  expect_vector(edge.away, tilted().u * 0.6 + tilted().normal * 0.8);
  const WallView corner = look_at(tilted(), Vec3{1, 1, 1} + tilted().u * -2.0 + tilted().v * -2.0 - tilted().normal);
  EXPECT_FALSE(corner.on_face);
  EXPECT_NEAR(corner.distance, 3.0, 1e-14);  // positive even behind the plane
  expect_vector(corner.nearest, {1, 1, 1});
  const WallView at = look_at(tilted(), Vec3{1, 1, 1} + tilted().v * 2.5 - tilted().v * 0.5);
  EXPECT_NEAR(at.distance, 0.0, 1e-14);
}

TEST(LiesOn, IncludesBordersWithinTheTolerance) {
  const Vec3 far_corner = Vec3{1, 1, 1} + tilted().u * 5.0 + tilted().v * 2.0;
  EXPECT_TRUE(lies_on(tilted(), far_corner, 1e-9));
  EXPECT_TRUE(lies_on(tilted(), far_corner + tilted().u * 0.9e-3, 1e-3));
  EXPECT_FALSE(lies_on(tilted(), far_corner + tilted().u * 1.1e-3, 1e-3));
  EXPECT_FALSE(lies_on(tilted(), far_corner - tilted().v * 2.002, 1e-3));
  EXPECT_FALSE(lies_on(tilted(), far_corner + tilted().normal * 1.1e-3, 1e-3));
  EXPECT_FALSE(lies_on(tilted(), far_corner - tilted().normal * 1.1e-3, 1e-3));
}

TEST(ShearBoxGeometry, WallsFaceInwardAndMeet) {
  const BoxSettings s;  // 100 x 100 x 53 mm, upper walls to 80 mm, wings of 20 mm
  const ShearBox box(s, 0.06);
  ASSERT_EQ(box.walls().size(), static_cast<std::size_t>(ShearBox::k_walls));
  EXPECT_NEAR(box.nominal_area(), 0.01, 1e-16);
  EXPECT_EQ(box.walls()[ShearBox::k_bottom_plate].name, "bottom plate");
  EXPECT_EQ(box.walls()[ShearBox::k_top_plate].name, "top plate");
  // Every wall but the wings has the middle of its half in front of it.
  for (int w = 0; w < ShearBox::k_walls; ++w) {
    const Wall& wall = box.walls()[static_cast<std::size_t>(w)];
    if (w == 5 || w == 11) continue;
    const bool lower = ShearBox::half_of(w) == BoxHalf::lower;
    EXPECT_GT(dot(Vec3{0.05, 0.05, lower ? 0.01 : 0.04} - wall.corner, wall.normal), 0.0) << wall.name;
    EXPECT_EQ(wall.friction, 0.0);
    EXPECT_EQ(lower, w < 6);
  }
  // The halves meet at 26.5 mm. Behind the lower half's -x side lies its wing, facing up; the upper wing faces down.
  const Wall& lower_wing = box.walls()[5];
  const Wall& upper_wing = box.walls()[11];
  EXPECT_TRUE(lies_on(lower_wing, {-0.019, 0.05, 0.0265}, 1e-12));
  EXPECT_FALSE(lies_on(lower_wing, {-0.021, 0.05, 0.0265}, 1e-12));
  EXPECT_FALSE(lies_on(lower_wing, {0.001, 0.05, 0.0265}, 1e-12));
  expect_vector(lower_wing.normal, {0, 0, 1});
  EXPECT_TRUE(lies_on(upper_wing, {0.119, 0.05, 0.0265}, 1e-12));
  EXPECT_FALSE(lies_on(upper_wing, {0.099, 0.05, 0.0265}, 1e-12));
  expect_vector(upper_wing.normal, {0, 0, -1});
  EXPECT_TRUE(lies_on(box.walls()[ShearBox::k_top_plate], {0.1, 0.1, 0.06}, 1e-12));
  // Sides reach from the plate to the split and from the split to 80 mm.
  for (const Vec3& p : {Vec3{0, 0.05, 0.0}, Vec3{0, 0.05, 0.0265}}) EXPECT_TRUE(lies_on(box.walls()[1], p, 1e-12));
  for (const Vec3& p : {Vec3{0, 0.05, 0.0265}, Vec3{0, 0.05, 0.08}}) EXPECT_TRUE(lies_on(box.walls()[7], p, 1e-12));
}

TEST(ShearBoxGeometry, GapLiesHalfAndHalfAboutTheSplitPlane) {
  BoxSettings s;
  s.gap = 0.002;
  const ShearBox box(s, 0.06);
  EXPECT_NEAR(box.walls()[5].corner.z, 0.0255, 1e-15);
  EXPECT_NEAR(box.walls()[11].corner.z, 0.0275, 1e-15);
  EXPECT_NEAR(box.walls()[1].length_v, 0.0255, 1e-15);
  EXPECT_NEAR(box.walls()[7].corner.z, 0.0275, 1e-15);
}

TEST(ShearBoxGeometry, PartsAtAnyHeightAndKeepsWhatElseTheWallsHave) {
  BoxSettings s;
  s.gap = 0.002;
  ShearBox box(s, 0.06);
  box.walls()[ShearBox::k_top_plate].friction = 0.7;
  EXPECT_NEAR(ShearBox::split_height(box.walls()), 0.0265, 1e-15);
  ShearBox::part_at(box.walls(), s, 0.022);
  EXPECT_NEAR(ShearBox::split_height(box.walls()), 0.022, 1e-15);
  for (int w = 1; w <= 4; ++w) {
    const Wall &lower = box.walls()[static_cast<std::size_t>(w)], &upper = box.walls()[static_cast<std::size_t>(w + 6)];
    EXPECT_NEAR(lower.corner.z + std::max(dot(lower.u, {0, 0, lower.length_u}), dot(lower.v, {0, 0, lower.length_v})),
                0.021, 1e-15);
    EXPECT_NEAR(upper.corner.z, 0.023, 1e-15);
    EXPECT_NEAR(upper.corner.z + std::max(dot(upper.u, {0, 0, upper.length_u}), dot(upper.v, {0, 0, upper.length_v})),
                0.080, 1e-15);
  }
  EXPECT_NEAR(box.walls()[5].corner.z, 0.021, 1e-15);
  EXPECT_NEAR(box.walls()[11].corner.z, 0.023, 1e-15);
  EXPECT_EQ(box.walls()[ShearBox::k_top_plate].friction, 0.7);
  EXPECT_EQ(box.walls()[ShearBox::k_top_plate].corner.z, 0.06);
  EXPECT_EQ(box.walls()[1].name, "lower wall -x");
}

TEST(ShearBoxGeometry, RoomsFollowTheHalvesAndHoldTheGap) {
  BoxSettings s;
  s.gap = 0.002;
  ShearBox box(s, 0.06);
  for (std::size_t w = 0; w < 6; ++w) box.walls()[w].corner.x += 0.010;  // the lower half has moved by 10 mm
  const auto is_held = [&](const Vec3& p) {
    const auto [lower, upper] = ShearBox::rooms_of(box.walls());
    return is_inside(p, lower) || is_inside(p, upper);
  };
  for (const Vec3& p : {Vec3{0.011, 0.05, 0.01}, Vec3{0.109, 0.05, 0.01}, Vec3{0.001, 0.05, 0.04},
                        Vec3{0.099, 0.05, 0.059}, Vec3{0.001, 0.05, 0.0265}, Vec3{0.109, 0.05, 0.0265}}) {
    EXPECT_TRUE(is_held(p)) << p.x << " " << p.z;
  }
  // Through a wall of its half, through the plates, out through the gap at either end and at the sides.
  for (const Vec3& p :
       {Vec3{0.009, 0.05, 0.01}, Vec3{0.111, 0.05, 0.01}, Vec3{-0.001, 0.05, 0.04}, Vec3{0.101, 0.05, 0.04},
        Vec3{0.05, 0.05, 0.061}, Vec3{0.05, 0.05, -0.001}, Vec3{-0.001, 0.05, 0.0265}, Vec3{0.111, 0.05, 0.0265},
        Vec3{0.05, -0.001, 0.0265}, Vec3{0.05, 0.101, 0.0265}}) {
    EXPECT_FALSE(is_held(p)) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(ShearBoxMotion, OfEitherHalfOrBoth) {
  ShearBox box(BoxSettings{}, 0.06);
  const auto speeds = [&](MovingHalf moving) {
    ShearBox::set_velocities(box.walls(), moving, 0.002, -0.01);
    return std::pair{box.walls()[1].velocity.x, box.walls()[7].velocity.x};
  };
  EXPECT_EQ(speeds(MovingHalf::lower), (std::pair{0.002, 0.0}));
  EXPECT_EQ(speeds(MovingHalf::upper), (std::pair{0.0, -0.002}));
  EXPECT_EQ(speeds(MovingHalf::both), (std::pair{0.001, -0.001}));
  // The plate goes with the upper half and moves up and down by itself.
  EXPECT_EQ(box.walls()[ShearBox::k_top_plate].velocity.x, -0.001);
  EXPECT_EQ(box.walls()[ShearBox::k_top_plate].velocity.z, -0.01);
  EXPECT_EQ(box.walls()[ShearBox::k_bottom_plate].velocity.x, 0.001);
  EXPECT_EQ(box.walls()[11].velocity.z, 0.0);
}

}  // namespace
