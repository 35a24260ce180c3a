// SPDX-License-Identifier: BSD-3-Clause
// How even a specimen is: solid in cells and layers against closed forms, fabric against planted distributions, overlaps
// against constructed ones.
// Not tested here: the numbers of a real specimen (tests/lab/direct_shear_test.cpp has their way into the summary).
#include "dem4grm/micro/homogeneity.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/grains/rubber_size.hpp"

namespace dem {
namespace {

double sphere(double radius) { return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius; }

void add_clump(Packing& packing, const std::vector<Pebble>& pebbles) {
  const int body = packing.body.empty() ? 0 : packing.body.back() + 1;
  for (const Pebble& p : pebbles) {
    packing.position.push_back(p.position);
    packing.radius.push_back(p.radius);
    packing.body.push_back(body);
  }
}

void add_rubber_grain(Packing& packing, const Vec3& centre, double ball_radius) {
  for (int slot = 0; slot < k_grain_balls; ++slot) {
    packing.position.push_back(centre + grain_site(slot) * (k_grain_lattice * ball_radius));
    packing.radius.push_back(ball_radius);
    packing.body.push_back(packing.n_rubber_grains);
  }
  ++packing.n_rubber_grains;
}

/// Place k of a cubic grid of n x n columns, in units of its edge.
Vec3 at(int k, int n, double first) {
  const int x = k % n, y = k / n % n, z = k / (n * n);
  return {x + first, y + first, z + first};
}

const Bounds k_box{{0, 0, 0}, {40e-3, 40e-3, 40e-3}};  // two cells of 20 mm along each axis for a mean size of 5 mm

double sum_of(const SolidDistribution& solid, double Cell::*part) {
  double sum = 0.0;
  for (const Cell& cell : solid.cells) sum += cell.*part;
  return sum;
}

TEST(SolidDistribution, ASphereOnTheBordersOfCellsIsCutIntoItsCaps) {
  Packing packing;
  const double r = 3e-3, past = 1e-3;  // the centre lies 1 mm beyond the borders along z and along x
  add_clump(packing, {{{20e-3 + past, 9e-3, 20e-3}, r}});
  add_clump(packing, {{{9e-3, 9e-3, 20e-3 - past}, r}});
  const SolidDistribution solid = solid_distribution(packing, k_box, 5e-3, 1.4);
  EXPECT_EQ(solid.counts, (std::array<int, 3>{2, 2, 2}));
  const double cap = std::numbers::pi * (r - past) * (r - past) * (3 * r - (r - past)) / 3.0;  // pi h^2 (3 R - h) / 3
  const auto gravel = [&](std::size_t x, std::size_t y, std::size_t z) {
    return solid.cells[(z * 2 + y) * 2 + x].gravel;
  };
  EXPECT_NEAR(gravel(1, 0, 0), 0.5 * (sphere(r) - cap), 0.01 * sphere(r));
  EXPECT_NEAR(gravel(1, 0, 0), gravel(1, 0, 1), 1e-9 * sphere(r));
  EXPECT_NEAR(gravel(0, 0, 1), cap + 0.5 * cap, 0.01 * sphere(r));
  EXPECT_NEAR(gravel(0, 0, 0), sphere(r) - cap + 0.5 * cap, 0.015 * sphere(r));
  EXPECT_EQ(gravel(0, 1, 0), 0.0);
  EXPECT_NEAR(sum_of(solid, &Cell::gravel), 2 * sphere(r), 0.01 * sphere(r));
  EXPECT_NEAR(sum_of(solid, &Cell::volume), 64e-6, 1e-15);
}

TEST(SolidDistribution, TheOverlapOfPebblesCountsOnceAndThatOfGrainsTwice) {
  const double r = 3e-3, c = 2e-3;
  const double both =
      8.0 / 3.0 * std::numbers::pi * r * r * r - std::numbers::pi / 12.0 * (4 * r + c) * (2 * r - c) * (2 * r - c);
  Packing one, two;
  add_clump(one, {{{10e-3, 10e-3, 10e-3}, r}, {{10e-3, 10e-3, 10e-3 + c}, r}});
  add_clump(two, {{{10e-3, 10e-3, 10e-3}, r}});
  add_clump(two, {{{10e-3, 10e-3, 10e-3 + c}, r}});
  EXPECT_NEAR(sum_of(solid_distribution(one, k_box, 5e-3, 1.0), &Cell::gravel), both, 0.01 * both);
  EXPECT_NEAR(sum_of(solid_distribution(two, k_box, 5e-3, 1.0), &Cell::gravel), 2 * sphere(r), 0.01 * both);
}

TEST(SolidDistribution, FullSizeRubberAddsUpToItsSolidVolume) {
  Packing packing;
  const double r = 0.627e-3, fill = 1610.0 / 1150.0;
  for (int k = 0; k < 5808; ++k) {
    add_rubber_grain(packing, at(k, 22, 0.55) * 4.53e-3, r);
  }
  const Bounds room{{0, 0, 0}, {0.1, 0.1, 0.055}};
  const SolidDistribution solid = solid_distribution(packing, room, 3.7e-3, fill);
  EXPECT_EQ(solid.counts, (std::array<int, 3>{6, 6, 3}));
  EXPECT_NEAR(sum_of(solid, &Cell::rubber) / (5808 * rubber_solid_volume(r, 1610.0, 1150.0)), 1.0, 1e-3);
}

TEST(SolidDistribution, RoomAndSizeMustBePositive) {
  Packing packing;
  add_clump(packing, {{{0, 0, 0}, 1e-3}});
  EXPECT_THROW(solid_distribution(packing, {{0, 0, 0}, {1, 1, 0}}, 1e-3, 1.0), InputError);
  EXPECT_THROW(solid_distribution(packing, k_box, 0.0, 1.0), InputError);
}

/// n grains in the middle of one half of the box, by x.
void fill_half(Packing& packing, double x, int n) {
  for (int k = 0; k < n; ++k) add_clump(packing, {{{x, 10e-3, 6e-3 + 7e-3 * k}, 3e-3}});
}

TEST(Homogeneity, ScatterOfTwoCellsByHand) {
  const Bounds room{{0, 0, 0}, {40e-3, 20e-3, 30e-3}};  // 2 x 1 x 1 cells of 20 x 20 x 30 mm
  Packing packing;
  // Rubber grains come first: two in the left cell, none in the right one.
  add_rubber_grain(packing, {4e-3, 5e-3, 5e-3}, 0.6e-3);
  add_rubber_grain(packing, {4e-3, 5e-3, 15e-3}, 0.6e-3);
  fill_half(packing, 12e-3, 3);
  fill_half(packing, 30e-3, 2);
  const Homogeneity found = measure_homogeneity(packing, {}, room, 5e-3, 1.4);
  const double cell = 12e-6, rubber = 2 * 35 * sphere(0.6e-3) * 1.4, left = rubber + 3 * sphere(3e-3);
  const double right = 2 * sphere(3e-3);
  EXPECT_EQ(found.cells, 2);
  // The standard deviation of two values is their difference over the root of two.
  EXPECT_NEAR(found.void_ratio_scatter / (std::abs(cell / left - cell / right) / std::sqrt(2.0)), 1.0, 0.02);
  EXPECT_NEAR(found.rubber_content_scatter, rubber / left / std::sqrt(2.0), 0.005);
  EXPECT_TRUE(std::isnan(measure_homogeneity(packing, {}, room, 50e-3, 1.4).void_ratio_scatter));  // one cell
}

/// Touching spheres of radius 2.5 mm on a square lattice that fills a box of 50 x 50 x 50 mm; moved sideways by up to
/// 0.15 mm, since columns that meet every sphere alike would make the same error a thousand times.
Packing square_lattice() {
  Packing packing;
  RandomSequence random(3, RandomStream::test, 0);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 aside{random.uniform(-0.15e-3, 0.15e-3), random.uniform(-0.15e-3, 0.15e-3), 0.0};
    add_clump(packing, {{at(k, 10, 0.5) * 5e-3 + aside, 2.5e-3}});
  }
  return packing;
}

TEST(Homogeneity, LayersOfALatticeHaveTheirClosedForm) {
  const Bounds room{{0, 0, 0}, {50e-3, 50e-3, 50e-3}};
  const Homogeneity found = measure_homogeneity(square_lattice(), {}, room, 5e-3, 1.4);
  // The fraction of a layer goes as 1 - u^2, u from -1 to 1 through a sphere; of eight layers each holds the mean over a
  // quarter of u, and all eight together 2/3.
  double square = 0.0;
  for (int k = 0; k < 8; ++k) {
    const double a = -1.0 + 0.25 * k, b = a + 0.25;
    const double mean = 1.0 - (b * b * b - a * a * a) / (3.0 * (b - a));
    square += (1.5 * mean - 1.0) * (1.5 * mean - 1.0) / 8.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.433, 0.005);  // 0.447 = sqrt(6/5 - 1) for endlessly thin layers
  EXPECT_NEAR(found.layering_at_plates, std::sqrt(square), 0.003);
  EXPECT_NEAR(found.layering_at_sides, std::sqrt(square), 0.02);
  const double void_ratio = 6.0 / std::numbers::pi - 1.0;
  EXPECT_NEAR(found.void_ratio_inside, void_ratio, 0.005);
  EXPECT_NEAR(found.void_ratio_at_plates, void_ratio, 0.005);  // half a layer of spheres is as dense as a whole one
  EXPECT_NEAR(found.void_ratio_at_sides, void_ratio, 0.03);
  EXPECT_LT(found.void_ratio_scatter, 0.005);
  EXPECT_EQ(found.rubber_content_scatter, 0.0);
}

TEST(Homogeneity, AGapAtThePlatesShowsThereAndNowhereElse) {
  const Bounds room{{0, 0, -1.25e-3}, {50e-3, 50e-3, 51.25e-3}};
  const Homogeneity found = measure_homogeneity(square_lattice(), {}, room, 5e-3, 1.4);
  // Of the 2.5 mm at a plate half is empty, the other half is a cap of height R / 2 of each sphere: 5/32 of the sphere.
  const double at_plates = 5.0 / 32.0 * sphere(2.5e-3) / (25e-6 * 2.5e-3);
  EXPECT_NEAR(found.void_ratio_at_plates * at_plates, 1.0 - at_plates, 0.005);
  // Inside are 37.5 mm: seven whole layers (mean 2/3 of pi/4) and the middle half of an eighth one (mean 11/12).
  const double inside = std::numbers::pi / 4.0 * (35.0 * 2.0 / 3.0 + 2.5 * 11.0 / 12.0) / 37.5;
  EXPECT_NEAR(found.void_ratio_inside, 1.0 / inside - 1.0, 0.005);
}

/// Directions with the density 1 + a_ij n_i n_j, a diagonal of sum 0, by rejection; turned about y by an angle.
std::vector<Vec3> planted_normals(const Vec3& a, double angle, int count) {
  std::vector<Vec3> normals;
  RandomSequence random(11, RandomStream::test, 0);
  while (static_cast<int>(normals.size()) < count) {
    const Vec3 v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double length = norm(v);
    if (length > 1.0 || length < 0.01) continue;
    const Vec3 n = v * (1.0 / length);
    if (random.uniform(0, 2) > 1.0 + a.x * n.x * n.x + a.y * n.y * n.y + a.z * n.z * n.z) continue;
    const double c = std::cos(angle), s = std::sin(angle);
    normals.push_back({c * n.x - s * n.z, n.y, s * n.x + c * n.z});
  }
  return normals;
}

TEST(Fabric, PlantedAnisotropyIsFound) {
  const Vec3 a{-0.3, -0.2, 0.5};
  for (const double angle : {0.0, 0.4}) {
    const FabricMeasure found = measure_fabric(planted_normals(a, angle, 400000));
    // <n n> = 1/3 + (2/15) a for a traceless a.
    EXPECT_NEAR(found.deviator, std::sqrt(1.5 * (0.09 + 0.04 + 0.25)) * 2.0 / 15.0, 0.004);
    EXPECT_EQ(found.contacts, 400000);
  }
}

TEST(Fabric, IsotropicSetsStayBelowTheNoiseNinetyNineTimesInAHundred) {
  const std::vector<Vec3> normals = planted_normals({}, 0.0, 400000);
  int above_deviator = 0;
  constexpr std::size_t k_sets = 1000, k_of_set = 400;
  for (std::size_t k = 0; k < k_sets; ++k) {
    const FabricMeasure found = measure_fabric({normals.data() + k * k_of_set, k_of_set});
    above_deviator += found.deviator > found.deviator_noise ? 1 : 0;
  }
  // exp(-4.5) = 1.1 % of 1000: 11 with a standard deviation of 3.3.
  EXPECT_NEAR(above_deviator, 11, 13);
  EXPECT_GT(above_deviator, 0);
}

TEST(Fabric, ParallelNormalsAreTheLargestAnisotropy) {
  const std::vector<Vec3> up(10, Vec3{0, 0, 1}), across(10, Vec3{0, 1, 0});
  EXPECT_NEAR(measure_fabric(up).deviator, 1.0, 1e-12);
  EXPECT_EQ(measure_fabric({}).contacts, 0);
}

TEST(Overlaps, TheLargestAndTheCaught) {
  Packing packing;
  add_rubber_grain(packing, {30e-3, 0, 0}, 0.6e-3);  // its own balls do not count, though they touch
  add_clump(packing, {{{0, 0, 0}, 2e-3}, {{1e-3, 0, 0}, 2e-3}});
  add_clump(packing, {{{0, 3.9e-3, 0}, 2e-3}});  // 0.1 mm into the first: 0.05
  add_clump(packing, {{{0, 0, 2.7e-3}, 1e-3}});  // 0.3 mm: 0.3 of the smaller radius
  const OverlapMeasure before = measure_overlaps(packing);
  EXPECT_NEAR(before.largest, 0.3, 1e-9);
  EXPECT_EQ(before.caught, 0);
  add_clump(packing, {{{-1.9e-3, 0, 0}, 0.5e-3}});  // its centre inside pebble 1 of the first clump only
  const OverlapMeasure after = measure_overlaps(packing);
  EXPECT_EQ(after.caught, 1);
  EXPECT_NEAR(after.largest, 0.6 / 0.5, 1e-9);
}

}  // namespace
}  // namespace dem
