// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>

namespace enfilade {
namespace {

class NullLog final : public Log {
 public:
  void Write(LogLevel, std::string_view) override {}
};

spdlog::level::level_enum ToSpdlog(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return spdlog::level::debug;
    case LogLevel::kInfo:
      return spdlog::level::info;
    case LogLevel::kWarning:
      return spdlog::level::warn;
    case LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

class StderrLog final : public Log {
 public:
  StderrLog(LogLevel min_level, LogFormat format)
      : format_(format), logger_("enfilade", std::make_shared<spdlog::sinks::stderr_sink_mt>()) {
    logger_.set_level(ToSpdlog(min_level));
    logger_.flush_on(spdlog::level::trace);
    logger_.set_pattern(format == LogFormat::kJson
                            ? R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","message":%v})"
                            : "%v");
  }

  void Write(LogLevel level, std::string_view message) override {
    if (format_ == LogFormat::kJson) {
      using Json = nlohmann::json;
      const std::string quoted =
          Json(std::string(message)).dump(-1, ' ', false, Json::error_handler_t::replace);
      logger_.log(ToSpdlog(level), "{}", quoted);
    } else if (level >= LogLevel::kWarning) {
      logger_.log(ToSpdlog(level), "{}: {}", level == LogLevel::kError ? "error" : "warning",
                  message);
    } else {
      logger_.log(ToSpdlog(level), "{}", message);
    }
  }

 private:
  LogFormat format_;
  spdlog::logger logger_;
};

}  // namespace

std::shared_ptr<Log> MakeNullLog() { return std::make_shared<NullLog>(); }

std::shared_ptr<Log> MakeStderrLog(LogLevel min_level, LogFormat format) {
  return std::make_shared<StderrLog>(min_level, format);
}

}  // namespace enfilade
