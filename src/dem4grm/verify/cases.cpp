// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/cases.hpp"

namespace dem {

const std::vector<VerificationCase>& verification_cases() {
  static const std::vector<VerificationCase> all = [] {
    std::vector<VerificationCase> cases;
    add_impact_cases(cases);
    add_oblique_cases(cases);
    add_contact_cases(cases);
    add_bond_cases(cases);
    add_grain_cases(cases);
    add_body_cases(cases);
    add_clump_cases(cases);
    add_damping_cases(cases);
    add_stability_cases(cases);
    add_assembly_limit_cases(cases);
    add_energy_cases(cases);
    add_packing_cases(cases);
    return cases;
  }();
  return all;
}

}  // namespace dem
