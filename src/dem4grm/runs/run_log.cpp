// SPDX-License-Identifier: BSD-3-Clause
#include "dem4grm/runs/run_log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <fmt/format.h>

#include "dem4grm/core/error.hpp"

namespace dem {

struct RunLog::Logger {
  explicit Logger(const std::filesystem::path& path)
      : log("run", std::make_shared<spdlog::sinks::basic_file_sink_st>(path.string())) {
    log.set_pattern("%Y-%m-%dT%H:%M:%S.%e %l: %v");
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
