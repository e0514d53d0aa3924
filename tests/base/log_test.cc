// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/log.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

namespace enfilade {
namespace {

using testing::MatchesRegex;

std::string Captured(LogLevel min_level, LogFormat format, const std::function<void(Log&)>& write) {
  testing::internal::CaptureStderr();
  write(*MakeStderrLog(min_level, format));
  return testing::internal::GetCapturedStderr();
}

TEST(StderrLog, PlainLines) {
  const std::string text = Captured(LogLevel::kInfo, LogFormat::kText, [](Log& log) {
    log.Debug("hidden");
    log.Info("32 panoramas {} %v");
    log.Warning("no scale");
    log.Error("no disk");
  });
  EXPECT_EQ(text, "32 panoramas {} %v\nwarning: no scale\nerror: no disk\n");
}

TEST(StderrLog, LevelHidesTheLower) {
  const std::string text = Captured(LogLevel::kError, LogFormat::kText, [](Log& log) {
    log.Warning("hidden");
    log.Error("shown");
  });
  EXPECT_EQ(text, "error: shown\n");
}

TEST(StderrLog, OneJsonObjectALine) {
  const std::string text = Captured(LogLevel::kDebug, LogFormat::kJson, [](Log& log) {
    log.Debug("quote \" and\nnewline");
    log.Warning("bad \xff byte");
  });
  std::istringstream lines(text);
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  const auto first = nlohmann::json::parse(line);
  EXPECT_EQ(first["level"], "debug");
  EXPECT_EQ(first["message"], "quote \" and\nnewline");
  EXPECT_THAT(first["time"].get<std::string>(),
              MatchesRegex("[0-9-]+T[0-9:]+\\.[0-9]{3}[+-][0-9]{2}:[0-9]{2}"));
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(nlohmann::json::parse(line)["level"], "warning");
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(StderrLog, ThreadsDoNotMixLines) {
  const std::string text = Captured(LogLevel::kInfo, LogFormat::kText, [](Log& log) {
    std::vector<std::jthread> writers;
    for (int t = 0; t < 4; ++t) {
      writers.emplace_back([&] {
        for (int i = 0; i < 50; ++i) log.Info("abcdefghijklmnopqrstuvwxyz");
      });
    }
  });
  std::istringstream lines(text);
  int num_lines = 0;
  for (std::string line; std::getline(lines, line); ++num_lines) {
    EXPECT_EQ(line, "abcdefghijklmnopqrstuvwxyz");
  }
  EXPECT_EQ(num_lines, 200);
}

TEST(NullLog, IsSilent) {
  testing::internal::CaptureStderr();
  MakeNullLog()->Error("nothing");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace enfilade
