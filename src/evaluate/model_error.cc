// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/model_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/geometry/angles.h"
#include "src/evaluate/panorama_rays.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
constexpr float kNotJudged = std::numeric_limits<float>::quiet_NaN();
constexpr double kNearShare = 0.05;
constexpr float kNoFace = std::numeric_limits<float>::infinity();

// The truth about the pixels of a panorama; what is absent is empty.
struct PixelTruth {
  ImageF depth;
  Image<int8_t> normals;
  ImageU8 labels;
  int rows = 0, cols = 0;

  explicit PixelTruth(const TruthView& view) {
    if (!view.depth_path.empty()) {
      depth = ReadTruthDepth(view.depth_path);
      Agree(depth.rows(), depth.cols(), view.depth_path);
    }
    if (!view.normals_path.empty()) {
      normals = ReadTruthNormals(view.normals_path);
      Agree(normals.rows(), normals.cols(), view.normals_path);
    }
    if (!view.labels_path.empty()) {
      labels = ReadTruthLabels(view.labels_path);
      Agree(labels.rows(), labels.cols(), view.labels_path);
    }
  }

  void Agree(int new_rows, int new_cols, const std::filesystem::path& path) {
    if (rows != 0 && (rows != new_rows || cols != new_cols)) {
      throw InvalidInputError(path.native(), "has another size than its panorama's other truth",
                              "make the truth anew");
    }
    rows = new_rows;
    cols = new_cols;
  }

  [[nodiscard]] bool IsFurniture(int row, int col) const {
    return !labels.empty() && labels(row, col) == static_cast<uint8_t>(SurfaceLabel::kOther);
  }
  // 0 for none.
  [[nodiscard]] double DepthAt(int row, int col) const {
    return depth.empty() ? 0 : static_cast<double>(depth(row, col));
  }
  // Zero for none.
  [[nodiscard]] Vector3d NormalAt(int row, int col) const {
    if (normals.empty()) return Vector3d::Zero();
    return {static_cast<double>(normals(row, col, 0)), static_cast<double>(normals(row, col, 1)),
            static_cast<double>(normals(row, col, 2))};
  }
};

// The face, or the door before it, whichever is nearer to the true depth.
std::optional<FaceHit> FaceSeen(const ModelSight& sight, double true_depth_m) {
  if (!sight.door || true_depth_m <= 0) return sight.face;
  if (!sight.face) return sight.door;
  const double behind = std::abs(sight.face->distance_m - true_depth_m);
  return std::abs(sight.door->distance_m - true_depth_m) < behind ? sight.door : sight.face;
}

// The median, infinite where it falls on pixels without a face; none for no values.
std::optional<double> MedianOrInfinite(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Median(values).value_or(std::numeric_limits<double>::infinity());
}

// Compares pixel by pixel and gathers the errors.
class Comparison {
 public:
  Comparison(const BuildingModel& model, const Rigid3& home_from_truth, int rows, int cols)
      : model_(model), home_from_truth_(home_from_truth) {
    map_.depth_error_m = ImageF(rows, cols, 1, kNotJudged);
    map_.normal_error_deg = ImageF(rows, cols, 1, kNotJudged);
    map_.face_idx = Image<int>(rows, cols, 1, -1);
  }

  void Show(int row, int col, const std::optional<FaceHit>& seen) {
    if (seen) map_.face_idx(row, col) = seen->face_idx;
  }

  void Judge(int row, int col, const std::optional<FaceHit>& seen, double true_depth_m,
             const Vector3d& true_normal) {
    ++map_.figures.num_pixels;
    num_hits_ += seen.has_value();
    if (true_depth_m > 0) {
      const float error_m = seen ? static_cast<float>(seen->distance_m - true_depth_m) : kNoFace;
      map_.depth_error_m(row, col) = error_m;
      depth_m_.push_back(std::abs(error_m));
      num_near_ += depth_m_.back() <= kNearShare * true_depth_m;
    }
    if (!true_normal.isZero()) {
      const float error_deg = seen ? NormalError(*seen, true_normal) : kNoFace;
      map_.normal_error_deg(row, col) = error_deg;
      normal_deg_.push_back(error_deg);
    }
  }

  [[nodiscard]] ModelErrorMap Finish() {
    PanoramaModelError& figures = map_.figures;
    if (figures.num_pixels > 0) figures.hit_share = 1.0 * num_hits_ / figures.num_pixels;
    figures.depth_median_m = MedianOrInfinite(depth_m_);
    if (!depth_m_.empty()) {
      figures.depth_within_5pct = num_near_ / static_cast<double>(depth_m_.size());
    }
    figures.normal_median_deg = MedianOrInfinite(normal_deg_);
    return std::move(map_);
  }

