// SPDX-License-Identifier: BSD-3-Clause
// Specimens of a given relative density: what the search finds, and that neither stops nor kept states change a bit.
#include <gtest/gtest.h>
#include <omp.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dem4grm/core/random.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

DirectShearCase density_case(double rubber_content) {
  DirectShearCase test = test::tiny_shear_case(rubber_content, 0.022, 0.020);
  test.specimen.preparation_friction.reset();
  test.specimen.relative_density = 0.5;
  test.specimen.relative_density_tolerance = 0.08;  // some hundred grains scatter more than a real specimen
  test.shear.displacement = 0.2e-3;
  test.equilibrium.plate_speed = 2e-3;
  test.equilibrium.stress_tolerance = 0.02;
  test.equilibrium.hold_steps = 300;
  return test;
}

struct Stop {};

/// Keeps states of preparations, counts how often they help, and stops at an offer of a checkpoint.
struct Keeper : LabObserver {
  std::map<std::string, std::vector<StateEntry>> store;
  int fetched = 0, offers = 0, offers_left = -1;
  std::vector<std::string> notes, stages;
  std::optional<std::vector<StateEntry>> state;
  bool has_shear = true;

  void note(const std::string& text) override { notes.push_back(text); }
  void progress(const Progress& now) override {
    if (stages.empty() || stages.back() != now.stage) stages.push_back(now.stage);
    EXPECT_EQ(now.steps_to_last_stage >= 0.0, now.stage != "fill" && now.stage != "shear") << now.stage;
  }
  std::optional<StateArchive> fetch_preparation(const std::string& name) override {
    const auto found = store.find(name);
    if (found == store.end()) return std::nullopt;
    ++fetched;
    return StateArchive(found->second);
  }
  void keep_preparation(const std::string& name, const StateArchive& kept) override { store[name] = kept.entries(); }
  bool wants_checkpoint(bool /*is_new_stage*/) override {
    ++offers;
    return offers_left >= 0 && offers_left-- == 0;
  }
  void checkpoint(const StateArchive& archive) override {
    state = archive.entries();
    throw Stop{};
  }
  bool wants_shear() override { return has_shear; }
};

TEST(RelativeDensitySearch, FindsTheDensityBetweenTheEnds) {
  for (const double rubber_content : {0.0, 0.4}) {
    const DirectShearCase test = density_case(rubber_content);
    Keeper keeper;
    keeper.has_shear = false;
    const DirectShearResult r = run_direct_shear(test, keeper);
    const std::vector<Branch>& branches = r.specimen.branches;
    ASSERT_GE(branches.size(), 3U);
    EXPECT_EQ(branches[0].friction, 0.0);
    EXPECT_EQ(branches[1].friction, 2.0);
    for (const Branch& b : branches) EXPECT_DOUBLE_EQ(b.stress, 54e3);  // 90 % of 60 kPa
    EXPECT_LT(branches[0].void_ratio, branches.back().void_ratio);
    EXPECT_LT(branches.back().void_ratio, branches[1].void_ratio);
    EXPECT_LT(branches[1].void_ratio, r.specimen.void_ratio_generated) << "the plate only comes down";
    EXPECT_NEAR(r.specimen.relative_density_reached().value(), 0.5, 0.08);
    EXPECT_EQ(r.specimen.preparation_friction, branches.back().friction);
    // From 54 to 60 kPa a little, and no collapse when the friction rises to its final value.
    EXPECT_LT(r.specimen.void_ratio_prepared, branches.back().void_ratio);
    EXPECT_NEAR(r.specimen.void_ratio_prepared, branches.back().void_ratio, 0.03);
    EXPECT_NEAR(r.specimen.void_ratio_before_shear, r.specimen.void_ratio_prepared, 2e-3);
    EXPECT_TRUE(r.rows.empty());
    EXPECT_EQ(keeper.notes.size(), branches.size());
    EXPECT_EQ(keeper.stages[1], "e_min (friction 0)");
    EXPECT_EQ(keeper.stages[2], "e_max (friction 2)");
  }
}

