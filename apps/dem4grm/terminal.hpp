// SPDX-License-Identifier: BSD-3-Clause
// How the program speaks: results on stdout, everything else on stderr.
#pragma once

#include <string>

namespace dem {

/// "error: ..." on stderr, coloured on a terminal unless NO_COLOR is set.
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_note(const std::string& message);
/// On stdout.
void print_result(const std::string& text);

/// True when lines on stderr may be written over.
bool is_error_stream_a_terminal();
/// Columns of the terminal; 80 when unknown.
int terminal_width();

/// Local clock time so many seconds after a moment (s since 1970); with the day when it is more than 20 hours ahead.
std::string clock_text(double utc_seconds, double seconds_ahead);

/// "50 s", "12 min", "3.4 h" or "5.0 days".
std::string duration_text(double seconds);

}  // namespace dem