 private:
  [[nodiscard]] float NormalError(const FaceHit& seen, const Vector3d& true_normal) const {
    const Vector3d& normal = model_.faces[static_cast<size_t>(seen.face_idx)].normal;
    const Vector3d in_home = home_from_truth_.rotation * true_normal;
    return static_cast<float>(
        RadToDeg(std::atan2(normal.cross(in_home).norm(), normal.dot(in_home))));
  }

  const BuildingModel& model_;
  const Rigid3& home_from_truth_;
  ModelErrorMap map_;
  std::vector<double> depth_m_, normal_deg_;
  int num_hits_ = 0, num_near_ = 0;
};

// The middle of the i-th of `count` equal parts of `size` pixels.
int SampledPixel(int i, int count, int size) { return static_cast<int>((i + 0.5) * size / count); }

std::optional<double> MedianOf(const std::vector<PanoramaModelError>& panoramas,
                               std::optional<double> PanoramaModelError::*figure) {
  std::vector<double> values;
  for (const PanoramaModelError& panorama : panoramas) {
    if (panorama.*figure) values.push_back(*(panorama.*figure));
  }
  return Median(values);
}

}  // namespace

ModelErrorMap CompareModel(const BuildingModel& model, const Visibility& visibility,
                           const Rigid3& home_from_truth, const TruthView& truth,
                           const ModelErrorOptions& options) {
  ENFILADE_CHECK(truth.world_from_cam.has_value());
  const PixelTruth pixels(truth);
  ENFILADE_CHECK(pixels.rows > 0);
  const int cols = std::min(options.map_width / 2 * 2, pixels.cols), rows = cols / 2;
  const PanoramaRays rays(pixels.rows, pixels.cols);
  const Rigid3 home_from_cam = home_from_truth * *truth.world_from_cam;
  Comparison comparison(model, home_from_truth, rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const int true_row = SampledPixel(row, rows, pixels.rows);
      const int true_col = SampledPixel(col, cols, pixels.cols);
      const double true_depth_m = pixels.DepthAt(true_row, true_col);
      const Vector3d true_normal = pixels.NormalAt(true_row, true_col);
      const Vector3d ray = home_from_cam.rotation * rays(true_row, true_col);
      const std::optional<FaceHit> seen =
          FaceSeen(visibility.Look(home_from_cam.translation, ray), true_depth_m);
      comparison.Show(row, col, seen);
      if (pixels.IsFurniture(true_row, true_col)) continue;
      if (true_depth_m <= 0 && true_normal.isZero()) continue;
      comparison.Judge(row, col, seen, true_depth_m, true_normal);
    }
  }
  return comparison.Finish();
}

ModelErrorFigures EvaluateModel(const BuildingModel& model, const Floorplan& floorplan,
                                const GroundTruth& truth, std::span<const int> truth_idx,
                                const ModelErrorOptions& options, const ModelErrorSink& sink,
                                RunContext& context) {
  std::vector<int> judged;
  for (size_t i = 0; i < truth_idx.size(); ++i) {
    if (truth_idx[i] < 0) continue;
    const TruthView& view = truth.views[static_cast<size_t>(truth_idx[i])];
    const bool has_pixels = !view.depth_path.empty() || !view.normals_path.empty();
    if (view.world_from_cam && has_pixels) judged.push_back(static_cast<int>(i));
  }
  ModelErrorFigures figures;
  figures.panoramas.resize(judged.size());
  const Visibility visibility(model, floorplan);
  ParallelFor(context, "model errors", static_cast<int64_t>(judged.size()), [&](int64_t i) {
    const int view_idx = judged[static_cast<size_t>(i)];
    const int idx = truth_idx[static_cast<size_t>(view_idx)];
    ModelErrorMap map = CompareModel(model, visibility, floorplan.home_from_world,
                                     truth.views[static_cast<size_t>(idx)], options);
    map.figures.view_idx = view_idx;
    figures.panoramas[static_cast<size_t>(i)] = map.figures;
    if (sink) sink(map);
  });
  figures.hit_share = MedianOf(figures.panoramas, &PanoramaModelError::hit_share);
  figures.depth_median_m = MedianOf(figures.panoramas, &PanoramaModelError::depth_median_m);
  figures.depth_within_5pct = MedianOf(figures.panoramas, &PanoramaModelError::depth_within_5pct);
  figures.normal_median_deg = MedianOf(figures.panoramas, &PanoramaModelError::normal_median_deg);
  return figures;
}

}  // namespace enfilade
