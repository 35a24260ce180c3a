// SPDX-License-Identifier: BSD-3-Clause
// What the outside may tell a running program. SIGINT, SIGTERM and SIGHUP ask for an end, SIGXCPU and the end of --max-hours too;
// another request ends at once, unless it comes so soon that it is of the same one. SIGUSR1 asks for a checkpoint.
#pragma once

#include <csignal>

namespace dem {

/// A StopCause (runs/stop_cause.hpp), not zero once an end was asked for.
extern volatile std::sig_atomic_t stop_requested;
/// Not zero while a checkpoint is asked for; who writes it sets it back.
extern volatile std::sig_atomic_t save_requested;

/// most_hours: of time on the clock from now on, after which an end is asked for; 0: no limit. SIGINT, SIGTERM and SIGHUP stay
/// ignored where the caller had them ignored (nohup, a shell that puts jobs in the background).
void install_signals(double most_hours = 0.0);

}  // namespace dem
