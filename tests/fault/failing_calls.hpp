// SPDX-License-Identifier: BSD-3-Clause
// System calls of this program that fail, or kill it, at a chosen number: every call of a writer in turn.
//
// The functions of the C library that open, write, sync, rename and close files are defined anew in failing_calls.cpp; HDF5 and
// the C++ library call those too. They pass on to the real ones until the chosen call.
#pragma once

#include <functional>
#include <string>

namespace dem::test {

enum class Fault { kill, error, full_disk };

/// How a child process ended in which the work ran.
struct FaultEnd {
  bool was_due = false;  ///< the chosen call came
  bool was_killed = false;
  int exit_code = 0;  ///< of the work: 0, or the exit code of the Error that it threw
  std::string calls;  ///< names of the calls up to its end, in order, a space behind each
};

/// Runs the work in a child process whose call number `at` (from 1) of the ones above is hit by the fault.
FaultEnd run_with_fault(Fault fault, int at, const std::function<void()>& work);

}  // namespace dem::test
