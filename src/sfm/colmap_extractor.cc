// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/colmap_extractor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "enfilade/base/child_program.h"
#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/sfm/colmap_database.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kOctaveResolution = 3;
// More than a view has: whoever pools the views limits the features of the panorama as a whole.
constexpr int kMaxFeatures = 100000;

// The shortest text that reads back the same, whatever the locale.
std::string NumberText(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// Tells the sink how many pictures COLMAP says to have worked on.
class LogProgress {
 public:
  LogProgress(ProgressSink* sink, fs::path log, size_t total)
      : sink_(sink), log_(std::move(log)), total_(static_cast<int64_t>(total)) {}

  void Look() {
    if (sink_ == nullptr) return;
    constexpr std::string_view kMark = "Processed file [";
    const std::string text = ReadFile(log_);
    int64_t count = 0;
    for (size_t at = text.find(kMark); at != std::string::npos; at = text.find(kMark, at + 1)) {
      ++count;
    }
    // The last one is reported when the program has ended.
    if (count > done_ && count < total_) Report(count);
  }
  void Finish() {
    if (sink_ != nullptr) Report(total_);
  }

 private:
  void Report(int64_t done) {
    done_ = done;
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    sink_->Report("find features", done, total_,
                  elapsed * static_cast<double>(total_ - done) / static_cast<double>(done));
  }

  ProgressSink* sink_;
  fs::path log_;
  int64_t total_;
  int64_t done_ = 0;
  Clock::time_point start_ = Clock::now();
};

// The last line of the log that is no part of a stack trace.
std::string LastWords(const fs::path& log) {
  const std::string text = ReadFile(log);
  std::string words;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const size_t start = std::min(text.find_first_not_of(" \t", at), end);
    const std::string line = text.substr(start, end - start);
    if (!line.empty() && !line.starts_with("@ ") && !line.starts_with("***")) words = line;
    at = end + 1;
  }
  return words.empty() ? "no word" : words;
}

[[noreturn]] void ThrowColmapError(const ColmapExtractorRun& run, const std::string& problem) {
  throw DependencyError(
      run.program.native(), problem + " (its last words: " + LastWords(run.log) + ")",
      "see " + run.log.native() + ", install COLMAP 3.8 or use --sfm.features.source opencv");
}

std::vector<std::string> Arguments(const ColmapExtractorRun& run, const fs::path& picture_list,
                                   int num_threads) {
  const Camera& camera = run.camera;
  std::vector<std::string> arguments{"feature_extractor",
                                     "--database_path=" + run.database.native(),
                                     "--image_path=" + run.views.native(),
                                     "--image_list_path=" + picture_list.native(),
                                     "--ImageReader.single_camera=1",
                                     "--ImageReader.camera_model=PINHOLE",
                                     "--ImageReader.camera_params=" + NumberText(camera.fx) + "," +
                                         NumberText(camera.fy) + "," + NumberText(camera.cx) + "," +
                                         NumberText(camera.cy),
                                     "--SiftExtraction.use_gpu=0",
                                     "--SiftExtraction.num_threads=" + std::to_string(num_threads)};
  const std::vector<std::string> sift = ColmapSiftArguments(camera, run.min_contrast);
  arguments.insert(arguments.end(), sift.begin(), sift.end());
  std::error_code ignored;
  if (fs::exists(run.database, ignored)) {
    if (const auto id = ColmapDatabase(run.database).FindCamera(camera); id) {
      arguments.push_back("--ImageReader.existing_camera_id=" + std::to_string(*id));
    }
  }
  return arguments;
}

// COLMAP succeeds whatever becomes of single pictures.
void CheckNoneIsMissing(const ColmapExtractorRun& run) {
  const std::set<std::string> known = ReadPicturesWithFeatures(run.database);
  const auto num_missing =
      std::count_if(run.pictures.begin(), run.pictures.end(),
                    [&](const std::string& name) { return !known.contains(name); });
  if (num_missing == 0) return;
  ThrowColmapError(run, "left out " + std::to_string(num_missing) + " of " +
                            std::to_string(run.pictures.size()) + " pictures");
}

}  // namespace

std::vector<std::string> ColmapSiftArguments(const Camera& camera, double min_contrast) {
  // As OpenCV, which goes on until an octave is about four pixels wide and divides the contrast by
  // the layers of an octave.
  const int shorter_side = std::min(camera.width, camera.height);
  const int num_octaves = std::max(1, static_cast<int>(std::lround(std::log2(shorter_side))) - 1);
  const int longer_side = std::max(camera.width, camera.height);
  return {"--descriptor_normalization=l1_root",
          "--SiftExtraction.max_image_size=" + std::to_string(longer_side),
          "--SiftExtraction.max_num_features=" + std::to_string(kMaxFeatures),
          "--SiftExtraction.first_octave=-1",
          "--SiftExtraction.num_octaves=" + std::to_string(num_octaves),
          "--SiftExtraction.octave_resolution=" + std::to_string(kOctaveResolution),
          "--SiftExtraction.peak_threshold=" + NumberText(min_contrast / kOctaveResolution),
          "--SiftExtraction.edge_threshold=10",
          "--SiftExtraction.upright=1"};
}

void RunColmapExtractor(const ColmapExtractorRun& run, RunContext& context) {
  std::string list;
  for (const std::string& name : run.pictures) list += name + "\n";
  const fs::path list_path = run.views / "pictures.txt";
  WriteFileAtomic(list_path, list);
  LogProgress progress(context.progress_sink(), run.log, run.pictures.size());
  const ProgramEnd end =
      RunProgram(run.program, Arguments(run, list_path, context.num_threads()), run.log, [&] {
        context.CheckStop();
        progress.Look();
      });
  if (!end.IsSuccess()) ThrowColmapError(run, "failed with " + end.Text());
  CheckNoneIsMissing(run);
  progress.Finish();
}

}  // namespace enfilade
