// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <unistd.h>

#include <ctime>
#include <string_view>

#include "dem4grm/core/error.hpp"

namespace dem {

volatile std::sig_atomic_t stop_requested = 0;

namespace {

// A scheduler that ends a job sends its signal to all of its processes, and the script of the job passes it on: two signals,
// one request. Nobody means to kill a run within a second of having asked it to stop.
constexpr std::time_t k_one_request = 1;  // s
std::time_t asked_at = 0;                 // of a clock that is never set back

extern "C" void ask_for_end(int) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (stop_requested == 0) asked_at = now.tv_sec;
  if (stop_requested != 0 && now.tv_sec - asked_at > k_one_request) _exit(static_cast<int>(ExitCode::interrupted));
  stop_requested = 1;
}

}  // namespace

void install_stop_signals() {
  struct sigaction action {};
  action.sa_handler = ask_for_end;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A reader of our output that goes away must not kill a run of hours.
  std::signal(SIGPIPE, SIG_IGN);
  // Beyond a limit of file size a write then fails like on a full disk instead of killing the program.
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace dem
