// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

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

struct LabelShares {
  std::optional<double> accuracy, iou_mean;
};

LabelShares SharesOf(const Confusion& confusion) {
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
  LabelShares shares;
  if (total > 0) shares.accuracy = static_cast<double>(right) / static_cast<double>(total);
  shares.iou_mean = Mean(ious);
  return shares;
}

// The height of the ceiling above the camera in the room that it stands in.
std::optional<double> CeilingAbove(const GroundTruth& truth, const TruthView& view,
                                   const Eigen::Vector2d& origin) {
  for (const TruthRoom& room : truth.rooms) {
    if (room.storey_idx != view.storey_idx || !room.floor_z || !room.ceiling_z) continue;
    if (std::any_of(room.region.begin(), room.region.end(),
                    [&](const Polygon2& part) { return Contains(part, origin); }))
      return *room.ceiling_z - *room.floor_z - view.camera_height_m;
  }
  return std::nullopt;
}

// The layout as a profile seen from the truth's camera, so that its labels are those of a profile.
// Empty where the truth does not tell.
ImageU8 LabelsOfLayout(const GroundTruth& truth, const TruthView& view,
                       const Rigid3& truth_from_cam) {
  constexpr int kRows = 512, kColumns = 2048;
  const Eigen::Vector2d origin = truth_from_cam.translation.head<2>();
  const std::optional<double> ceiling_m = CeilingAbove(truth, view, origin);
  if (!view.is_inside || view.visible_layout.size() < 3 || !ceiling_m || view.camera_height_m <= 0)
    return {};
  WallProfile profile;
  profile.floor_z = truth_from_cam.translation.z() - view.camera_height_m;
  profile.ceiling_z = truth_from_cam.translation.z() + *ceiling_m;
  for (int c = 0; c < kColumns; ++c) {
    const double azimuth = AzimuthOfColumn(c, kColumns);
    profile.wall_m.push_back(static_cast<float>(RayDistance(
        view.visible_layout, origin, Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)))));
  }
  return LabelsOfProfile(profile, truth_from_cam, kRows, 2 * kRows);
}

// Every pixel's nearest one of a map of any size.
ImageU8 Resized(const ImageU8& map, int rows, int cols) {
  ImageU8 resized(rows, cols);
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < cols; ++c)
      resized(r, c) =
          map((2 * r + 1) * map.rows() / (2 * rows), (2 * c + 1) * map.cols() / (2 * cols));
  }
  return resized;
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
                            const LabelSource& maps, RunContext& context) {
  ENFILADE_CHECK(truth_idx.size() == scene.views.size());
  std::vector<const WallProfile*> judged;
  for (const WallProfile& profile : structure.profiles) {
    if (truth_idx[static_cast<size_t>(profile.view_idx)] >= 0 && profile.num_columns() > 0)
      judged.push_back(&profile);
  }
  std::vector<PanoramaLabels> panoramas(judged.size());
  ParallelFor(context, "labels", static_cast<int64_t>(judged.size()), [&](int64_t i) {
    const WallProfile& profile = *judged[static_cast<size_t>(i)];
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    const TruthView& truth_view =
        truth.views[static_cast<size_t>(truth_idx[static_cast<size_t>(profile.view_idx)])];
    const ImageU8 labels =
        truth_view.labels_path.empty()
            ? LabelsOfLayout(truth, truth_view,
                             truth_view.world_from_cam.value_or(view.world_from_cam))
            : ReadTruthLabels(truth_view.labels_path);
    PanoramaLabels& figures = panoramas[static_cast<size_t>(i)];
    figures.view_idx = profile.view_idx;
    if (labels.empty()) return;
    const auto shares_of = [&](const ImageU8& found) { return SharesOf(Count(labels, found)); };
    const LabelShares shares = shares_of(LabelsOfProfile(
        profile, structure.home_from_world * view.world_from_cam, labels.rows(), labels.cols()));
    figures.accuracy = shares.accuracy;
    figures.iou_mean = shares.iou_mean;
    const std::optional<LabelMaps> found = maps ? maps(profile.view_idx) : std::nullopt;
    if (!found) return;
    const auto accuracy_of = [&](const ImageU8& map) {
      return shares_of(Resized(map, labels.rows(), labels.cols())).accuracy;
    };
    figures.points_accuracy = accuracy_of(found->after_points);
    figures.free_space_accuracy = accuracy_of(found->after_free_space);
    figures.superpixel_accuracy = accuracy_of(found->final_labels);
  });
  std::erase_if(panoramas, [](const PanoramaLabels& panorama) { return !panorama.accuracy; });
  LabelFigures figures;
  figures.panoramas = std::move(panoramas);
  figures.accuracy = MedianOf(figures.panoramas, &PanoramaLabels::accuracy);
  figures.iou_mean = MedianOf(figures.panoramas, &PanoramaLabels::iou_mean);
  figures.points_accuracy = MedianOf(figures.panoramas, &PanoramaLabels::points_accuracy);
  figures.free_space_accuracy = MedianOf(figures.panoramas, &PanoramaLabels::free_space_accuracy);
  figures.superpixel_accuracy = MedianOf(figures.panoramas, &PanoramaLabels::superpixel_accuracy);
  return figures;
}

}  // namespace enfilade
