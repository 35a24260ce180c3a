// SPDX-License-Identifier: BSD-3-Clause
// The complete mechanical state of a simulation for a checkpoint.
#pragma once

#include "dem4grm/core/state_archive.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

/// Saves the state, or loads it into a simulation of the same scene (materials, numbers of grains, shapes, walls). A
/// loaded simulation goes on with the same bits as the saved one. Constants of materials and shapes are not part of it:
/// they follow from the scene. Loading throws IoError when the state does not fit the simulation.
void exchange(StateArchive& archive, Simulation& s);

/// Energies, for records that count from a start.
void exchange(StateArchive& archive, EnergyReport& e);

}  // namespace dem
