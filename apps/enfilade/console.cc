// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "apps/enfilade/console.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace enfilade {
namespace {

using Clock = std::chrono::steady_clock;

std::string TimeLeftText(double seconds) {
  if (seconds < 0) return "";
  const auto whole = static_cast<int64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format(", {} s left", whole);
  if (whole < 3600) return fmt::format(", {} min {:02} s left", whole / 60, whole % 60);
  return fmt::format(", {} h {:02} min left", whole / 3600, whole / 60 % 60);
}

// One line that is rewritten in place. Messages erase it first.
class TerminalLine final : public Log, public ProgressSink {
 public:
  explicit TerminalLine(std::shared_ptr<Log> log) : log_(std::move(log)) {}

  void Write(LogLevel level, std::string_view message) override {
    const std::lock_guard lock(mutex_);
    Erase();
    log_->Write(level, message);
  }

  void Report(std::string_view what, int64_t done, int64_t total, double seconds_left) override {
    const std::lock_guard lock(mutex_);
    Erase();
    if (done >= total) return;
    const int64_t filled = kBarWidth * done / total;
    const std::string bar = std::string(static_cast<size_t>(filled), '#') +
                            std::string(static_cast<size_t>(kBarWidth - filled), '.');
    const std::string line =
        fmt::format("{} [{}] {}/{}{}", what, bar, done, total, TimeLeftText(seconds_left));
    std::fputs(line.c_str(), stderr);
    is_shown_ = true;
  }

 private:
  static constexpr int64_t kBarWidth = 24;

  void Erase() {
    if (is_shown_) std::fputs("\r\033[K", stderr);
    is_shown_ = false;
  }

  std::shared_ptr<Log> log_;
  std::mutex mutex_;
  bool is_shown_ = false;
};

// A line now and then, so that log files stay short.
class PlainLines final : public ProgressSink {
 public:
  explicit PlainLines(std::shared_ptr<Log> log) : log_(std::move(log)) {}

  void Report(std::string_view what, int64_t done, int64_t total, double seconds_left) override {
    const auto now = Clock::now();
    if (done >= total || now - last_ < std::chrono::seconds(10)) return;
    last_ = now;
    log_->Info(fmt::format("{}: {} of {}{}", what, done, total, TimeLeftText(seconds_left)));
  }

 private:
  std::shared_ptr<Log> log_;
  Clock::time_point last_ = Clock::now();
};

// {"time": …, "level": "progress", "what": …, "done": …, "total": …, "seconds_left": …}
class JsonLines final : public ProgressSink {
 public:
  void Report(std::string_view what, int64_t done, int64_t total, double seconds_left) override {
    using Json = nlohmann::json;
    const auto now = std::chrono::system_clock::now();
    const Json json = {
        {"time", fmt::format("{:%Y-%m-%dT%H:%M:%S}Z",
                             fmt::gmtime(std::chrono::system_clock::to_time_t(now)))},
        {"level", "progress"},
        {"what", what},
        {"done", done},
        {"total", total},
        {"seconds_left", seconds_left < 0 ? Json() : Json(seconds_left)}};
    const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    std::fputs(line.c_str(), stderr);
  }
};

}  // namespace

Console MakeConsole(LogFormat format) {
  const std::shared_ptr<Log> log = MakeStderrLog(LogLevel::kInfo, format);
  if (format == LogFormat::kJson) return {log, std::make_shared<JsonLines>()};
  if (::isatty(STDERR_FILENO) == 0) return {log, std::make_shared<PlainLines>(log)};
  const auto line = std::make_shared<TerminalLine>(log);
  return {line, line};
}

}  // namespace enfilade
