// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/run_log.hpp"

#include <spdlog/logger.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {

struct RunLog::Logger {
  explicit Logger(const std::filesystem::path& path)
      : log("run", std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string())) {
    // In UTC as all times in the folder; runs move between machines.
    log.set_formatter(
        std::make_unique<spdlog::pattern_formatter>("%Y-%m-%dT%H:%M:%S.%eZ %l: %v", spdlog::pattern_time_type::utc));
    log.flush_on(spdlog::level::info);
    log.set_error_handler([](const std::string&) {});
  }
  spdlog::logger log;
};

RunLog::RunLog(const std::filesystem::path& path) {
  try {
    logger_ = std::make_unique<Logger>(path);
  } catch (const spdlog::spdlog_ex& e) {
    throw IoError(fmt::format("{}: cannot be written: {}", path.string(), e.what()));
  }
}

RunLog::~RunLog() = default;

void RunLog::info(const std::string& text) { logger_->log.info("{}", text); }
void RunLog::warning(const std::string& text) { logger_->log.warn("{}", text); }
void RunLog::error(const std::string& text) { logger_->log.error("{}", text); }

}  // namespace dem
