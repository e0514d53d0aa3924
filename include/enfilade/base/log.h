// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace enfilade {

enum class LogLevel { kDebug, kInfo, kWarning, kError };
enum class LogFormat { kText, kJson };

/// Where messages go. Thread-safe. The library logs through RunContext::log() and never prints.
class Log {
 public:
  virtual ~Log() = default;
  virtual void Write(LogLevel level, std::string_view message) = 0;

  void Debug(std::string_view message) { Write(LogLevel::kDebug, message); }
  void Info(std::string_view message) { Write(LogLevel::kInfo, message); }
  void Warning(std::string_view message) { Write(LogLevel::kWarning, message); }
  void Error(std::string_view message) { Write(LogLevel::kError, message); }
};

/// Drops everything: the default of a RunContext.
[[nodiscard]] std::shared_ptr<Log> MakeNullLog();

/// Writes to standard error: plain lines, or one JSON object a line for machines
/// ({"time": …, "level": …, "message": …}).
[[nodiscard]] std::shared_ptr<Log> MakeStderrLog(LogLevel min_level, LogFormat format);

}  // namespace enfilade
