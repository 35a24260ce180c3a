// SPDX-License-Identifier: BSD-3-Clause
// The network of a small sheared box: stress against the walls, and what no way of looking may change.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "dem4grm/engine/observe.hpp"
#include "dem4grm/micro/analysis.hpp"
#include "dem4grm/micro/connectivity.hpp"
#include "dem4grm/micro/stress_tensor.hpp"
#include "support/contact_builder.hpp"
#include "support/mixture_scene.hpp"

namespace dem {
namespace {

using test::apart;

/// 105 clumps and 35 rubber grains pressed and sheared, in motion.
const Simulation& sheared_box() {
  static const Simulation k_sheared_box = test::run_mixture({}, 3000);
  return k_sheared_box;
}
const MicroState& state_of_box() {
  static const MicroState k_state = micro_state_of(sheared_box());
  return k_state;
}

TEST(LiveNetwork, HoldsEveryContactOnceAndNothingElse) {
  const Simulation& s = sheared_box();
  const ContactNetwork& network = state_of_box().network;
  ASSERT_GT(network.contacts.size(), 200U);
  ASSERT_GT(network.wall_contacts.size(), 30U);
  std::vector<Vec3> net(static_cast<std::size_t>(s.n_bodies())), on_wall(s.walls.size());
  for (const Contact& c : network.contacts) {
    EXPECT_NE(c.body_i, c.body_j);
    EXPECT_EQ(c.body_i, s.body_of_ball(c.ball_i));
    EXPECT_NEAR(norm(c.normal), 1.0, 1e-14);
    EXPECT_NEAR(dot(c.normal, c.shear_force), 0.0, 1e-9);
    // Bodies turn by some thousandths in a step of this fast box, and forces are split along the normal after the step.
    EXPECT_LE(norm(c.shear_force), c.friction * c.normal_force * 1.02 + 1e-9);
    const bool i_is_rubber = c.body_i < s.balls.n_grains, j_is_rubber = c.body_j < s.balls.n_grains;
    EXPECT_EQ(static_cast<int>(c.kind), (i_is_rubber ? 1 : 0) + (j_is_rubber ? 1 : 0));
    EXPECT_EQ(norm(c.branch - (body_position(s, c.body_j) - body_position(s, c.body_i))), 0.0);
    net[static_cast<std::size_t>(c.body_i)] -= force_on_second(c);
    net[static_cast<std::size_t>(c.body_j)] += force_on_second(c);
  }
  for (const WallContact& c : network.wall_contacts) {
    net[static_cast<std::size_t>(c.body)] -= force_on_second(c);
    on_wall[static_cast<std::size_t>(c.wall)] += force_on_second(c);
  }
  const std::vector<Vec3> expected = net_contact_forces(s);
  for (std::size_t k = 0; k < net.size(); ++k) EXPECT_NEAR(norm(net[k] - expected[k]), 0.0, 1e-9) << k;
  for (std::size_t w = 0; w < on_wall.size(); ++w) {
    EXPECT_NEAR(norm(on_wall[w] - s.reactions[w].force), 0.0, 1e-9) << s.walls[w].name;
  }
}

TEST(LiveNetwork, AContactSlidesFromItsCoulombLimitOn) {
  // Two heavy spheres pressed together by d and moved past each other. Mindlin: k_s / k_n = 2 (1 - nu) / (2 - nu), and
  // Hertz: F_n = (2/3) k_n d, so the spring is full after u = mu (2/3) d (2 - nu) / (2 (1 - nu)).
  const double r = 2.5e-3, d = 20e-6, nu = 0.3;
  for (const double friction : {0.2, 0.72}) {
    const double full = friction * (2.0 / 3.0) * d * (2.0 - nu) / (2.0 * (1.0 - nu));
    for (const double way : {0.5, 0.9, 1.1, 2.0}) {  // of the displacement that fills the spring
      Scene scene = test::model_scene();
      scene.gravel.friction = friction;
      scene.gravel.density = 2.7e6;  // forces hardly move them
      test::add_sphere(scene, {0, 0, 0}, r);
      test::add_sphere(scene, {0, 0, 2.0 * r - d}, r);
      Simulation s(scene);
      s.set_time_step(1e-8);
      constexpr int k_steps = 200;
      test::set_motion(s, 1, {way * full / (k_steps * 1e-8), 0, 0});
      for (int k = 0; k <= k_steps; ++k) s.step();  // the last step evaluates where the one before it led
      const ContactNetwork network = contact_network_of(s);
      ASSERT_EQ(network.contacts.size(), 1U);
      const Contact& c = network.contacts.front();
      EXPECT_EQ(c.is_sliding, way > 1.0) << "friction " << friction << ", way " << way;
      EXPECT_NEAR(norm(c.shear_force) / (friction * c.normal_force), std::min(way, 1.0), 0.02);
    }
  }
}

TEST(LiveNetwork, SlidingContactsAreAtTheirLimitAndOthersBelow) {
  int sliding = 0, sticking = 0;
  for (const Contact& c : state_of_box().network.contacts) {
    const double use = norm(c.shear_force) / (c.friction * c.normal_force);
    if (c.is_sliding) {
      EXPECT_NEAR(use, 1.0, 0.02);  // as above
      ++sliding;
    } else {
      EXPECT_LT(use, 1.02);
      ++sticking;
    }
  }
  EXPECT_GT(sliding, 20);
  EXPECT_GT(sticking, 20);
}

TEST(LiveNetwork, ContactStressIsThatOfTheWallsAndOfTheMotion) {
  // sum f l over contacts and walls = sum f x over walls + sum (net force) x over bodies, whatever the motion.
  const Simulation& s = sheared_box();
  const ContactNetwork& network = state_of_box().network;
  Tensor3 expected = boundary_stress(network);
  const std::vector<Vec3> net = net_contact_forces(s);
  for (int body = 0; body < s.n_bodies(); ++body) {
    expected += outer(net[static_cast<std::size_t>(body)], body_position(s, body)) * (1.0 / network.box.volume());
  }
  const Tensor3 found = contact_stress(network);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(found.value[k], expected.value[k], 1e-6 * std::fabs(found.zz()));
  const BoxSettings box = test::mixture_box({});
  EXPECT_NEAR(network.box.area, box.length * box.width, 1e-12);
  EXPECT_EQ(network.box.height, s.walls[ShearBox::k_top_plate].corner.z);
  EXPECT_NEAR(plate_stress(network), s.reactions[ShearBox::k_top_plate].force.z / network.box.area, 1e-6);
}

/// Numbers of two analyses; angles only modulo their period. Sums in another order may differ in their last digits.
void expect_same(const MicroNumbers& a, const MicroNumbers& b, double tolerance) {
  for (std::size_t set = 0; set < k_contact_sets; ++set) {
    const SetNumbers &x = a.sets[set], &y = b.sets[set];
    for (const auto value : {&SetNumbers::contacts, &SetNumbers::normal_force, &SetNumbers::shear_force,
                             &SetNumbers::fabric_amplitude, &SetNumbers::normal_amplitude, &SetNumbers::shear_amplitude,
                             &SetNumbers::normal_residual, &SetNumbers::sliding, &SetNumbers::bulk_friction,
                             &SetNumbers::strong_share, &SetNumbers::strong_load_share}) {
      if (std::isnan(x.*value) && std::isnan(y.*value)) continue;  // of the few contacts of rubber with rubber
      EXPECT_NEAR(x.*value, y.*value, tolerance * std::max(1.0, std::fabs(x.*value))) << k_set_names[set];
    }
  }
  for (const auto value : {&MicroNumbers::strong_threshold, &MicroNumbers::strong_spans, &MicroNumbers::strong_clusters,
                           &MicroNumbers::zone, &MicroNumbers::coordination, &MicroNumbers::coordination_mechanical,
                           &MicroNumbers::rattlers, &MicroNumbers::stress_ratio, &MicroNumbers::stress_ratio_of_fabric,
                           &MicroNumbers::fabric_amplitude_spatial, &MicroNumbers::stress_difference}) {
    EXPECT_NEAR(a.*value, b.*value, tolerance * std::max(1.0, std::fabs(a.*value)));
  }
  for (const auto value : {&MicroNumbers::stress_xx, &MicroNumbers::stress_yy, &MicroNumbers::stress_zz}) {
    EXPECT_NEAR(a.*value / b.*value, 1.0, tolerance);
  }
}

void exchange_bodies(Contact& c) {
  std::swap(c.ball_i, c.ball_j);
  std::swap(c.body_i, c.body_j);
  c.normal = -c.normal;
  c.shear_force = -c.shear_force;
  c.branch = -c.branch;
}

class LooksAtTheBox : public ::testing::TestWithParam<ContactLevel> {
 protected:
  MicroOptions options_{.level = GetParam()};
  MicroNumbers straight_ = analyse(state_of_box(), options_).numbers;
};

TEST_P(LooksAtTheBox, ExchangeOfBodiesChangesNothing) {
  MicroState other = state_of_box();
  for (Contact& c : other.network.contacts) exchange_bodies(c);
  const MicroNumbers found = analyse(other, options_).numbers;
  expect_same(found, straight_, 1e-12);
  EXPECT_NEAR(found.of_all().normal_direction, straight_.of_all().normal_direction, 1e-12);
  EXPECT_NEAR(found.stress_xz, straight_.stress_xz, 1e-9 * straight_.stress_zz);
}

TEST_P(LooksAtTheBox, OrderOfContactsChangesNothing) {
  MicroState other = state_of_box();
  RandomSequence random(5, RandomStream::test, 0);
  auto& contacts = other.network.contacts;
  for (std::size_t k = contacts.size() - 1; k > 0; --k) {
    std::swap(contacts[k], contacts[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
  }
  const MicroNumbers found = analyse(other, options_).numbers;
  expect_same(found, straight_, 1e-11);
  EXPECT_NEAR(found.of_all().shear_direction, straight_.of_all().shear_direction, 1e-10);
}

/// The network seen in a mirror across the plane x = 0.
ContactNetwork mirrored(ContactNetwork network) {
  const auto mirror = [](auto& c) {
    for (Vec3* v : {&c.point, &c.normal, &c.shear_force, &c.branch}) v->x = -v->x;
  };
  for (Contact& c : network.contacts) mirror(c);
  for (WallContact& c : network.wall_contacts) mirror(c);
  for (Vec3& x : network.body_position) x.x = -x.x;
  return network;
}

TEST_P(LooksAtTheBox, MirrorTurnsAnglesAndShearStressRound) {
  const MicroState other{mirrored(state_of_box().network), state_of_box().rubber};
  const MicroNumbers found = analyse(other, options_).numbers;
  expect_same(found, straight_, 1e-11);
  const SetNumbers &x = found.of_all(), &y = straight_.of_all();
  EXPECT_LT(apart(x.fabric_direction, -y.fabric_direction, std::numbers::pi), 1e-10);
  EXPECT_LT(apart(x.normal_direction, -y.normal_direction, std::numbers::pi), 1e-10);
  EXPECT_LT(apart(x.shear_direction, -y.shear_direction, 0.5 * std::numbers::pi), 1e-10);
  EXPECT_LT(apart(found.stress_direction, -straight_.stress_direction, std::numbers::pi), 1e-10);
  EXPECT_NEAR(found.stress_xz, -straight_.stress_xz, 1e-9 * straight_.stress_zz);
  EXPECT_NEAR(found.boundary_xz, -straight_.boundary_xz, 1e-9 * straight_.stress_zz);
}

TEST_P(LooksAtTheBox, SharesAndTensorsAddUp) {
  const MicroAnalysis m = analyse(state_of_box(), options_);
  double contacts = 0.0, share = 0.0, load = 0.0;
  for (std::size_t set = 1; set < k_contact_sets; ++set) {
    contacts += m.numbers.sets[set].contacts;
    share += m.numbers.sets[set].strong_share;
    load += m.numbers.sets[set].strong_load_share;
  }
  EXPECT_EQ(contacts, m.numbers.of_all().contacts);
  EXPECT_NEAR(share, 1.0, 1e-14);
  EXPECT_NEAR(load, 1.0, 1e-14);
  EXPECT_NEAR(trace(m.fabric), 1.0, 1e-13);
  // Weighted by their counts, which no rounding to whole shares may spoil.
  const double strong = m.numbers.strong_fraction;
  EXPECT_GT(strong, 0.1);
  const Tensor3 sum = m.strong_fabric * strong + m.weak_fabric * (1.0 - strong);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(sum.value[k], m.fabric.value[k], 1e-14);
  EXPECT_LE(m.numbers.of_all().bulk_friction, 0.72);
  EXPECT_GE(m.numbers.of_all().bulk_friction, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Levels, LooksAtTheBox, testing::Values(ContactLevel::contact, ContactLevel::pair),
                         [](const auto& level) { return level.param == ContactLevel::pair ? "pairs" : "contacts"; });

TEST(PairLevel, KeepsForcesAndStress) {
  const ContactNetwork& network = state_of_box().network;
  ContactNetwork merged = network;
  merged.contacts = merge_pairs(network.contacts);
  EXPECT_LT(merged.contacts.size(), network.contacts.size());
  const Tensor3 a = contact_stress(network), b = contact_stress(merged);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(a.value[k], b.value[k], 1e-9 * std::fabs(a.zz()));
  EXPECT_NEAR(2.0 * static_cast<double>(merged.contacts.size()) / static_cast<double>(network.body_position.size()),
              connectivity_of(network).coordination_pairs, 1e-12);
}

TEST(StressForceFabric, HoldsToFirstOrderForKnownTensors) {
  // Normals in space by density 1 + a^c nn, forces f_n = 1 + a^n nn and f_t = a^t n - (n a^t n) n, all coaxial along z:
  // q/p = (2/5)(a^c + a^n + (3/2) a^t) of the deviators. A tensor diag(-h, -h, 2h) has the size 3 h.
  const double ac = 0.05, an = 0.06, at = 0.04;
  const auto tensor = [](double h, const Vec3& n) { return Vec3{-h * n.x, -h * n.y, 2 * h * n.z}; };
  RandomSequence random(2, RandomStream::test, 3);
  std::vector<Contact> contacts;
  for (int k = 0; k < 400000; ++k) {
    Contact c = test::plane_contact(0.0, 1.0, 0.0);
    const Vec3 n = c.normal = frame_of(random.orientation()).e1;
    if (random.uniform(0.0, 1.0 + 2 * ac) > 1.0 + dot(n, tensor(ac, n))) continue;
    c.normal_force = 1.0 + dot(n, tensor(an, n));
    c.shear_force = perpendicular(tensor(at, n), n) * -1.0;
    c.branch = n;
    contacts.push_back(c);
  }
  const AnisotropyTensors t = anisotropy_tensors(contacts);
  const double error = 4 * 7.5 * 0.3 / std::sqrt(static_cast<double>(contacts.size()));
  EXPECT_NEAR(t.contacts.zz(), 2 * ac, error);
  EXPECT_NEAR(t.normal.zz(), 2 * an, error);
  EXPECT_NEAR(t.shear.zz(), 2 * at, error);
  EXPECT_NEAR(stress_ratio_of(t), 0.4 * 3 * (ac + an + 1.5 * at), 2 * error);
  ContactNetwork network;
  network.contacts = contacts;
  network.box = {0, 1, 1.0, 1.0};
  // The stress of these contacts holds the products of the anisotropies too, of the order 0.05 of the sum.
  EXPECT_NEAR(stress_ratio_of(contact_stress(network)) / stress_ratio_of(t), 1.0, 0.1);
}

}  // namespace
}  // namespace dem
