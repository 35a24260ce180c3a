// SPDX-License-Identifier: BSD-3-Clause
// Runs verification cases and says what missed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "dem4grm/verify/cases.hpp"

namespace dem {

/// A case that was run.
struct CaseOutcome {
  const VerificationCase* tested = nullptr;
  Findings findings;
  double seconds = 0.0;  ///< wall time; not part of any result

  [[nodiscard]] int missed() const;
};

/// Runs one case. A case that ends with an error of the library gets one more check, which fails and names the error.
CaseOutcome run_case_of_suite(const VerificationCase& tested);

/// The cases of those names, in the order of the suite; all of the extent when there are no names (`full` includes the
/// quick ones). Throws Error with ExitCode::usage for a name that does not exist, with the names there are.
std::vector<const VerificationCase*> select_cases(const std::vector<std::string>& names, Extent extent);

}  // namespace dem
