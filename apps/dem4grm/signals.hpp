// SPDX-License-Identifier: BSD-3-Clause
// SIGINT and SIGTERM ask for an end; another one ends at once, unless it comes so soon that it is of the same request.
#pragma once

#include <csignal>

namespace dem {

/// Not zero once an end was asked for.
extern volatile std::sig_atomic_t stop_requested;

void install_stop_signals();

}  // namespace dem
