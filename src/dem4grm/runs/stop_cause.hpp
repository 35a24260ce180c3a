// SPDX-License-Identifier: BSD-3-Clause
// Why a run was asked to end before its end; a flag that a signal handler sets holds one of these.
#pragma once

#include <csignal>

namespace dem {

enum StopCause : std::sig_atomic_t {
  k_no_stop = 0,
  k_stop_on_request,
  k_stop_at_time_limit,
  k_stop_at_processor_limit
};

/// Ends the sentence "stopped ...".
constexpr const char* stop_words(std::sig_atomic_t cause) {
  switch (cause) {
    case k_stop_at_time_limit:
      return "after the hours that --max-hours allows";
    case k_stop_at_processor_limit:
      return "at the limit of processor time (SIGXCPU)";
    default:
      return "on request";
  }
}

}  // namespace dem
