// SPDX-License-Identifier: BSD-3-Clause
// A case of a direct shear test with some hundred grains, for tests that look at grains and at what follows from a case.
#pragma once

#include "dem4grm/lab/dense_assembly.hpp"
#include "dem4grm/lab/direct_shear.hpp"
#include "dem4grm/specimen/draw_grains.hpp"

namespace dem::test {

inline DirectShearCase mixture_case(double rubber_content) {
  DirectShearCase test;
  test.specimen.rubber_content = rubber_content;
  test.specimen.preparation_friction = 0.3;
  test.specimen.gravel_grading = {{4.0e-3, 0.0}, {6.0e-3, 1.0}};
  test.specimen.rubber_grading = {{3.65e-3, 0.0}, {3.75e-3, 1.0}};
  test.box.length = test.box.width = 0.040;
  test.box.height = 0.030;
  test.shear.normal_stress = 100e3;
  return test;
}

/// Its grains and their dense assembly.
struct MixtureStand {
  GrainList grains;
  DenseAssembly assembly;
};

inline MixtureStand mixture_stand(double rubber_content) {
  const SpecimenOrder o = specimen_order(mixture_case(rubber_content));
  MixtureStand out;
  out.grains = draw_grains(o.specimen, o.box, o.materials.rubber.density, o.solid_density, o.seed);
  out.assembly = make_dense_assembly(out.grains, o.materials, o.box.length, o.box.width, o.seed);
  return out;
}

}  // namespace dem::test
