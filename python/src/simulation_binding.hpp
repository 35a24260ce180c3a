// SPDX-License-Identifier: BSD-3-Clause
// What the bindings of OwnTest share; each function adds one group of methods to the class.
#pragma once

#include <pybind11/pybind11.h>

#include <array>

#include "dem4grm/core/vec3.hpp"
#include "own_test.hpp"

namespace dem {

using Triple = std::array<double, 3>;
using OwnClass = pybind11::class_<OwnTest>;

inline Vec3 vector(const Triple& t) { return {t[0], t[1], t[2]}; }
inline Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }

void bind_materials(pybind11::module_& m);
/// Grains, walls and settings before the first step.
void bind_building(OwnClass& own);
/// Stepping, what there is, checkpoints.
void bind_state(OwnClass& own);
/// Walls, loaded plates, motions, friction.
void bind_walls(OwnClass& own);

}  // namespace dem
