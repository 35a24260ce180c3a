// SPDX-License-Identifier: BSD-3-Clause
// Networks drawn from known distributions: what was put in must come out within four standard errors.
//
// Standard errors: both parts of a have sqrt(2/N). A mean force over a bin of N E w contacts whose forces scatter with the
// standard deviation f(theta) (exponential) has the variance f^2 / (N E w); the k-th harmonic over the mean then has
//     SE^2 = (1/N) int (f^2 / (f_0^2 E)) g^2 dtheta,   g = cos k u / pi - A / (2 pi)   (amplitude A, u = theta - theta_k)
//                                                      g = sin k u / (pi k A)         (direction)
// by the rule for small errors. Not tested here: networks in which contacts of one grain depend on each other.
#include <gtest/gtest.h>

#include <vector>

#include "dem4grm/micro/bootstrap.hpp"
#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/force_anisotropy.hpp"
#include "support/contact_builder.hpp"

namespace dem {
namespace {

using test::apart;
using test::k_degree;

constexpr double k_pi = std::numbers::pi;

struct Truth {
  double a = 0.3, theta_a = 60 * k_degree;
  double a_n = 0.5, theta_n = 75 * k_degree;
  double a_t = 0.4, theta_t = 20 * k_degree;

  [[nodiscard]] double density(double angle) const { return (1.0 + a * std::cos(2 * (angle - theta_a))) / (2 * k_pi); }
  [[nodiscard]] double normal(double angle) const { return 2.0 * (1.0 + a_n * std::cos(2 * (angle - theta_n))); }
  [[nodiscard]] double shear(double angle) const { return 0.7 * (1.0 + a_t * std::cos(4 * (angle - theta_t))); }
};

/// Samples of n contacts, made in parts to save memory.
std::vector<PolarSample> draw(const Truth& truth, int n, std::uint64_t seed) {
  constexpr int k_part = 50000;
  std::vector<PolarSample> samples;
  for (int part = 0; part * k_part < n; ++part) {
    RandomSequence random(seed, RandomStream::test, static_cast<std::uint64_t>(part));
    std::vector<Contact> contacts;
    for (int k = 0; k < std::min(k_part, n - part * k_part); ++k) {
      const double angle = test::random_angle(random, truth.a, truth.theta_a);
      const double normal = truth.normal(angle) * test::exponential(random);
      contacts.push_back(test::plane_contact(angle, normal, truth.shear(angle) * test::exponential(random)));
    }
    const std::vector<PolarSample> more = polar_samples(contacts, {});
    samples.insert(samples.end(), more.begin(), more.end());
  }
  return samples;
}

/// The integral of the head by the midpoint rule; f and E over their means.
template <class Weight>
double standard_error(const Truth& truth, int n, double amplitude, double direction, int k, const Weight& weight) {
  constexpr int k_points = 720;
  double sum = 0.0;
  for (int p = 0; p < k_points; ++p) {
    const double angle = 2 * k_pi * (p + 0.5) / k_points, u = k * (angle - direction);
    const double force = 1.0 + amplitude * std::cos(u);
    sum += force * force / truth.density(angle) * weight(u) * weight(u) * (2 * k_pi / k_points);
  }
  return std::sqrt(sum / n);
}

void expect_found(const ForceAnisotropy& found, const Truth& truth, int n, double amplitude, double direction, int k) {
  const double of_amplitude = standard_error(truth, n, amplitude, direction, k,
                                             [&](double u) { return std::cos(u) / k_pi - amplitude / (2 * k_pi); });
  const double of_direction =
      standard_error(truth, n, amplitude, direction, k, [&](double u) { return std::sin(u) / (k_pi * k * amplitude); });
  EXPECT_NEAR(found.fit.amplitude, amplitude, 4 * of_amplitude);
  EXPECT_LT(apart(found.fit.direction, direction, 2 * k_pi / k), 4 * of_direction);
  EXPECT_EQ(found.fit.empty_bins, 0);
}

TEST(SyntheticNetwork, EverythingThatWasPutInIsFoundForAnyBinAndRotation) {
  for (const int n : {1000000, 10000}) {
    for (const double turn : {0.0, 37.0, 101.0, 160.0}) {
      Truth truth;
      for (double* angle : {&truth.theta_a, &truth.theta_n, &truth.theta_t}) *angle += turn * k_degree;
      const std::vector<PolarSample> samples = draw(truth, n, 1 + static_cast<std::uint64_t>(turn));
      for (const int bins : {18, 24, 36, 72}) {
        SCOPED_TRACE(testing::Message() << n << " contacts, turned by " << turn << ", " << bins << " bins");
        const PolarHistogram histogram = polar_histogram(samples, bins);
        const HarmonicFit fabric = fabric_anisotropy(histogram);
        EXPECT_NEAR(fabric.amplitude, truth.a, 4 * std::sqrt(2.0 / n));
        EXPECT_LT(apart(fabric.direction, truth.theta_a, k_pi), 4 * direction_error(n, truth.a));
        EXPECT_NEAR(fabric.mean, 1 / (2 * k_pi), 1e-12);
        expect_found(normal_force_anisotropy(histogram), truth, n, truth.a_n, truth.theta_n, 2);
        expect_found(shear_force_anisotropy(histogram), truth, n, truth.a_t, truth.theta_t, 4);
      }
    }
  }
}

TEST(SyntheticNetwork, BinsAreDividedOut) {
  // Without scatter the k-th harmonic of bins is that of the curve times sin(kw/2)/(kw/2): exact values of the bin
  // means of 1 + cos k(theta - t), k = 2 and 4, give back amplitude 1. Widest bins: a factor of 0.98 and 0.92 would be left.
  for (const int bins : {18, 36, 180}) {
    const double w = 2 * k_pi / bins;
    for (const int k : {2, 4}) {
      std::vector<double> means;
      for (int b = 0; b < bins / 2; ++b) {
        const auto integral = [&](double at) { return at + std::sin(k * (at - 0.3)) / k; };
        means.push_back((integral((b + 1) * w) - integral(b * w)) / w);
      }
      const HarmonicFit fit = fit_harmonic(means, {}, bins, k);
      EXPECT_NEAR(fit.amplitude, 1.0, 1e-13);
      EXPECT_NEAR(fit.direction, 0.3, 1e-13);
      EXPECT_NEAR(fit.residual, 0.0, 1e-13);
      // A gap changes nothing, as the rest still lies on the curve.
      std::vector<unsigned char> has_value(means.size(), 1);
      has_value[2] = has_value[5] = 0;
      means[2] = means[5] = 0.0;
      const HarmonicFit with_gap = fit_harmonic(means, has_value, bins, k);
      EXPECT_NEAR(with_gap.amplitude, 1.0, 1e-12);
      EXPECT_NEAR(with_gap.direction, 0.3, 1e-12);
      EXPECT_EQ(with_gap.empty_bins, 2);
    }
  }
}

TEST(SyntheticNetwork, TwoMeansDifferByTheProductOfTheAnisotropies) {
  // <f_n> over contacts = int E f_n = f_n0 {1 + (a a_n / 2) cos 2(theta_a - theta_n)}.
  const Truth truth;
  const int n = 1000000;
  const ForceAnisotropy normal = normal_force_anisotropy(polar_histogram(draw(truth, n, 5), 72));
  const double factor = 1.0 + 0.5 * truth.a * truth.a_n * std::cos(2 * (truth.theta_a - truth.theta_n));
  EXPECT_NEAR(factor, 1.0649519, 1e-7);
  EXPECT_NEAR(normal.mean_over_orientations(), 2.0, 4 * 2.0 * 1.2 / std::sqrt(n));
  EXPECT_NEAR(normal.mean_over_contacts / normal.mean_over_orientations(), factor, 4 * 1.2 / std::sqrt(n));
  EXPECT_NEAR(normal.amplitude(ForceMean::contacts) * factor, truth.a_n, 0.01);
}

TEST(SyntheticNetwork, IsotropicNormalsInSpaceStayInsideTheNoise) {
  int over_three = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomSequence random(seed, RandomStream::test, 7);
    const int n = 20000;
    std::vector<Contact> contacts;
    for (int k = 0; k < n; ++k) {
      Contact c = test::plane_contact(0.0, 1.0, 0.0);
      const Frame f = frame_of(random.orientation());
      c.normal = f.e1;
      contacts.push_back(c);
    }
    const PolarHistogram histogram = polar_histogram(polar_samples(contacts, {}), 36);
    const double a = fabric_anisotropy(histogram).amplitude;
    EXPECT_LT(a, isotropy_bound(n)) << "seed " << seed;
    over_three += a > 3.0 / std::sqrt(0.5 * n) ? 1 : 0;  // probability exp(-4.5) = 1 %
    EXPECT_LT(projected_fabric(fabric_tensor(contacts)).amplitude, 4 * std::sqrt(2.5 / n));
    const auto near_plane = polar_samples(contacts, {.projection = Projection::near_plane});
    EXPECT_NEAR(static_cast<double>(near_plane.size()) / n, 0.5, 4 * 0.5 / std::sqrt(n));  // n_y is uniform
  }
  EXPECT_LE(over_three, 2);
  // P(a > x) = exp(-N x^2 / 4) is 3e-4 there.
  EXPECT_NEAR(std::exp(-0.25 * 1000 * std::pow(isotropy_bound(1000), 2)), std::exp(-8.0), 1e-12);
}

TEST(SyntheticNetwork, TensorInSpaceGivesTheAmplitudeInThePlane) {
  // Density (1/4pi)(1 + a_xx n_x^2 + a_zz n_z^2 + a_yy n_y^2), a = diag(-0.3, -0.3, 0.6): in the plane
  // (2/3)(a_zz - a_xx)/2 = 0.3 at 90 degrees, by integration over n_y.
  RandomSequence random(11, RandomStream::test, 0);
  std::vector<Contact> contacts;
  const int n = 200000;
  while (contacts.size() < static_cast<std::size_t>(n)) {
    Contact c = test::plane_contact(0.0, 1.0, 0.0);
    c.normal = frame_of(random.orientation()).e1;
    const Vec3& m = c.normal;
    const double density = 1.0 - 0.3 * (m.x * m.x + m.y * m.y) + 0.6 * m.z * m.z;
    if (random.uniform(0.0, 1.6) < density) contacts.push_back(c);
  }
  const ProjectedFabric spatial = projected_fabric(fabric_tensor(contacts));
  const HarmonicFit plane = fabric_anisotropy(polar_histogram(polar_samples(contacts, {}), 36));
  EXPECT_NEAR(spatial.amplitude, 0.3, 4 * std::sqrt(2.5 / n));
  EXPECT_NEAR(plane.amplitude, 0.3, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(spatial.direction, 90 * k_degree, 4 * direction_error(n, 0.3) * 1.2);
  EXPECT_NEAR(plane.direction, 90 * k_degree, 4 * direction_error(n, 0.3));
}

TEST(SyntheticNetwork, FullFrictionGivesTwoThirds) {
  // |sin 2u| = 2/pi - (4/3pi) cos 4u - ...: amplitude 2/3, largest at u = 45 degrees.
  RandomSequence random(3, RandomStream::test, 0);
  const int n = 400000;
  const double zero = 17 * k_degree;
  std::vector<Contact> contacts;
  for (int k = 0; k < n; ++k) {
    const double angle = random.uniform(0.0, 2 * k_pi);
    contacts.push_back(
        test::plane_contact(angle, 1.0, std::fabs(std::sin(2 * (angle - zero))) * test::exponential(random)));
  }
  for (const int bins : {24, 36, 72}) {
    const ForceAnisotropy shear = shear_force_anisotropy(polar_histogram(polar_samples(contacts, {}), bins));
    // <f^2> = 1/2, the mean 2/pi: SE of the amplitude below sqrt(2/N) sqrt(1/2) / (2/pi) = 1.11 sqrt(2/N).
    const double error = 1.11 * std::sqrt(2.0 / n);
    EXPECT_NEAR(shear.fit.amplitude, 2.0 / 3.0, 4 * error) << bins;
    EXPECT_LT(apart(shear.fit.direction, zero + 45 * k_degree, 0.5 * k_pi), 4 * error / (4 * 2.0 / 3.0)) << bins;
    EXPECT_NEAR(shear.mean_over_orientations(), 2 / k_pi, 4 * std::sqrt(0.5 / n));
  }
}

TEST(Bootstrap, BandIsAsWideAsTheStandardErrorAndTheSameEveryTime) {
  const Truth truth;
  const int n = 4000;
  const std::vector<PolarSample> samples = draw(truth, n, 9);
  MicroOptions options;
  options.resamples = 400;
  const AnisotropyBands bands = bootstrap_bands(samples, options, 0);
  const double width = 2 * 1.96 * std::sqrt(2.0 / n);
  // The end of a band of 400 resamples is known to about a tenth of its width.
  EXPECT_NEAR((bands.fabric_amplitude.high - bands.fabric_amplitude.low) / width, 1.0, 0.15);
  EXPECT_NEAR((bands.fabric_direction.high - bands.fabric_direction.low) / (width / (2 * truth.a)), 1.0, 0.2);
  EXPECT_LT(bands.normal_direction.low, truth.theta_n);
  EXPECT_GT(bands.normal_direction.high, truth.theta_n);
  EXPECT_LT(bands.shear_amplitude.low, bands.shear_amplitude.high);
  const AnisotropyBands again = bootstrap_bands(samples, options, 0);
  EXPECT_EQ(again.normal_amplitude.low, bands.normal_amplitude.low);
  EXPECT_EQ(again.shear_direction.high, bands.shear_direction.high);
  options.seed = 2;
  EXPECT_NE(bootstrap_bands(samples, options, 0).normal_amplitude.low, bands.normal_amplitude.low);
  options.resamples = 0;
  EXPECT_TRUE(std::isnan(bootstrap_bands(samples, options, 0).normal_amplitude.low));
}

}  // namespace
}  // namespace dem
