// SPDX-License-Identifier: BSD-3-Clause
// The band of displacements that were drawn from a known profile.
#include "dem4grm/micro/shear_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dem4grm/core/random.hpp"

namespace dem {
namespace {

constexpr double k_specimen_height = 53e-3;

struct BandTruth {
  double centre = 24e-3, thickness = 15e-3, below = 8e-3, slip = -7e-3;

  [[nodiscard]] double at(double z) const {
    const double s = thickness / std::sqrt(2.0 * std::numbers::pi);
    return below + slip * 0.5 * std::erfc(-(z - centre) / s / std::numbers::sqrt2);
  }
};

/// n grains at random heights and widths, each off its profile by a normal deviate (m).
std::vector<BandSample> draw(const BandTruth& truth, int n, double scatter, std::uint64_t seed) {
  RandomSequence random(seed, RandomStream::test, 0);
  std::vector<BandSample> grains;
  for (int k = 0; k < n; ++k) {
    const double z = random.uniform(0.0, k_specimen_height);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
    const double off = scatter * radius * std::cos(2.0 * std::numbers::pi * random.uniform());
    grains.push_back({z, truth.at(z) + off, static_cast<int>(random.uniform() * k_band_slices)});
  }
  return grains;
}

TEST(ShearBand, OfAnExactProfileIsFoundWhateverItsPlaceAndWidth) {
  for (const double centre : {15e-3, 26.5e-3, 40e-3}) {
    for (const double thickness : {4e-3, 15e-3, 30e-3}) {
      for (const double slip : {-7e-3, 3e-3}) {
        const BandTruth truth{centre, thickness, 8e-3, slip};
        const ShearBand band = fit_shear_band(draw(truth, 2000, 0.0, 1), k_specimen_height, 1e-4);
        EXPECT_NEAR(band.centre, centre, 1e-7);
        EXPECT_NEAR(band.thickness, thickness, 1e-6);
        EXPECT_NEAR(band.slip, slip, 1e-7);
        EXPECT_NEAR(band.displacement_below, 8e-3, 1e-7);
        EXPECT_LT(band.scatter, 1e-8);
        EXPECT_LT(band.thickness_error, 1e-6);
      }
    }
  }
}

TEST(ShearBand, ThicknessIsThatOfEvenShearWithTheSteepestSlope) {
  const BandTruth truth;
  const double steepest = (truth.at(truth.centre + 1e-6) - truth.at(truth.centre - 1e-6)) / 2e-6;
  EXPECT_NEAR(truth.thickness, std::fabs(truth.slip / steepest), 1e-6 * truth.thickness);
}

TEST(ShearBand, ErrorsAreThoseThatRepetitionShows) {
  // Forty draws: the values scatter by the standard error that a single draw tells, and lie around the truth.
  const BandTruth truth;
  constexpr int k_draws = 40;
  double mean = 0.0, square = 0.0, told = 0.0, centre_square = 0.0, centre_told = 0.0;
  for (int k = 0; k < k_draws; ++k) {
    const ShearBand band =
        fit_shear_band(draw(truth, 800, 1e-3, static_cast<std::uint64_t>(k + 2)), k_specimen_height, 1e-4);
    mean += band.thickness / k_draws;
    square += (band.thickness - truth.thickness) * (band.thickness - truth.thickness) / k_draws;
    told += band.thickness_error * band.thickness_error / k_draws;
    centre_square += (band.centre - truth.centre) * (band.centre - truth.centre) / k_draws;
    centre_told += band.centre_error * band.centre_error / k_draws;
    EXPECT_NEAR(band.scatter, 1e-3, 0.1e-3);
  }
  EXPECT_NEAR(mean, truth.thickness, 4.0 * std::sqrt(told / k_draws));
  // A standard deviation of forty is itself known to a ninth; of eight slices to a quarter.
  EXPECT_NEAR(std::sqrt(square / told), 1.0, 0.5);
  EXPECT_NEAR(std::sqrt(centre_square / centre_told), 1.0, 0.5);
}

TEST(ShearBand, IsNoNumberWithoutAStep) {
  const BandTruth still{24e-3, 15e-3, 8e-3, 0.0};
  EXPECT_TRUE(std::isnan(fit_shear_band(draw(still, 500, 0.0, 1), k_specimen_height, 1e-6).thickness));
  EXPECT_TRUE(std::isnan(fit_shear_band(draw(BandTruth{}, 5, 0.0, 1), k_specimen_height, 1e-6).thickness));
  EXPECT_TRUE(std::isnan(fit_shear_band({}, k_specimen_height, 1e-6).thickness));
}

}  // namespace
}  // namespace dem
