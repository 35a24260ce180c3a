// SPDX-License-Identifier: BSD-3-Clause
// What the watchdog of a shear test finds in its books, beside what it finds in the grains (engine/watchdog.hpp).
#pragma once

#include <span>

#include "dem4grm/lab/observer.hpp"

namespace dem {

/// Throws PhysicsError when the grains move with more kinetic energy (J) than they were ever given: what moves must have got it from the
/// walls or from what was stored, and an unstable step makes it from nothing. One ball that is thrown out makes it many times as much.
/// `displacement` (m) is for the message.
void check_kinetic_energy(double kinetic, double given, double displacement);

/// Throws PhysicsError when the mean normal stress over the last 1 mm of displacement (m) is more than 30 % off its target (Pa): a plate
/// that is far from its stress for long makes another test than the one that was asked for. The rows begin behind the displacement `begin`;
/// says nothing within the first millimetre after it.
void check_plate_stress(std::span<const ShearRow> rows, double displacement, double target, double begin = 0.0);

}  // namespace dem
