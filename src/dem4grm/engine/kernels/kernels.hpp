// SPDX-License-Identifier: BSD-3-Clause
// The stages of a step that were compiled for one kind of processor.
#pragma once

#include <span>

#include "dem4grm/engine/kernels/target.hpp"
#include "dem4grm/engine/simulation.hpp"

namespace dem {

struct Kernels {
  void (*evaluate_ball_contacts)(Simulation&);
  void (*evaluate_early_contacts)(Simulation&);
  void (*evaluate_wall_contacts)(Simulation&);
  void (*advance_rubber_grains)(Simulation&);
  void (*advance_clumps)(Simulation&);
  // Parts of advance_rubber_grains by themselves, for measurements; one number of every block is kept, so that no loop
  // can be left out by the compiler.
  void (*evaluate_bonds_alone)(Simulation&, std::span<double> kept);
  void (*sum_contacts_alone)(Simulation&, std::span<double> kept);
};

/// Those in force (engine/kernel_target.hpp).
const Kernels& kernels();

namespace DEM_TARGET {
void evaluate_ball_contacts(Simulation& s);
void evaluate_early_contacts(Simulation& s);
void evaluate_wall_contacts(Simulation& s);
void advance_rubber_grains(Simulation& s);
void advance_clumps(Simulation& s);
void evaluate_bonds_alone(Simulation& s, std::span<double> kept);
void sum_contacts_alone(Simulation& s, std::span<double> kept);
}  // namespace DEM_TARGET

}  // namespace dem
