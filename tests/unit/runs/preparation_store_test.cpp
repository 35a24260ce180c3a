// SPDX-License-Identifier: BSD-3-Clause
// The store of preparations: which cases share states, and what happens to files that do not fit.
#include "dem4grm/runs/preparation_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

#include "dem4grm/runs/folder_lock.hpp"
#include "dem4grm/specimen/branch_words.hpp"
#include "support/run_program.hpp"

namespace dem {
namespace {

DirectShearCase any_case() {
  DirectShearCase test;
  test.specimen.gravel_grading = {{4.0e-3, 0.0}, {6.0e-3, 1.0}};
  test.shear.normal_stress = 30e3;
  return test;
}

StateArchive some_state(double number) {
  StateArchive archive;
  archive.exchange("number", number);
  return archive;
}

double number_in_state(std::optional<StateArchive> state) {
  double number = 0.0;
  state.value().exchange("number", number);
  return number;
}

class PreparationStoreTest : public testing::Test {
 protected:
  test::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(PreparationStoreTest, GivesBackWhatWasKept) {
  const PreparationStore store(folder_, any_case());
  EXPECT_FALSE(store.fetch("fill"));
  store.keep("fill", some_state(0.1));
  store.keep("fill", some_state(0.2));
  EXPECT_EQ(number_in_state(store.fetch("fill")), 0.2);
  EXPECT_FALSE(store.fetch("other"));
}

TEST_F(PreparationStoreTest, IsSharedByCasesThatWouldArriveAtTheSameState) {
  using Change = std::function<void(DirectShearCase&)>;
  const std::vector<Change> harmless{
      [](auto& c) { c.name = "another"; },
      [](auto& c) { c.shear.normal_stress = 60e3; },
      [](auto& c) { c.shear.velocity = 0.02; },
      [](auto& c) { c.recording.interval = 1e-4; },
      [](auto& c) { c.specimen.relative_density = 0.7; },
      [](auto& c) { c.specimen.load_steps = {10e3}; },
      [](auto& c) { c.specimen.preparation_friction = 0.2; },
  };
  const std::vector<Change> decisive{
      [](auto& c) { c.seed = 2; },
      [](auto& c) { c.specimen.rubber_content = 0.1; },
      [](auto& c) { c.specimen.gravel_grading[1].size = 6.1e-3; },
      [](auto& c) { c.specimen.generation_void_ratio = 0.7; },
      [](auto& c) { c.specimen.preparation_plate_friction = 0.1; },
      [](auto& c) { c.box.length = 0.099; },
      [](auto& c) { c.gravel.shear_modulus = 80e6; },
      [](auto& c) { c.integration.local_damping = 0.3; },
      [](auto& c) { c.equilibrium.branch_force_ratio = 2e-3; },
      [](auto& c) { c.equilibrium.branch_inertial_number = 1e-5; },
      [](auto& c) { c.equilibrium.branch_hold_steps = 500; },
      [](auto& c) { c.specimen.approach_inertial_number = 0.001; },
  };
  PreparationStore(folder_, any_case()).keep("fill", some_state(0.3));
  for (std::size_t k = 0; k < harmless.size(); ++k) {
    DirectShearCase test = any_case();
    harmless[k](test);
    EXPECT_TRUE(PreparationStore(folder_, test).fetch("fill")) << "change " << k;
  }
  for (std::size_t k = 0; k < decisive.size(); ++k) {
    DirectShearCase test = any_case();
    decisive[k](test);
    EXPECT_FALSE(PreparationStore(folder_, test).fetch("fill")) << "change " << k;
  }
}

TEST_F(PreparationStoreTest, BelongsToOneProgram) {
  PreparationStore(folder_, any_case(), "program A").keep("fill", some_state(0.3));
  EXPECT_TRUE(PreparationStore(folder_, any_case(), "program A").fetch("fill"));
  EXPECT_FALSE(PreparationStore(folder_, any_case(), "program B").fetch("fill"));
  EXPECT_FALSE(PreparationStore(folder_, any_case()).fetch("fill"));
  PreparationStore(folder_, any_case(), "").keep("fill", some_state(0.3));
  EXPECT_FALSE(PreparationStore(folder_, any_case(), "").fetch("fill")) << "a program that cannot be told from others";
  EXPECT_EQ(program_fingerprint().size(), 32U);
}

TEST(BranchStateName, DiffersForEveryFrictionAndPath) {
  const std::vector<double> path{27e3, 54e3};
  EXPECT_EQ(branch_state_name(0.0503, path, 0), "friction-0.0503-stress-27000-Pa");
  EXPECT_EQ(branch_state_name(0.0503, path, 1), "friction-0.0503-stress-27000-54000-Pa");
  EXPECT_NE(branch_state_name(0.0, path, 0), branch_state_name(4e-5, path, 0));
  EXPECT_NE(branch_state_name(0.0, {55e3}, 0), branch_state_name(0.0, {0.55 * 100e3}, 0));
}

TEST_F(PreparationStoreTest, PassesOverDamagedFiles) {
  const PreparationStore store(folder_, any_case());
  store.keep("fill", some_state(0.1));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    if (entry.is_regular_file()) std::ofstream(entry.path()) << "no state";
  }
  EXPECT_FALSE(store.fetch("fill"));
  store.keep("fill", some_state(0.4));
  EXPECT_EQ(number_in_state(store.fetch("fill")), 0.4);
}

TEST_F(PreparationStoreTest, DraftsOfTheDeadAreRemovedThoseOfTheLivingStay) {
  const PreparationStore store(folder_, any_case());
  store.keep("fill", some_state(0.3));
  const std::filesystem::path place = std::filesystem::directory_iterator(folder_)->path();
  const auto draft = [&](const std::string& host, int process) {
    std::filesystem::path path = place / ("fill-" + host + "-" + std::to_string(process) + ".part");
    test::write_all(path, "half");
    return path;
  };
  const auto draft_of_draft = place / ("fill-" + host_name() + "-999999998.part.tmp");
  test::write_all(draft_of_draft, "half");
  const auto dead = draft(host_name(), 999999999), alive = draft(host_name(), ::getpid()),
             elsewhere = draft("other", 999999999);
  store.check_writable();
  EXPECT_FALSE(std::filesystem::exists(dead));
  EXPECT_FALSE(std::filesystem::exists(draft_of_draft));
  EXPECT_TRUE(std::filesystem::exists(alive));
  EXPECT_TRUE(std::filesystem::exists(elsewhere));
  EXPECT_TRUE(store.fetch("fill"));
}

}  // namespace
}  // namespace dem
