// SPDX-License-Identifier: BSD-3-Clause
// A test that is stopped at any checkpoint of any stage and goes on from it ends with the bits of the straight one.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "dem4grm/core/error.hpp"
#include "dem4grm/core/random.hpp"
#include "dem4grm/engine/kernel_target.hpp"
#include "dem4grm/engine/time_step.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/specimen/specimen.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

DirectShearCase tiny_case() {
  DirectShearCase test = test::tiny_shear_case(0.3, 0.020, 0.018);
  test.box.split_plane = SplitPlane::specimen;
  test.box.plate_roughness = 1.5e-3;
  test.bond.form = BondForm::incremental;
  test.contact.hz_mode = 1;
  test.shear.displacement = 0.6e-3;
  test.equilibrium.plate_speed = 5e-3;
  test.equilibrium.stress_tolerance = 0.05;
  test.equilibrium.hold_steps = 200;
  test.recording.micro_interval = 0.1e-3;
  return test;
}

struct Interruption {};

/// The bits of rows: "not a number" counts as equal to itself.
using MicroBits = std::array<std::uint64_t, sizeof(MicroRow) / sizeof(std::uint64_t)>;
std::vector<MicroBits> bits_of(const std::vector<MicroRow>& rows) {
  std::vector<MicroBits> bits;
  bits.reserve(rows.size());
  for (const MicroRow& row : rows) bits.push_back(std::bit_cast<MicroBits>(row));
  return bits;
}

/// Stops at the n-th offer of a checkpoint, keeps its state and what was recorded.
struct Interrupter : LabObserver {
  int offers_left = -1;  ///< never stops when negative
  std::optional<std::vector<StateEntry>> state;
  std::vector<ShearRow> rows;
  std::vector<MicroRow> micro_rows;
  std::map<int, std::string> hashes;
  int offers = 0, new_stages = 0;
  std::string stage;

  void progress(const Progress& now) override { stage = now.stage; }
  bool wants_checkpoint(bool is_new_stage) override {
    ++offers;
    new_stages += is_new_stage ? 1 : 0;
    return offers_left >= 0 && offers_left-- == 0;
  }
  void checkpoint(const StateArchive& archive) override {
    state = archive.entries();
    throw Interruption{};
  }
  void resumed(const ResumedRun& past) override {
    rows.assign(past.rows.begin(), past.rows.end());
    micro_rows.assign(past.micro_rows.begin(), past.micro_rows.end());
    for (const FrameInfo& f : past.frames) hashes[f.number] = f.state_hash;
  }
  void shear_row(const ShearRow& row) override { rows.push_back(row); }
  void micro_row(const MicroRow& row) override { micro_rows.push_back(row); }
  void frame(const Simulation& /*state*/, const FrameInfo& info) override { hashes[info.number] = info.state_hash; }
};

/// How often the test is stopped and goes on: 5 trials, or as many as DEM4GRM_RESUMES in the environment says.
int number_of_trials() {
  const char* text = std::getenv("DEM4GRM_RESUMES");
  return text == nullptr ? 5 : std::max(1, std::atoi(text));
}

/// The state at the n-th offer of a checkpoint.
StateArchive state_at(const DirectShearCase& test, int offer) {
  Interrupter interrupter;
  interrupter.offers_left = offer;
  EXPECT_THROW(run_direct_shear(test, interrupter), Interruption);
  return StateArchive(interrupter.state.value());
}

TEST(LoadSpecimen, GivesBackWhatWasSaved) {
  const DirectShearCase test = tiny_case();
  Interrupter straight;
  run_direct_shear(test, straight);
  StateArchive saved = state_at(test, straight.offers - 2);  // of the shear stage
  Specimen specimen = load_specimen(specimen_order(test), saved);
  EXPECT_EQ(specimen.simulation->clumps.clumps.size(), specimen.grains.gravel.size());
  for (std::size_t k = 0; k < specimen.grains.gravel.size(); ++k) {
    EXPECT_EQ(specimen.simulation->clumps.clumps[k].size, specimen.grains.gravel[k].sieve_size);
  }
  StateArchive again;
  exchange(again, specimen);
  std::map<std::string, const StateData*> by_name;
  for (const StateEntry& e : saved.entries()) by_name[e.name] = &e.data;
  for (const StateEntry& e : again.entries()) {
    ASSERT_TRUE(by_name.count(e.name) == 1) << e.name;
    EXPECT_TRUE(*by_name[e.name] == e.data) << e.name;
  }
}

TEST(LoadSpecimen, RefusesAStateOfTheFillAndAWrongNumbering) {
  const DirectShearCase test = tiny_case();
  StateArchive of_fill = state_at(test, 0);
  EXPECT_THROW(load_specimen(specimen_order(test), of_fill), IoError);
  Interrupter straight;
  run_direct_shear(test, straight);
  std::vector<StateEntry> entries = state_at(test, straight.offers - 2).entries();
  for (StateEntry& e : entries) {
    if (e.name != "gravel_order") continue;
    auto& order = std::get<std::vector<std::int64_t>>(e.data);
    order[0] = order[1];
  }
  StateArchive wrong(entries);
  EXPECT_THROW(load_specimen(specimen_order(test), wrong), IoError);
}

