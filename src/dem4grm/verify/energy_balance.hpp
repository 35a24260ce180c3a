// SPDX-License-Identifier: BSD-3-Clause
// The balance of energy of a scene between walls, as numbers and as levels of a picture.
#pragma once

#include <string>
#include <utility>

#include "dem4grm/engine/simulation.hpp"
#include "dem4grm/verify/findings.hpp"

namespace dem::verify {

/// Where the work of the walls went, J.
struct EnergyBalance {
  double strain = 0.0, kinetic = 0.0;               ///< stored
  double damping = 0.0, dashpot = 0.0, slip = 0.0;  ///< lost
  double work = 0.0;                                ///< of the walls
  [[nodiscard]] double sum() const { return strain + kinetic + damping + dashpot + slip; }
};

/// `start`: the stored energies when losses and work began to be counted.
inline EnergyBalance balance_of(const EnergyReport& now, const EnergyReport& start = {}) {
  return {now.contact_strain + now.bond_strain - start.contact_strain - start.bond_strain,
          now.kinetic - start.kinetic,
          now.local_damping,
          now.dashpot,
          now.slip,
          now.boundary_work};
}

/// Without points yet; the parts are drawn one upon the other, the work of the walls apart.
inline Picture energy_picture(std::string name, std::string title, std::string x_label) {
  return {std::move(name),
          std::move(title),
          std::move(x_label),
          "energy (mJ)",
          {{"strain", false, {}, {}},
           {"+ kinetic", false, {}, {}},
           {"+ local damping", false, {}, {}},
           {"+ dashpots", false, {}, {}},
           {"+ slip", false, {}, {}},
           {"work of the walls", true, {}, {}}}};
}

inline void add_levels(Picture& picture, double x, const EnergyBalance& b) {
  const double parts[] = {b.strain, b.kinetic, b.damping, b.dashpot, b.slip};
  double level = 0.0;
  for (std::size_t i = 0; i < 6; ++i) {
    if (i < 5) level += parts[i];
    picture.series[i].x.push_back(x);
    picture.series[i].y.push_back((i < 5 ? level : b.work) * 1e3);
  }
}

}  // namespace dem::verify
