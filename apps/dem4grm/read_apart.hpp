// SPDX-License-Identifier: BSD-3-Clause
// Reads files in a process of its own: libhdf5 withstands most damage to a file, but some makes it crash (docs/security.md), and a
// crash says nothing to a user.
#pragma once

#include <functional>
#include <string>

namespace dem {

/// How the process that read ended; main ends the program with it, since everything was said already.
struct ReaderEnded {
  int exit_code = 0;
};

/// Does the work in a child process, which prints its own results and errors. Throws ReaderEnded when it ended with another exit code
/// than 0, and IoError that names `what` when it died of a signal. Without a child (no more processes) the work is done here.
void read_apart(const std::string& what, const std::function<void()>& work);

}  // namespace dem