TEST(RelativeDensitySearch, KeptStatesSaveStepsAndChangeNoBit) {
  const DirectShearCase test = density_case(0.4);
  Keeper first;
  const DirectShearResult expected = run_direct_shear(test, first);
  EXPECT_EQ(first.fetched, 0);
  Keeper again;
  again.store = first.store;
  const DirectShearResult result = run_direct_shear(test, again);
  EXPECT_EQ(result.state_hash, expected.state_hash);
  EXPECT_EQ(result.steps, expected.steps);
  EXPECT_EQ(again.fetched, static_cast<int>(expected.specimen.branches.size()) + 1) << "all branches and the fill";
  EXPECT_LT(again.offers, first.offers / 2);
}

TEST(RelativeDensitySearch, ALargerStressBeginsWithTheStatesOfASmallerOne) {
  DirectShearCase test = density_case(0.0);
  test.specimen.load_steps = {30e3, 60e3, 1e6};  // what is not below the normal stress is skipped
  test.shear.normal_stress = 30e3;
  Keeper keeper;
  run_direct_shear(test, keeper);
  test.shear.normal_stress = 60e3;
  Keeper warm;
  warm.store = keeper.store;
  const DirectShearResult from_states = run_direct_shear(test, warm);
  EXPECT_GE(warm.fetched, 3) << "the fill, e_min and e_max at 27 kPa";
  Keeper cold;
  const DirectShearResult from_nothing = run_direct_shear(test, cold);
  EXPECT_EQ(from_states.state_hash, from_nothing.state_hash);
  for (std::size_t k = 0; k < from_nothing.specimen.branches.size(); ++k) {
    EXPECT_EQ(from_states.specimen.branches[k].void_ratio, from_nothing.specimen.branches[k].void_ratio);
    EXPECT_EQ(from_states.specimen.branches[k].steps, from_nothing.specimen.branches[k].steps);
  }
}

TEST(RelativeDensitySearch, RestOnTheWayHardlyMatters) {
  // The quasi-static void ratio does not remember that the specimen paused at half the stress.
  DirectShearCase test = density_case(0.4);
  Keeper direct, paused;
  direct.has_shear = paused.has_shear = false;
  const DirectShearResult a = run_direct_shear(test, direct);
  test.specimen.load_steps = {30e3};
  const DirectShearResult b = run_direct_shear(test, paused);
  EXPECT_NEAR(a.specimen.branches[0].void_ratio, b.specimen.branches[0].void_ratio, 0.02);
  EXPECT_NEAR(a.specimen.branches[1].void_ratio, b.specimen.branches[1].void_ratio, 0.01);
  EXPECT_NE(a.state_hash, b.state_hash);
}

TEST(RelativeDensitySearch, StoppedAnywhereItEndsWithTheSameBits) {
  DirectShearCase test = density_case(0.4);
  test.specimen.load_steps = {30e3};
  Keeper straight;
  const DirectShearResult expected = run_direct_shear(test, straight);
  RandomSequence random(11, RandomStream::test, 0);
  const int before = omp_get_max_threads();
  // Stopped three times on its way, each part with another number of threads.
  std::optional<std::vector<StateEntry>> state;
  for (int part = 0; part < 3; ++part) {
    omp_set_num_threads(1 + part);
    Keeper stopped;
    stopped.offers_left = static_cast<int>(random.uniform(0.2, 0.3) * straight.offers);
    std::optional<StateArchive> from;
    if (state) from.emplace(*state);
    EXPECT_THROW(run_direct_shear(test, stopped, from ? &*from : nullptr), Stop) << "part " << part;
    state = stopped.state.value();
  }
  StateArchive last(*state);
  Keeper rest;
  const DirectShearResult result = run_direct_shear(test, rest, &last);
  EXPECT_EQ(result.state_hash, expected.state_hash);
  EXPECT_EQ(result.steps, expected.steps);
  EXPECT_EQ(result.specimen.branches.size(), expected.specimen.branches.size());
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace dem
