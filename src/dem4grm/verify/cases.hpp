// SPDX-License-Identifier: BSD-3-Clause
// The verification cases: every law, rule and scheme of the model, run through the engine and held against numbers that
// this project did not make.
#pragma once

#include <string>
#include <vector>

#include "dem4grm/verify/findings.hpp"

namespace dem {

/// Which runs include a case.
enum class Extent {
  quick,  ///< seconds: part of the default tests
  full,   ///< longer
};

/// One case of the suite.
struct VerificationCase {
  std::string name;   ///< in words joined by hyphens, unique; `dem4grm verify --only NAME`
  std::string title;  ///< heading in the manual
  /// Markdown for the manual: what is set up, the formula with its symbols and units, what each check depends on.
  std::string text;
  Extent extent = Extent::quick;
  void (*run)(Findings&) = nullptr;
};

/// All cases in the order of the manual.
const std::vector<VerificationCase>& verification_cases();

// One function for each file of cases; each appends its own.
void add_impact_cases(std::vector<VerificationCase>& cases);
void add_oblique_cases(std::vector<VerificationCase>& cases);
void add_contact_cases(std::vector<VerificationCase>& cases);
void add_bond_cases(std::vector<VerificationCase>& cases);
void add_grain_cases(std::vector<VerificationCase>& cases);
void add_body_cases(std::vector<VerificationCase>& cases);
void add_clump_cases(std::vector<VerificationCase>& cases);
void add_damping_cases(std::vector<VerificationCase>& cases);
void add_stability_cases(std::vector<VerificationCase>& cases);
void add_assembly_limit_cases(std::vector<VerificationCase>& cases);
void add_energy_cases(std::vector<VerificationCase>& cases);
void add_packing_cases(std::vector<VerificationCase>& cases);

}  // namespace dem
