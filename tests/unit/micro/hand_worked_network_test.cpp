// SPDX-License-Identifier: BSD-3-Clause
// Ten contacts whose every number was worked out on paper.
//
// Bins of 20 degrees: nine on the half circle, centres 10, 30, ... 170 degrees. One contact at each centre, at 90 degrees
// two. Over nine equal steps of 40 degrees (2 theta) or 80 degrees (4 theta) cosines and sines add up to nothing, so only
// what stands out in one bin is left of a sum.
//   contact   0    1    2    3    4     5    6    7    8    9
//   angle     10   30   50   70   90    90   110  130  150  170
//   f_n, N    10   1    1    1    0.5   1.5  1    1    1    1      sum 19, mean 1.9
//   |f_t|, N  .1   .1   1    .1   .1    .1   .1   .1   .1   .1     sum 1.9
//   kind      g-g  g-g  g-g  g-g  g-r   g-r  g-r  r-r  r-r  r-r
#include <gtest/gtest.h>

#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/micro/connectivity.hpp"
#include "dem4grm/micro/fabric.hpp"
#include "dem4grm/micro/stress_tensor.hpp"
#include "dem4grm/micro/strong_network.hpp"
#include "support/contact_builder.hpp"

namespace dem {
namespace {

using test::k_degree;

constexpr double k_tight = 1e-14;
constexpr double k_branch = 2e-3;                // m
constexpr double k_volume = 0.01 * 0.01 * 0.01;  // m3

/// Bodies 0 and 1 are gravel, 2 and 3 rubber; every branch is 2 mm along its normal.
MicroState ten_contacts() {
  const double angles[] = {10, 30, 50, 70, 90, 90, 110, 130, 150, 170};
  const double normal[] = {10, 1, 1, 1, 0.5, 1.5, 1, 1, 1, 1};
  MicroState state;
  for (int k = 0; k < 10; ++k) {
    Contact c = test::plane_contact(angles[k] * k_degree, normal[k], k == 2 ? 1.0 : 0.1);
    c.kind = k < 4 ? PairKind::gravel_gravel : k < 7 ? PairKind::gravel_rubber : PairKind::rubber_rubber;
    c.body_i = k < 7 ? 0 : 2;
    c.body_j = k < 4 ? 1 : k < 7 ? 2 : 3;
    c.ball_i = 10 + k;
    c.ball_j = 20 + k;
    c.branch = c.normal * k_branch;
    c.friction = 0.5;
    c.is_sliding = k == 2 || k == 9;
    state.network.contacts.push_back(c);
  }
  state.network.body_position.resize(4);
  state.network.body_material = {k_gravel, k_gravel, k_rubber, k_rubber};
  state.network.box = {0, 1, 1e-4, 1e-2};
  return state;
}

MicroAnalysis analysis_of_ten(MicroOptions options = {}) {
  options.bins = 18;
  return analyse(ten_contacts(), options);
}

TEST(HandWorkedNetwork, FabricOfTheExtraContact) {
  // E_b is 1/(2 N w) times 1, at 90 degrees times 2. Mean 10/9, C = (2/9)(1)(cos 180) = -2/9, S = 0:
  // amplitude (2/9)/(10/9) = 0.2 at 90 degrees, divided by sin(w)/w.
  const double w = 20 * k_degree;
  const SetNumbers all = analysis_of_ten().numbers.of_all();
  EXPECT_EQ(all.contacts, 10.0);
  EXPECT_NEAR(all.fabric_amplitude, 0.2 * w / std::sin(w), k_tight);
  EXPECT_NEAR(all.fabric_amplitude, 0.2041200538685748, 1e-15);
  EXPECT_NEAR(all.fabric_direction, 90 * k_degree, k_tight);
  // Sum of squares about the mean 8/9, of the harmonic (9/2)(2/9)^2 = 2/9: sqrt((6/9)/9) over 10/9 is sqrt(6)/10.
  EXPECT_NEAR(all.fabric_residual, std::sqrt(6.0) / 10, k_tight);
  EXPECT_NEAR(all.fabric_noise, 4 * std::sqrt(0.2), k_tight);
  // 2 pi E at 90 degrees: 2 pi * 2/(2 * 10 * pi/9) = 1.8.
  const std::vector<double> density = orientation_density(analysis_of_ten().histograms[0]);
  EXPECT_NEAR(2 * std::numbers::pi * density[4], 1.8, k_tight);
  double integral = 0.0;
  for (const double e : density) integral += 2 * e * w;
  EXPECT_NEAR(integral, 1.0, k_tight);
}

TEST(HandWorkedNetwork, NormalForceOfTheStrongContact) {
  // Bin means 1, at 10 degrees 10: mean 18/9 = 2, C and S of 9 at 20 degrees times 2/9: 2 cos 20, 2 sin 20.
  const double w = 20 * k_degree;
  const SetNumbers all = analysis_of_ten().numbers.of_all();
  EXPECT_NEAR(all.normal_force_orientations, 2.0, k_tight);
  EXPECT_NEAR(all.normal_force, 1.9, k_tight);
  EXPECT_NEAR(all.normal_amplitude, w / std::sin(w), k_tight);
  EXPECT_NEAR(all.normal_direction, 10 * k_degree, k_tight);
  EXPECT_NEAR(all.normal_residual, std::sqrt(6.0) / 2, k_tight);  // 9 sqrt(6/81) / 2
  const SetNumbers by_contacts = analysis_of_ten({.force_mean = ForceMean::contacts}).numbers.of_all();
  EXPECT_NEAR(by_contacts.normal_amplitude, w / std::sin(w) * 2.0 / 1.9, k_tight);
  EXPECT_EQ(by_contacts.normal_direction, all.normal_direction);
}

TEST(HandWorkedNetwork, TangentialForceInItsFourthHarmonic) {
  // Bin means 0.1, at 50 degrees 1: mean 1.8/9 = 0.2; 0.9 * 2/9 = 0.2 at 4 * 50 = 200 degrees: amplitude 1 at 50 degrees,
  // divided by sin(2w)/(2w).
  const double w = 20 * k_degree;
  const SetNumbers all = analysis_of_ten().numbers.of_all();
  EXPECT_NEAR(all.shear_force_orientations, 0.2, k_tight);
  EXPECT_NEAR(all.shear_force, 0.19, k_tight);
  EXPECT_NEAR(all.shear_amplitude, 2 * w / std::sin(2 * w), k_tight);
  EXPECT_NEAR(all.shear_direction, 50 * k_degree, k_tight);
  EXPECT_NEAR(all.bulk_friction, 0.1, k_tight);  // 1.9 / 19
  EXPECT_NEAR(all.sliding, 0.2, k_tight);
}

TEST(HandWorkedNetwork, KindsHaveTheirOwnNumbers) {
  const MicroNumbers n = analysis_of_ten().numbers;
  const double contacts[] = {4, 3, 3}, force[] = {13.0 / 4, 1.0, 1.0}, friction[] = {1.3 / 13, 0.1, 0.1};
  const double sliding[] = {0.25, 0.0, 1.0 / 3};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(n.sets[k + 1].contacts, contacts[k]);
    EXPECT_NEAR(n.sets[k + 1].normal_force, force[k], k_tight);
    EXPECT_NEAR(n.sets[k + 1].bulk_friction, friction[k], k_tight);
    EXPECT_NEAR(n.sets[k + 1].sliding, sliding[k], k_tight);
  }
  // Two of nine directions have g-r contacts, three r-r: a curve of three numbers fits the latter alone.
  EXPECT_EQ(n.sets[2].empty_bins, 7.0);
  EXPECT_TRUE(std::isnan(n.sets[2].normal_amplitude));
  EXPECT_EQ(n.sets[3].empty_bins, 6.0);
  EXPECT_NEAR(n.sets[3].normal_amplitude, 0.0, 1e-12);  // all three carry 1 N
}

TEST(HandWorkedNetwork, StrongNetworkIsTheOneOfTenNewton) {
  const MicroNumbers n = analysis_of_ten().numbers;
  EXPECT_NEAR(n.strong_threshold, 1.9, k_tight);
  EXPECT_NEAR(n.strong_fraction, 0.1, k_tight);
  EXPECT_NEAR(n.strong_load, 10.0 / 19, k_tight);
  EXPECT_EQ(n.sets[1].strong_share, 1.0);
  EXPECT_EQ(n.zone, static_cast<double>(Zone::rigid));
  EXPECT_EQ(n.strong_clusters, 1.0);
  EXPECT_EQ(n.strong_largest_cluster, 0.5);  // bodies 0 and 1 of four
  EXPECT_EQ(n.strong_spans, 0.0);
  // Among r-r and g-r contacts alone the mean is 1: only the one of 1.5 N is above it.
  const MicroState state = ten_contacts();
  const StrongNetwork soft = strong_network(std::span(state.network.contacts).subspan(4), StrongMeasure::normal_force);
  EXPECT_NEAR(soft.threshold, 1.0, k_tight);
  EXPECT_EQ(soft.count, 1.0);
  EXPECT_EQ(soft.composition[1], 1.0);
  EXPECT_EQ(zone_of(soft).zone, Zone::intermediate);
  // By magnitude contact 2 has sqrt(2) N, and the mean rises only to 1.9457: still one.
  const StrongNetwork by_size = strong_network(state.network.contacts, StrongMeasure::magnitude);
  const double sum = std::sqrt(100.01) + std::sqrt(2.0) + std::sqrt(0.26) + std::sqrt(2.26) + 6 * std::sqrt(1.01);
  EXPECT_NEAR(by_size.threshold, sum / 10, k_tight);
  EXPECT_NEAR(by_size.load_composition[0], 1.0, k_tight);
}

TEST(HandWorkedNetwork, TensorsOfFabricAndStress) {
  // Squares of nine cosines (or sines) over full turns: 4.5; the second contact at 90 degrees adds 1 to zz.
  const MicroAnalysis m = analysis_of_ten();
  EXPECT_NEAR(m.fabric.xx(), 0.45, k_tight);
  EXPECT_NEAR(m.fabric.zz(), 0.55, k_tight);
  EXPECT_NEAR(m.fabric.xz(), 0.0, k_tight);
  EXPECT_NEAR(m.numbers.fabric_amplitude_spatial, 0.25, k_tight);  // 5 * 0.05
  EXPECT_NEAR(m.numbers.fabric_direction_spatial, 90 * k_degree, k_tight);
  // f_n l / V: 1 N everywhere, 9 N more at 10 degrees, 1 N more at 90 (0.5 + 1.5 = 1 + 1).
  const double scale = k_branch / k_volume, c = std::cos(10 * k_degree), s = std::sin(10 * k_degree);
  EXPECT_NEAR(m.numbers.stress_xx, scale * (4.5 + 9 * c * c), 1e-9);
  EXPECT_NEAR(m.numbers.stress_zz, scale * (4.5 + 9 * s * s + 1), 1e-9);
  EXPECT_NEAR(m.numbers.stress_xz, scale * 4.5 * std::sin(20 * k_degree), 1e-9);
  EXPECT_NEAR(m.numbers.stress_xz, 3078.18128993102, 1e-9);
  // Tangential forces on j are -|f_t| along y: sigma_yx = -(l/V) sum |f_t| cos, 0.9 N at 50 degrees beside 0.1 all round.
  const Tensor3 stress = contact_stress(ten_contacts().network);
  EXPECT_NEAR(stress(1, 0), -scale * 0.9 * std::cos(50 * k_degree), 1e-9);
  // Sines of 10, 30 ... 170 degrees add up to 1/sin(10 degrees).
  EXPECT_NEAR(stress(1, 2), -scale * (0.9 * std::sin(50 * k_degree) + 0.1 * (1 / s + 1)), 1e-9);
}

TEST(HandWorkedNetwork, CoordinationAndRattlers) {
  // Bodies: 0 touches 1 (four contacts) and 2 (three); 2 touches 3 (three). 1 and 3 touch one partner: rattlers.
  const Connectivity c = connectivity_of(ten_contacts().network);
  EXPECT_NEAR(c.coordination, 20.0 / 4, k_tight);
  EXPECT_NEAR(c.coordination_pairs, 6.0 / 4, k_tight);
  EXPECT_NEAR(c.coordination_mechanical, (7.0 + 6.0) / 2, k_tight);
  EXPECT_NEAR(c.rattlers, 0.5, k_tight);
  EXPECT_NEAR(c.rattlers_gravel, 0.5, k_tight);
  EXPECT_NEAR(c.rattlers_rubber, 0.5, k_tight);
  // A wall is a partner too.
  MicroState held = ten_contacts();
  WallContact wall;
  wall.body = 3;
  held.network.wall_contacts = {wall};
  EXPECT_NEAR(connectivity_of(held.network).rattlers, 0.25, k_tight);
}

TEST(HandWorkedNetwork, PairsOfBodiesAsOneContact) {
  // Bodies 0 and 1: forces of contacts 0 to 3. Push = 10 (c10, s10) + (c30 + c50 + c70, s30 + s50 + s70); the three
  // point at 50 degrees together with the length 1 + 2 cos 20.
  const std::vector<Contact> pairs = merge_pairs(ten_contacts().network.contacts);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].body_j, 1);
  EXPECT_EQ(pairs[1].body_j, 2);
  EXPECT_EQ(pairs[2].body_i, 2);
  const double length = 1 + 2 * std::cos(20 * k_degree);
  const double x = 10 * std::cos(10 * k_degree) + length * std::cos(50 * k_degree);
  const double z = 10 * std::sin(10 * k_degree) + length * std::sin(50 * k_degree);
  EXPECT_NEAR(pairs[0].normal_force, std::hypot(x, z), 1e-13);
  EXPECT_NEAR(pairs[0].normal.z, z / std::hypot(x, z), k_tight);
  EXPECT_NEAR(pairs[0].shear_force.y, 1.3, k_tight);
  EXPECT_FALSE(pairs[0].is_sliding);  // one of four slides
  EXPECT_NEAR(pairs[0].friction, 0.5, k_tight);
  EXPECT_EQ(analysis_of_ten({.level = ContactLevel::pair}).numbers.of_all().contacts, 3.0);
}

