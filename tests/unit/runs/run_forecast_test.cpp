// SPDX-License-Identifier: BSD-3-Clause
// What the forecast of a run is made of. The size of the output is held against a real run in tests/lab; times depend on
// the machine and are not tested.
#include <gtest/gtest.h>

#include "dem4grm/runs/run_forecast.hpp"
#include "support/mixture_case.hpp"

namespace {

using namespace dem;

using dem::test::mixture_case;

RunForecast forecast_of(const DirectShearCase& test) { return forecast_run(test, derive_facts(test), 0.05, 1); }

TEST(RunForecast, TwiceTheDisplacementTakesTwiceTheShear) {
  DirectShearCase test = mixture_case(0.3);
  const RunForecast once = forecast_of(test);
  const CaseFacts facts = derive_facts(test);
  test.shear.displacement *= 2.0;
  const RunForecast twice = forecast_of(test);
  EXPECT_EQ(once.threads, 1);
  EXPECT_GT(once.step_time, 1e-6);
  EXPECT_NEAR(once.test_time, static_cast<double>(facts.steps) * once.step_time, 1e-9 * once.test_time);
  EXPECT_NEAR(static_cast<double>(twice.steps - once.steps), static_cast<double>(facts.steps), 1.0);
  EXPECT_EQ(once.time(), once.preparation_time + once.test_time);
}

TEST(RunForecast, AQuickPlatePreparesInFewerSteps) {
  DirectShearCase test = mixture_case(0.0);
  const RunForecast slow = forecast_of(test);
  test.specimen.approach_speed *= 10.0;
  EXPECT_LT(forecast_of(test).steps, slow.steps);
}

TEST(RunForecast, EveryStateTakesItsRoom) {
  DirectShearCase test = mixture_case(0.3);
  test.recording.extra_frames = {};
  const auto size_with_states_every = [&](double interval) {
    test.recording.frame_interval = interval;
    return forecast_of(test).results_size;
  };
  const double end = test.shear.displacement;
  const double two_states = size_with_states_every(end), three = size_with_states_every(end / 2.0);
  EXPECT_GT(three, two_states);
  EXPECT_NEAR(size_with_states_every(end / 10.0) - two_states, 9.0 * (three - two_states), 1e-6 * two_states);
}

TEST(RunForecast, ASearchTakesTimeAndKeepsItsBranches) {
  DirectShearCase test = mixture_case(0.3);
  const RunForecast given = forecast_of(test);
  EXPECT_EQ(given.store_size, 0.0);
  test.specimen.preparation_friction.reset();
  const RunForecast searched = forecast_of(test);
  EXPECT_GT(searched.steps, given.steps);
  EXPECT_GT(searched.store_size, 2.0 * searched.checkpoint_size);
  test.specimen.load_steps = {30e3, 60e3, 100e3};  // the last is not below the normal stress
  EXPECT_NEAR(forecast_of(test).store_size, 3.0 * searched.store_size, 1.0);
}

TEST(RunForecast, OfAGrainBetweenPlates) {
  const GrainCompressionCase test;
  const CaseFacts facts = derive_facts(test);
  const RunForecast f = forecast_run(test, facts, 0.05);
  EXPECT_EQ(f.steps, facts.steps);
  EXPECT_GT(f.test_time, 0.0);
  EXPECT_EQ(f.preparation_time, 0.0);
}

}  // namespace
