// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <unistd.h>

#include <string_view>

#include "dem4grm/core/error.hpp"

namespace dem {

volatile std::sig_atomic_t stop_requested = 0;

namespace {

extern "C" void ask_for_end(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::interrupted));
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
