// SPDX-License-Identifier: BSD-3-Clause
// The watchdog looks while a test is sheared: one whose plate cannot follow ends with the reason, a usual one does not.
#include <gtest/gtest.h>

#include <string>

#include "dem4grm/core/error.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "support/tiny_shear_case.hpp"

namespace dem {
namespace {

/// Gravel, which dilates, sheared over 8 mm at a velocity, m/s.
DirectShearCase sheared_at(double velocity) {
  DirectShearCase test = test::tiny_shear_case(0.0, 0.021, 0.021);
  test.specimen.gravel_grading = {{3.6e-3, 0.0}, {4.0e-3, 1.0}};
  test.equilibrium.plate_speed = 5e-3;
  test.equilibrium.force_ratio = 0.02;
  test.equilibrium.stress_tolerance = 0.05;
  test.equilibrium.hold_steps = 200;
  test.shear.velocity = velocity;
  test.shear.normal_stress = 100e3;
  test.shear.displacement = 8e-3;
  test.recording.frame_interval = 8e-3;
  return test;
}

TEST(WatchedShear, APlateThatCannotFollowEndsTheTest) {
  LabObserver silent;
  try {
    run_direct_shear(sheared_at(0.5), silent);
    FAIL() << "finished";
  } catch (const PhysicsError& e) {
    const std::string text = e.what();
    for (const char* part : {"the top plate holds", "100 kPa were asked for", "stage shear", "slower shear.velocity"}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(WatchedShear, AUsualOneIsLeftAlone) {
  LabObserver silent;
  EXPECT_NO_THROW(run_direct_shear(sheared_at(0.1), silent));
}

}  // namespace
}  // namespace dem
