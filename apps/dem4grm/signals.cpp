// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "dem4grm/core/error.hpp"
#include "dem4grm/runs/stop_cause.hpp"

namespace dem {

volatile std::sig_atomic_t stop_requested = k_no_stop;
volatile std::sig_atomic_t save_requested = 0;

namespace {

// A scheduler that ends a job sends its signal to all of its processes, and the script of the job passes it on: two signals,
// one request. Nobody means to kill a run within a second of having asked it to stop.
constexpr std::time_t k_one_request = 1;  // s
std::time_t asked_at = 0;                 // of a clock that is never set back

extern "C" void ask_for_end(int signal) {
  if (signal == SIGALRM || signal == SIGXCPU) {
    // Limits are no second request, and the processor's comes again every second.
    if (stop_requested == k_no_stop)
      stop_requested = signal == SIGALRM ? k_stop_at_time_limit : k_stop_at_processor_limit;
    return;
  }
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  if (asked_at == 0) asked_at = now.tv_sec;
  if (now.tv_sec - asked_at > k_one_request) _exit(static_cast<int>(ExitCode::interrupted));
  if (stop_requested == k_no_stop) stop_requested = k_stop_on_request;
}

extern "C" void ask_for_checkpoint(int) { save_requested = 1; }

enum class Ignored { stays, is_heard };

void listen(int signal, void (*handler)(int), Ignored ignored) {
  struct sigaction action {};
  if (ignored == Ignored::stays && sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) return;
  action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

/// Counts time that passes, whatever is done to the clock meanwhile.
void set_alarm(double hours) {
  constexpr double k_longest = 3e7;  // s, a year
  const double seconds = std::min(3600.0 * hours, k_longest);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = std::max<suseconds_t>(1, std::lround(1e6 * (seconds - std::floor(seconds))) % 1000000);
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

void install_signals(double most_hours) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) listen(signal, ask_for_end, Ignored::stays);
  for (const int signal : {SIGXCPU, SIGALRM}) listen(signal, ask_for_end, Ignored::is_heard);
  listen(SIGUSR1, ask_for_checkpoint, Ignored::is_heard);
  // A reader of our output that goes away must not kill a run of hours.
  std::signal(SIGPIPE, SIG_IGN);
  // Beyond a limit of file size a write then fails like on a full disk instead of killing the program.
  std::signal(SIGXFSZ, SIG_IGN);
  if (most_hours > 0.0) set_alarm(most_hours);
}

}  // namespace dem
