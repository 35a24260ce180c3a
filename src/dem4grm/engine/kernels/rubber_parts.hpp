// SPDX-License-Identifier: BSD-3-Clause
// The parts of advance_rubber_grains that have files of their own, compiled for the same target.
#pragma once

#include "dem4grm/engine/kernels/grain_block.hpp"
#include "dem4grm/engine/kernels/target.hpp"

namespace dem::DEM_TARGET {

/// Contacts of a block that waited until it is advanced (ball_contacts.cpp).
void evaluate_waiting_contacts(Simulation& s, std::size_t block);

/// Adds the works of the contacts of two rubber balls to the ledger, in the order of their batches.
void add_works_of_rubber(Simulation& s);

/// Contacts of second neighbours within the grains of one block, with their history (second_neighbours.cpp).
void add_second_neighbours(Simulation& s, std::size_t block, const GrainBlock& g, BlockForces& out,
                           BlockLosses& losses);

/// Bonds of one block in the history-free form (grain_bonds.cpp).
void add_history_free_bonds(const BondParameters& p, const GrainBlock& g, double dt, BlockForces& out,
                            BlockLosses& losses);

/// What a case asks for beside the bonds of one block: linear springs with friction, or Hertz contacts
/// (bond_companion.cpp).
void add_bond_companions(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses);

/// Bonds of one block in the incremental form; broken pairs become Hertz contacts in the same step.
void add_incremental_bonds(Simulation& s, std::size_t block, BlockForces& out, BlockLosses& losses);

}  // namespace dem::DEM_TARGET
