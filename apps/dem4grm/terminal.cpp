// SPDX-License-Identifier: BSD-3-Clause
#include "terminal.hpp"

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string_view>

namespace dem {
namespace {

bool has_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return is_error_stream_a_terminal() && !is_dumb && (no_colour == nullptr || *no_colour == '\0');
}

/// A message that begins with the place of its problem says its severity itself.
void print_labelled(std::string_view label, const char* colour, const std::string& message) {
  const bool is_labelled = message.find(": " + std::string(label) + ": ") != std::string::npos;
  if (!is_labelled) {
    if (has_colour()) std::cerr << colour << label << ":\033[0m ";
    if (!has_colour()) std::cerr << label << ": ";
  }
  std::cerr << message << (message.ends_with('\n') ? "" : "\n") << std::flush;
}

}  // namespace

void print_error(const std::string& message) { print_labelled("error", "\033[1;31m", message); }
void print_warning(const std::string& message) { print_labelled("warning", "\033[1;33m", message); }
void print_note(const std::string& message) { print_labelled("note", "\033[1m", message); }

void print_result(const std::string& text) { std::cout << text; }

bool is_error_stream_a_terminal() { return ::isatty(STDERR_FILENO) == 1; }

int terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

std::string clock_text(double utc_seconds, double seconds_ahead) {
  const auto time = static_cast<std::time_t>(utc_seconds + seconds_ahead);
  std::tm parts{};
  if (::localtime_r(&time, &parts) == nullptr) return "?";
  std::array<char, 64> text{};
  const bool is_far = seconds_ahead > 20.0 * 3600.0;
  if (is_far) std::strftime(text.data(), text.size(), "%a %d %b %H:%M", &parts);
  if (!is_far) std::strftime(text.data(), text.size(), "%H:%M", &parts);
  return text.data();
}

std::string duration_text(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
  if (seconds < 100.0 * 3600.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  return fmt::format("{:.1f} days", seconds / 86400.0);
}

}  // namespace dem
