// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/patch_reader.h"

#include <algorithm>
#include <optional>
#include <string>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/cloud_point.h"
#include "src/exchange/ply_points.h"
#include "src/exchange/text_words.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// The shortest that a patch can be in text: its keyword, eleven numbers and two counts.
constexpr size_t kLeastPatchBytes = 6 + 2 * 13;
constexpr int64_t kMaxImage = 1 << 24;

class PatchReader {
 public:
  PatchReader(std::string where, std::string_view text) : where_(std::move(where)), words_(text) {}

  std::vector<ScenePoint> ReadPatches() {
    if (words_.Next() != "PATCHES") {
      throw InvalidInputError(where_, "does not begin with PATCHES",
                              "give a .patch file as PMVS2 writes it");
    }
    std::vector<ScenePoint> points(TakeCount(kLeastPatchBytes));
    for (ScenePoint& point : points) ReadPatch(point);
    if (!words_.Next().empty()) Fail("goes on after its last patch");
    return points;
  }

  std::vector<ScenePoint> ReadPset() {
    std::vector<ScenePoint> points;
    for (TextWords ahead = words_; !ahead.Next().empty(); ahead = words_) {
      points.emplace_back();
      points.back().position = TakeVector();
      points.back().normal = TakeVector();
      CheckCloudPoint(points.back(), points.size() - 1, where_);
      ++number_;
    }
    return points;
  }

 private:
  [[noreturn]] void Fail(const std::string& problem) const {
    throw InvalidInputError(where_, problem, "check that the file is complete");
  }

  double TakeNumber() {
    const std::optional<double> number = words_.NextNumber();
    if (!number) {
      Fail("point " + std::to_string(number_) + " (from 0) is cut or holds something that is no " +
           "finite number");
    }
    return *number;
  }

  Vector3d TakeVector() {
    const double x = TakeNumber(), y = TakeNumber(), z = TakeNumber();
    return {x, y, z};
  }

  // A number of things that take at least so many bytes each.
  size_t TakeCount(size_t least_bytes) {
    const std::optional<int64_t> count = words_.NextInteger();
    if (!count || *count < 0 ||
        static_cast<uint64_t>(*count) > (words_.num_bytes_left() + 1) / least_bytes) {
      Fail("has a number of patches or images for which it is too short");
    }
    return static_cast<size_t>(*count);
  }

  std::vector<int> TakeImages() {
    std::vector<int> images(TakeCount(2));
    for (int& image : images) {
      const std::optional<int64_t> number = words_.NextInteger();
      if (!number || *number < 0 || *number > kMaxImage) {
        Fail("point " + std::to_string(number_) + " (from 0) names an image that cannot be");
      }
      image = static_cast<int>(*number);
    }
    return images;
  }

  void ReadPatch(ScenePoint& point) {
    if (words_.Next() != "PATCHS") Fail("patch " + std::to_string(number_) + " (from 0) is none");
    const Vector3d position = TakeVector();
    point.position = position / TakeNumber();  // homogeneous
    point.normal = TakeVector();
    for (int i = 0; i < 4; ++i) TakeNumber();  // the normal's fourth; score and two for debugging
    CheckCloudPoint(point, number_, where_);
    point.view_idx = TakeImages();
    static_cast<void>(TakeImages());  // that should see it, but do not agree
    ++number_;
  }

  std::string where_;
  TextWords words_;
  size_t number_ = 0;
};

void TakeColours(const std::filesystem::path& ply, std::vector<ScenePoint>& points) {
  const std::vector<ScenePoint> coloured = ReadPlyPoints(ply);
  if (coloured.size() != points.size()) {
    throw InvalidInputError(ply.native(),
                            "has " + std::to_string(coloured.size()) + " points, the patches are " +
                                std::to_string(points.size()),
                            "take it away if it is not of these patches");
  }
  for (size_t i = 0; i < points.size(); ++i) points[i].rgb = coloured[i].rgb;
}

}  // namespace

std::vector<ScenePoint> ReadPatches(const std::filesystem::path& path,
                                    const std::filesystem::path& colours) {
  const std::string text = ReadFile(path);
  std::vector<ScenePoint> points = PatchReader(path.native(), text).ReadPatches();
  if (!colours.empty()) TakeColours(colours, points);
  return points;
}

std::vector<ScenePoint> ReadPset(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  return PatchReader(path.native(), text).ReadPset();
}

}  // namespace enfilade