TEST(StrongNetworkSpan, FromPlateToPlateThroughStrongContactsOnly) {
  // Bodies in a column 0 - 1 - 2 between the plates, and a pair 3 - 4 beside it. Mean force (4 + 4 + 1) / 3 = 3.
  ContactNetwork network;
  network.body_position.resize(5);
  network.body_material.assign(5, k_gravel);
  network.box = {0, 1, 1.0, 1.0};
  const auto join = [&](int i, int j, double force) {
    Contact c = test::plane_contact(90 * k_degree, force, 0.0);
    c.body_i = i;
    c.body_j = j;
    network.contacts.push_back(c);
  };
  join(0, 1, 4.0);
  join(1, 2, 4.0);
  join(3, 4, 1.0);
  const auto on_wall = [&](int body, int wall, double force) {
    WallContact c;
    c.body = body;
    c.wall = wall;
    c.normal = {0, 0, 1};
    c.normal_force = force;
    network.wall_contacts.push_back(c);
  };
  on_wall(0, 0, 4.0);
  const auto found = [&] { return percolation_of(network, network.contacts, {}); };
  EXPECT_FALSE(found().spans);
  on_wall(2, 1, 2.0);  // weak
  EXPECT_FALSE(found().spans);
  on_wall(2, 7, 9.0);  // a side wall
  EXPECT_FALSE(found().spans);
  on_wall(2, 1, 3.5);
  EXPECT_TRUE(found().spans);
  EXPECT_EQ(found().clusters, 1.0);
  EXPECT_EQ(found().largest_cluster, 0.6);
  // Three weak contacts of one body with a plate bear together more than the mean.
  network.wall_contacts.pop_back();
  on_wall(2, 1, 0.9);
  on_wall(2, 1, 0.9);
  EXPECT_FALSE(found().spans);
  EXPECT_TRUE(percolation_of(network, network.contacts, {.level = ContactLevel::pair}).spans);  // 2 + 0.9 + 0.9 > 3
  on_wall(2, 1, 3.5);
  network.contacts[1].normal_force = 2.0;  // mean 7/3: the column is cut
  EXPECT_FALSE(found().spans);
}