TEST(Resume, AcrossChangesOfTheTimeStep) {
  DirectShearCase test = tiny_case();
  test.specimen.rubber_content = 0.0;
  test.shear.displacement = 3e-3;
  test.shear.velocity = 0.02;
  test.recording.frame_interval = 3e-3;
  Interrupter straight;
  const DirectShearResult expected = run_direct_shear(test, straight);
  ASSERT_GT(expected.steps, 3 * k_review_interval);
  EXPECT_NE(expected.rows.front().time_step, expected.rows.back().time_step);
  const int before = omp_get_max_threads();
  for (const int from_end : {10, 25}) {
    StateArchive state = state_at(test, straight.offers - from_end);
    omp_set_num_threads(3);
    LabObserver silent;
    const DirectShearResult resumed = run_direct_shear(test, silent, &state);
    omp_set_num_threads(before);
    EXPECT_EQ(resumed.state_hash, expected.state_hash);
    EXPECT_EQ(resumed.rows.back().time_step, expected.rows.back().time_step);
  }
}

TEST(Resume, FromAnyPointOfAnyStageEndsWithTheSameBits) {
  const DirectShearCase test = tiny_case();
  Interrupter straight;
  const DirectShearResult expected = run_direct_shear(test, straight);
  EXPECT_EQ(straight.new_stages, 3) << "after the fill, the compression and the final friction";
  EXPECT_EQ(expected.micro_rows.size(), 7U) << "at 0, 0.1, ... 0.6 mm";

  RandomSequence random(7, RandomStream::test, 0);
  std::map<std::string, int> stopped_in;
  const int before = omp_get_max_threads();
  const std::vector<std::string_view> targets = usable_kernel_targets();
  for (int trial = 0; trial < number_of_trials(); ++trial) {
    // Stopped up to three times on its way, each part with another number of threads and other instructions of the processor.
    std::optional<std::vector<StateEntry>> state;
    std::map<int, std::string> hashes;
    std::vector<MicroRow> heard;
    std::optional<DirectShearResult> result;
    for (int part = 0; !result; ++part) {
      omp_set_num_threads(1 + (trial + part) % 3);
      choose_kernel_target(targets[static_cast<std::size_t>(trial + part) % targets.size()]);
      Interrupter now;
      // Every second trial stops in shear first, which offers least often.
      const bool is_late = part == 0 && trial % 2 == 1;
      const int drawn = static_cast<int>(random.uniform(0.0, 0.6 * straight.offers));
      now.offers_left = is_late ? straight.offers - 2 - trial / 2 : (part < 3 ? drawn : -1);
      try {
        std::optional<StateArchive> from;
        if (state) from.emplace(*state);
        result = run_direct_shear(test, now, from ? &*from : nullptr);
        hashes = now.hashes;
        heard = now.micro_rows;
      } catch (const Interruption&) {
        ++stopped_in[now.stage];
        state = now.state;
      }
    }
    EXPECT_EQ(result->state_hash, expected.state_hash) << "trial " << trial;
    EXPECT_EQ(hashes, straight.hashes) << "trial " << trial;
    EXPECT_TRUE(bits_of(result->micro_rows) == bits_of(expected.micro_rows)) << "trial " << trial;
    EXPECT_TRUE(bits_of(heard) == bits_of(straight.micro_rows)) << "trial " << trial;
    ASSERT_EQ(result->rows.size(), expected.rows.size());
    for (std::size_t k = 0; k < expected.rows.size(); ++k) {
      EXPECT_EQ(result->rows[k].shear_stress, expected.rows[k].shear_stress) << "row " << k;
      EXPECT_EQ(result->rows[k].energy.boundary_work, expected.rows[k].energy.boundary_work) << "row " << k;
      EXPECT_EQ(result->rows[k].energy.local_damping, expected.rows[k].energy.local_damping) << "row " << k;
    }
    EXPECT_EQ(result->curve.peak_stress, expected.curve.peak_stress);
    EXPECT_EQ(result->steps, expected.steps);
    EXPECT_EQ(result->specimen.void_ratio_prepared, expected.specimen.void_ratio_prepared);
    EXPECT_EQ(result->specimen.fill_overlap, expected.specimen.fill_overlap);
    EXPECT_GT(result->before.homogeneity.fabric.contacts, 100);
    const Homogeneity &found = result->before.homogeneity, &wanted = expected.before.homogeneity;
    EXPECT_EQ(found.fabric.deviator, wanted.fabric.deviator);
    EXPECT_EQ(found.layering_at_plates, wanted.layering_at_plates);
    EXPECT_EQ(found.overlap.largest, wanted.overlap.largest);
    EXPECT_GT(result->before.lateral.k0_x, 0.1);
    EXPECT_EQ(result->before.lateral.k0_x, expected.before.lateral.k0_x);
    EXPECT_EQ(result->before.lateral.k0_y, expected.before.lateral.k0_y);
    EXPECT_EQ(result->specimen.time_step.limited_by, expected.specimen.time_step.limited_by);
  }
  omp_set_num_threads(before);
  choose_kernel_target(targets.front());
  for (const auto& [stage, stops] : stopped_in) std::printf("stopped %d times in stage %s\n", stops, stage.c_str());
  for (const char* stage : {"fill", "compression", "shear"}) EXPECT_GT(stopped_in[stage], 0) << stage;
}

TEST(Resume, RefusesTheStateOfAnotherCase) {
  DirectShearCase test = tiny_case();
  Interrupter stopped;
  stopped.offers_left = 60;
  EXPECT_THROW(run_direct_shear(test, stopped), Interruption);
  ASSERT_TRUE(stopped.state.has_value());
  test.box.height = 0.017;
  StateArchive archive(*stopped.state);
  LabObserver silent;
  EXPECT_THROW(run_direct_shear(test, silent, &archive), IoError);
}

}  // namespace
}  // namespace dem
