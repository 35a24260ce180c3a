// SPDX-License-Identifier: BSD-3-Clause
// Runs another program and keeps what it prints.
#pragma once

#include <string>
#include <vector>

namespace dem {

struct CommandOutput {
  int exit_code = 0;  ///< 128 + number of a signal that killed it
  std::string out, err;
};

/// Runs a program, found as a shell finds it, with these arguments and without a shell; waits for its end. Throws IoError
/// when it cannot be started.
CommandOutput output_of(const std::vector<std::string>& command);

}  // namespace dem