TEST(ZoneLabels, MajorityAndItsMargin) {
  StrongNetwork strong;
  strong.count = 100.0;
  strong.composition = {0.6, 0.3, 0.1};
  EXPECT_EQ(zone_of(strong).zone, Zone::rigid);
  EXPECT_NEAR(zone_of(strong).margin, 0.1 / std::sqrt(0.6 * 0.4 / 100), 1e-12);  // 2.04; r-r is 13.3 away
  strong.composition = {0.1, 0.35, 0.55};
  EXPECT_EQ(zone_of(strong).zone, Zone::soft);
  strong.composition = {0.5, 0.5, 0.0};  // a half is no majority
  EXPECT_EQ(zone_of(strong).zone, Zone::intermediate);
  EXPECT_EQ(zone_of(strong).margin, 0.0);
}

TEST(EmptyNetwork, HasNoValuesAndDoesNoHarm) {
  MicroState state;
  const MicroNumbers nothing = analyse(state, {.resamples = 2}).numbers;
  EXPECT_EQ(nothing.of_all().contacts, 0.0);
  EXPECT_EQ(nothing.of_all().empty_bins, 18.0);
  for (const double v : {nothing.of_all().fabric_amplitude, nothing.of_all().normal_amplitude, nothing.stress_zz,
                         nothing.strong_fraction, nothing.coordination, nothing.bond_strain}) {
    EXPECT_TRUE(std::isnan(v));
  }
  // Contacts without any tangential force: no direction of it.
  state = ten_contacts();
  for (Contact& c : state.network.contacts) c.shear_force = {};
  const MicroNumbers frictionless = analyse(state, {.bins = 18}).numbers;
  EXPECT_TRUE(std::isnan(frictionless.of_all().shear_amplitude));
  EXPECT_EQ(frictionless.of_all().bulk_friction, 0.0);
  EXPECT_NEAR(frictionless.of_all().normal_direction, 10 * k_degree, k_tight);
}

TEST(MicroOptionsCheck, NamesWhatIsWrong) {
  EXPECT_EQ(problem_of({}), "");
  for (const int bins : {16, 35, 722}) EXPECT_NE(problem_of({.bins = bins}), "") << bins;
  EXPECT_NE(problem_of({.resamples = -1}), "");
}

}  // namespace
}  // namespace dem
