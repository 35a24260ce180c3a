// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/verify/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "dem4grm/core/error.hpp"

namespace dem {

int CaseOutcome::missed() const {
  const auto& checks = findings.checks();
  return static_cast<int>(std::count_if(checks.begin(), checks.end(), [](const Check& c) { return !c.passes(); }));
}

CaseOutcome run_case_of_suite(const VerificationCase& tested) {
  CaseOutcome outcome;
  outcome.tested = &tested;
  const auto start = std::chrono::steady_clock::now();
  try {
    tested.run(outcome.findings);
    if (outcome.findings.checks().empty()) outcome.findings.at_least("number of checks", "1", 1, 0, "this suite");
  } catch (const Error& error) {
    outcome.findings.at_least(fmt::format("runs to its end ({})", error.what()), "1", 1, 0, "this suite");
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::vector<const VerificationCase*> select_cases(const std::vector<std::string>& names, Extent extent) {
  std::string known;
  for (const VerificationCase& c : verification_cases()) known += "\n  " + c.name;
  for (const std::string& name : names) {
    const auto& all = verification_cases();
    if (std::none_of(all.begin(), all.end(), [&](const VerificationCase& c) { return c.name == name; })) {
      throw Error(ExitCode::usage, fmt::format("no verification case '{}'; there are:{}", name, known));
    }
  }
  std::vector<const VerificationCase*> chosen;
  for (const VerificationCase& c : verification_cases()) {
    const bool is_named = std::find(names.begin(), names.end(), c.name) != names.end();
    if (names.empty() ? (extent == Extent::full || c.extent == Extent::quick) : is_named) chosen.push_back(&c);
  }
  return chosen;
}

}  // namespace dem
