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
#include "enfilade/base/errors.h"
#include "enfilade/exchange/scene_reader.h"
#include "enfilade/image/codec.h"
#include "enfilade/pipeline/memory.h"
#include "enfilade/pipeline/memory_need.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string input;
  std::string output = "out";
  SceneReadOptions reading;
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

Finding CheckMemory(double need_mb) {
  const double available_mb = AvailableMemoryMb();
  return {available_mb < need_mb ? Verdict::kBad : Verdict::kGood, "memory",
          fmt::format("{:.0f} MB available, at least {:.0f} MB needed", available_mb, need_mb)};
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

std::string DescribeScene(const SceneReadReport& read) {
  const Scene& scene = read.scene;
  const Camera& camera = scene.views.front().camera;
  return fmt::format("{} of {} with poses from {}, scale from {}, the first {} x {} pixels",
                     scene.views.size(), read.num_pictures_found, PrintablePath(read.pose_file),
                     EnumNames(scene.scale_source)[static_cast<size_t>(scene.scale_source)],
                     camera.width, camera.height);
}

// Reads headers, poses and hashes and decodes every picture once. Sets `need_mb` for what it finds.
std::vector<Finding> CheckPictures(const Arguments& arguments, double& need_mb) {
  std::vector<Finding> findings;
  RunContext context;
  try {
    const SceneReadReport read = ReadScene(arguments.input, arguments.reading, context);
    findings.push_back({Verdict::kGood, "pictures", DescribeScene(read)});
    for (const std::string& warning : read.warnings) {
      findings.push_back({Verdict::kNote, "pictures", warning});
    }
    need_mb = LeastMemoryMb(read.scene, context.num_threads());
    for (const View& view : read.scene.views) (void)ReadImageRgb(view.path);
  } catch (const UserError& error) {
    findings.push_back({Verdict::kBad, "pictures", error.what()});
  }
  return findings;
}

std::vector<Finding> Examine(const Arguments& arguments) {
  double need_mb = 0;
  std::vector<Finding> findings;
  if (!arguments.input.empty()) findings = CheckPictures(arguments, need_mb);
  findings.push_back(CheckProcessors());
  findings.push_back(CheckMemory(need_mb));
  findings.push_back(CheckDisk(arguments.output));
  findings.push_back(CheckHelper("colmap", "needed only for pictures without poses"));
  return findings;
}

}  // namespace

Action SetupDoctor(CLI::App& parser) {
  const auto arguments = std::make_shared<Arguments>();
  parser.add_option("PATH", arguments->input, "Folder with the panoramas and their poses");
  parser.add_option("-o,--output", arguments->output, "Folder that the result is to go to")
      ->type_name("OUT");
  parser.add_option("--poses", arguments->reading.poses, "Pose file or COLMAP folder")
      ->type_name("FILE");
  return [arguments] {
    bool is_good = true;
    for (const Finding& finding : Examine(*arguments)) {
      static constexpr const char* kVerdicts[] = {"ok", "note", "BAD"};
      std::printf("%-5s %-12s %s\n", kVerdicts[static_cast<size_t>(finding.verdict)],
                  finding.subject.c_str(), finding.text.c_str());
      is_good &= finding.verdict != Verdict::kBad;
    }
    return is_good ? kExitOk : kExitInput;
  };
}

}  // namespace enfilade
