// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "enfilade/base/check.h"
#include "enfilade/exchange/pixel_truth.h"
#include "enfilade/geometry/angles.h"
#include "src/evaluate/panorama_rays.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
constexpr size_t kNumLabels = 4;

int ColumnOfAzimuth(double azimuth, int num_columns) {
  const int column = static_cast<int>((azimuth + kPi) / (2 * kPi) * num_columns);
  return std::clamp(column, 0, num_columns - 1);
}

// What a ray from the camera meets within the horizontal distance of the wall.
SurfaceLabel LabelAlong(const WallProfile& profile, const Vector3d& camera, const Vector3d& ray) {
  const int column = ColumnOfAzimuth(std::atan2(ray.y(), ray.x()), profile.num_columns());
  const double wall_m = profile.wall_m[static_cast<size_t>(column)];
  if (!std::isfinite(wall_m) || wall_m <= 0) return SurfaceLabel::kOther;
  const double level = ray.head<2>().norm();
  // Heights at the wall's distance, times `level`: upright rays have none.
  const double rise = wall_m * ray.z();
  if (rise < level * (profile.floor_z - camera.z())) return SurfaceLabel::kFloor;
  if (rise > level * (profile.ceiling_z - camera.z())) return SurfaceLabel::kCeiling;
  return SurfaceLabel::kWall;
}

// [true label][found label] in pixels.
using Confusion = std::array<std::array<int64_t, kNumLabels>, kNumLabels>;

Confusion Count(const ImageU8& truth, const ImageU8& found) {
  Confusion confusion{};
  for (size_t i = 0; i < truth.data().size(); ++i) {
    ++confusion.at(truth.data()[i]).at(found.data()[i]);
  }
  return confusion;
}

PanoramaLabels FiguresOf(int view_idx, const Confusion& confusion) {
  int64_t total = 0, right = 0;
  std::vector<double> ious;
  for (size_t label = 1; label < kNumLabels; ++label) {
    int64_t in_truth = 0, in_found = 0;
    for (size_t other = 0; other < kNumLabels; ++other) {
      in_truth += confusion[label][other];
      if (other > 0) in_found += confusion[other][label];  // furniture is not judged
    }
    const int64_t hits = confusion[label][label];
    total += in_truth;
    right += hits;
    if (in_truth == 0) continue;
    ious.push_back(static_cast<double>(hits) / static_cast<double>(in_truth + in_found - hits));
  }
  PanoramaLabels figures;
  figures.view_idx = view_idx;
  if (total > 0) figures.accuracy = static_cast<double>(right) / static_cast<double>(total);
  figures.iou_mean = Mean(ious);
  return figures;
}

std::optional<double> MedianOf(const std::vector<PanoramaLabels>& panoramas,
                               std::optional<double> PanoramaLabels::*figure) {
  std::vector<double> values;
  for (const PanoramaLabels& panorama : panoramas) {
    if (panorama.*figure) values.push_back(*(panorama.*figure));
  }
  return Median(values);
}

}  // namespace

ImageU8 LabelsOfProfile(const WallProfile& profile, const Rigid3& home_from_cam, int rows,
                        int cols) {
  const PanoramaRays rays(rows, cols);
  ImageU8 labels(rows, cols);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) {
      const Vector3d ray = home_from_cam.rotation * rays(row, col);
      labels(row, col) = static_cast<uint8_t>(LabelAlong(profile, home_from_cam.translation, ray));
    }
  }
  return labels;
}

LabelFigures EvaluateLabels(const Scene& scene, const Structure& structure,
                            const GroundTruth& truth, std::span<const int> truth_idx,
                            RunContext& context) {
  ENFILADE_CHECK(truth_idx.size() == scene.views.size());
  std::vector<const WallProfile*> judged;
  for (const WallProfile& profile : structure.profiles) {
    const int idx = truth_idx[static_cast<size_t>(profile.view_idx)];
    if (idx < 0 || truth.views[static_cast<size_t>(idx)].labels_path.empty()) continue;
    if (profile.num_columns() > 0) judged.push_back(&profile);
  }
  LabelFigures figures;
  figures.panoramas.resize(judged.size());
  ParallelFor(context, "labels", static_cast<int64_t>(judged.size()), [&](int64_t i) {
    const WallProfile& profile = *judged[static_cast<size_t>(i)];
    const auto view_idx = static_cast<size_t>(profile.view_idx);
    const ImageU8 labels =
        ReadTruthLabels(truth.views[static_cast<size_t>(truth_idx[view_idx])].labels_path);
    const Rigid3 home_from_cam = structure.home_from_world * scene.views[view_idx].world_from_cam;
    const ImageU8 found = LabelsOfProfile(profile, home_from_cam, labels.rows(), labels.cols());
    figures.panoramas[static_cast<size_t>(i)] = FiguresOf(profile.view_idx, Count(labels, found));
  });
  figures.accuracy = MedianOf(figures.panoramas, &PanoramaLabels::accuracy);
  figures.iou_mean = MedianOf(figures.panoramas, &PanoramaLabels::iou_mean);
  return figures;
}

}  // namespace enfilade
