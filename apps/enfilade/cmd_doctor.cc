// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "apps/enfilade/command.h"
#include "enfilade/pipeline/memory.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string input;
  std::string output = "out";
};

enum class Verdict { kGood, kNote, kBad };

struct Finding {
  Verdict verdict = Verdict::kGood;
  std::string subject;
  std::string text;
};

Finding CheckProcessors() {
  return {Verdict::kGood, "processors", fmt::format("{}", std::thread::hardware_concurrency())};
}

Finding CheckMemory() {
  constexpr double kEnough_mb = 3000;
  const double available_mb = AvailableMemoryMb();
  return {available_mb < kEnough_mb ? Verdict::kNote : Verdict::kGood, "memory",
          fmt::format("{:.0f} MB available; a home of 32 panoramas needs up to {:.0f} MB",
                      available_mb, kEnough_mb)};
}

// Room at the nearest folder that exists at or above `path`.
Finding CheckDisk(const fs::path& path) {
  constexpr double kEnough_mb = 1000;
  fs::path existing = fs::absolute(path);
  while (!fs::exists(existing) && existing.has_relative_path()) existing = existing.parent_path();
  std::error_code error;
  const fs::space_info space = fs::space(existing, error);
  if (error || ::access(existing.c_str(), W_OK) != 0) {
    return {Verdict::kBad, "disk",
            existing.native() + " is not writable; choose another folder with -o"};
  }
  const double available_mb = static_cast<double>(space.available) * 1e-6;
  return {available_mb < kEnough_mb ? Verdict::kBad : Verdict::kGood, "disk",
          fmt::format("{:.0f} MB free at {}", available_mb, existing.native())};
}

// A program that is started only when its feature is asked for.
Finding CheckHelper(const std::string& name, const std::string& purpose) {
  const char* path_list = std::getenv("PATH");
  std::istringstream folders(path_list != nullptr ? path_list : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / name;
    if (::access(program.c_str(), X_OK) == 0) return {Verdict::kGood, name, program.native()};
  }
  return {Verdict::kNote, name, "not found; " + purpose};
}

}  // namespace

Action SetupDoctor(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("-o,--output", arguments->output, "Folder that the result is to go to")
      ->type_name("OUT");
  return [arguments] {
    const std::vector<Finding> findings = {
        CheckProcessors(), CheckMemory(), CheckDisk(arguments->output),
        CheckHelper("colmap", "needed only for pictures without poses")};
    bool is_good = true;
    for (const Finding& finding : findings) {
      static constexpr const char* kVerdicts[] = {"ok", "note", "BAD"};
      std::printf("%-5s %-12s %s\n", kVerdicts[static_cast<size_t>(finding.verdict)],
                  finding.subject.c_str(), finding.text.c_str());
      is_good &= finding.verdict != Verdict::kBad;
    }
    return is_good ? kExitOk : kExitInput;
  };
}

}  // namespace enfilade
