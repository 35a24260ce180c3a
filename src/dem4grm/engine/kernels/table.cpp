// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/engine/kernels/kernels.hpp"

namespace dem::DEM_TARGET {

extern const Kernels k_kernels;
const Kernels k_kernels{&evaluate_ball_contacts, &evaluate_early_contacts, &evaluate_wall_contacts,
                        &advance_rubber_grains,  &advance_clumps,          &evaluate_bonds_alone,
                        &sum_contacts_alone};

}  // namespace dem::DEM_TARGET
