// SPDX-License-Identifier: BSD-3-Clause
// A shear test of some hundred grains that takes seconds: loose criteria of rest, fast shear.
#pragma once

#include "dem4grm/lab/case.hpp"

namespace dem::test {

/// In a box of side x side x height, m; prepared with friction 0.3.
inline DirectShearCase tiny_shear_case(double rubber_content, double side, double height) {
  DirectShearCase test;
  test.specimen.rubber_content = rubber_content;
  test.specimen.preparation_friction = 0.3;
  test.specimen.generation_void_ratio = 0.85;
  test.specimen.gravel_grading = {{4.0e-3, 0.0}, {5.0e-3, 1.0}};
  test.specimen.rubber_grading = {{3.65e-3, 0.0}, {3.75e-3, 1.0}};
  test.box.length = test.box.width = side;
  test.box.height = height;
  test.box.upper_height = 2.0 * height;
  test.box.wing = 0.010;
  test.shear.normal_stress = 60e3;
  test.shear.velocity = 0.05;
  test.servo.shear_speed_cap = 0.25;
  test.equilibrium.force_ratio = 0.01;
  test.recording.frame_interval = 0.2e-3;
  return test;
}

}  // namespace dem::test
