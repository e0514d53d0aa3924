// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/model_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/triangle_tree.h"
#include "enfilade/image/resize.h"
#include "enfilade/model/visibility.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kSamples = 2;                                // a pixel, along each side
constexpr double kAzimuth_deg = -62, kElevation_deg = 52;  // where the outside viewer stands
constexpr double kMargin_m = 0.3;
constexpr double kInsideWidth_deg = 95;
constexpr float kStep_m = 1e-3F;
constexpr int kMaxPassed = 64;
// Where neighbouring samples differ by more there is a line.
constexpr double kEdgeAngle_deg = 30;
constexpr double kEdgeStep_m = 0.05;
constexpr double kEdgeShade = 0.45;

using Rgb = Eigen::Array3d;
const Rgb kFloor(214, 186, 150), kWall(232, 230, 224), kCeiling(246, 246, 244), kDoor(150, 105, 70);
const Rgb kNothingOutside(255, 255, 255), kNothingInside(58, 62, 72);

// What a ray sees.
struct Sample {
  bool is_hit = false;
  bool is_door = false;
  Vector3d point = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
};

// Samples row by row.
struct Raster {
  int rows = 0, cols = 0;
  std::vector<Sample> samples;

  Raster(int num_rows, int num_cols)
      : rows(num_rows),
        cols(num_cols),
        samples(static_cast<size_t>(num_rows) * static_cast<size_t>(num_cols)) {}
  [[nodiscard]] Sample& At(int row, int col) {
    return samples[static_cast<size_t>(row) * static_cast<size_t>(cols) + static_cast<size_t>(col)];
  }
  [[nodiscard]] const Sample& At(int row, int col) const {
    return samples[static_cast<size_t>(row) * static_cast<size_t>(cols) + static_cast<size_t>(col)];
  }
};

Raster Cast(int rows, int cols, const std::function<Sample(double x, double y)>& look,
            RunContext& context) {
  Raster raster(kSamples * rows, kSamples * cols);
  ParallelFor(context, "", raster.rows, [&](int64_t i) {
    const int row = static_cast<int>(i);
    for (int col = 0; col < raster.cols; ++col)
      raster.At(row, col) = look((col + 0.5) / kSamples, (row + 0.5) / kSamples);
  });
  return raster;
}

Rgb ColourOf(const Sample& sample) {
  if (sample.is_door) return kDoor;
  const double up = sample.normal.z();
  if (up > 0) return kWall + up * (kFloor - kWall);
  return kWall - up * (kCeiling - kWall);
}

// Each direction of walls has a brightness of its own, so that corners show.
double Shade(const Vector3d& normal) {
  return 0.90 + 0.06 * normal.x() - 0.02 * normal.y() - 0.08 * std::abs(normal.y()) +
         0.04 * std::abs(normal.z());
}

bool IsEdge(const Sample& a, const Sample& b) {
  static const double kMinDot = std::cos(DegToRad(kEdgeAngle_deg));
  if (a.is_hit != b.is_hit || a.is_door != b.is_door) return true;
  if (!a.is_hit) return false;
  if (a.normal.dot(b.normal) < kMinDot) return true;
  return std::abs(a.normal.dot(b.point - a.point)) > kEdgeStep_m;
}

ImageU8 Paint(const Raster& raster, const Rgb& nothing) {
  ImageU8 image(raster.rows, raster.cols, 3);
  for (int row = 0; row < raster.rows; ++row) {
    for (int col = 0; col < raster.cols; ++col) {
      const Sample& sample = raster.At(row, col);
      Rgb colour = sample.is_hit ? Rgb(ColourOf(sample) * Shade(sample.normal)) : nothing;
      const bool is_edge = (col + 1 < raster.cols && IsEdge(sample, raster.At(row, col + 1))) ||
                           (row + 1 < raster.rows && IsEdge(sample, raster.At(row + 1, col)));
      if (is_edge) colour *= kEdgeShade;
      for (int k = 0; k < 3; ++k)
        image(row, col, k) = static_cast<uint8_t>(std::lround(std::clamp(colour[k], 0.0, 255.0)));
    }
  }
  return ReduceImage(image, raster.rows / kSamples, raster.cols / kSamples);
}

// The triangles of a model with the face that each is of.
struct Triangles {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> corners;
  std::vector<int> face_idx;
};

Triangles TrianglesOf(const BuildingModel& model) {
  Triangles triangles;
  for (size_t f = 0; f < model.faces.size(); ++f) {
    const ModelFace& face = model.faces[f];
    const int first = static_cast<int>(triangles.vertices.size());
    for (const Vector3d& p : face.vertices) triangles.vertices.emplace_back(p.cast<float>());
    for (const auto& [a, b, c] : face.triangles) {
      triangles.corners.push_back({first + a, first + b, first + c});
      triangles.face_idx.push_back(static_cast<int>(f));
    }
  }
  return triangles;
}

// The first triangle that shows its front.
Sample LookThroughBacks(const BuildingModel& model, const Triangles& triangles,
                        const TriangleTree& tree, const Vector3d& origin,
                        const Vector3d& direction) {
  float begin = 0;
  for (int i = 0; i < kMaxPassed; ++i) {
    const std::optional<TriangleHit> hit =
        tree.FirstHit(origin.cast<float>(), direction.cast<float>(), begin,
                      std::numeric_limits<float>::infinity());
    if (!hit) break;
    const int face_idx = triangles.face_idx[static_cast<size_t>(hit->triangle_idx)];
    const Vector3d& normal = model.faces[static_cast<size_t>(face_idx)].normal;
    if (normal.dot(direction) < 0) return {true, false, origin + hit->distance * direction, normal};
    begin = hit->distance + kStep_m;
  }
  return {};
}

// A profile's distances; columns without one count as none.
std::vector<double> DistancesOf(const WallProfile& profile) {
  std::vector<double> distances;
  for (const float wall_m : profile.wall_m)
    distances.push_back(std::isfinite(wall_m) ? static_cast<double>(wall_m) : 0);
  return distances;
}

// The middle of the window of columns, as wide as the view, whose walls stand farthest away.
double WidestAzimuth(const std::vector<double>& distances) {
  const int num_columns = static_cast<int>(distances.size());
  const int half = std::max(1, static_cast<int>(kInsideWidth_deg / 720 * num_columns));
  double best_sum = -1;
  int best = 0;
  for (int middle = 0; middle < num_columns; ++middle) {
    double sum = 0;
    for (int k = -half; k <= half; ++k)
      sum += distances[static_cast<size_t>((middle + k + num_columns) % num_columns)];
    if (sum <= best_sum) continue;
    best_sum = sum;
    best = middle;
  }
  return AzimuthOfColumn(best, num_columns);
}

// Where a point lies on the sheet of the outside viewer, metres: to the right and down.
struct OutsideViewer {
  Vector3d right, down, forward;

  OutsideViewer() {
    const double azimuth = DegToRad(kAzimuth_deg), elevation = DegToRad(kElevation_deg);
    forward = -Vector3d(std::cos(elevation) * std::cos(azimuth),
                        std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    right = Vector3d(-std::sin(azimuth), std::cos(azimuth), 0);
    down = forward.cross(right);
  }
};

}  // namespace

ImageU8 RenderFromOutside(const BuildingModel& model, const Eigen::AlignedBox3d& extent,
                          int width_px, RunContext& context) {
  ENFILADE_CHECK(!extent.isEmpty() && width_px > 0);
  const OutsideViewer viewer;
  Eigen::AlignedBox3d sheet;  // right, down, forward
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = extent.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    sheet.extend(
        Vector3d(viewer.right.dot(corner), viewer.down.dot(corner), viewer.forward.dot(corner)));
  }
  const Vector3d low = sheet.min() - Vector3d::Constant(kMargin_m);
  const Vector3d size = sheet.sizes() + Vector3d::Constant(2 * kMargin_m);
  const double px_per_m = width_px / size.x();
  const int rows = std::max(1, static_cast<int>(std::lround(size.y() * px_per_m)));
  const Triangles triangles = TrianglesOf(model);
  const TriangleTree tree(triangles.vertices, triangles.corners);
  // From well before all of it.
  const double start = low.z() - size.norm();
  return Paint(Cast(
                   rows, width_px,
                   [&](double x, double y) {
                     const Vector3d origin = (low.x() + x / px_per_m) * viewer.right +
                                             (low.y() + y / px_per_m) * viewer.down +
                                             start * viewer.forward;
                     return LookThroughBacks(model, triangles, tree, origin, viewer.forward);
                   },
                   context),
               kNothingOutside);
}

InsideView ChooseInsideView(const Scene& scene, const Structure& structure, int width_px) {
  const WallProfile* widest = nullptr;
  std::pair<bool, double> best{false, -1};
  for (const WallProfile& profile : structure.profiles) {
    const View& view = scene.views[static_cast<size_t>(profile.view_idx)];
    const std::pair<bool, double> rank{view.camera.model == CameraModel::kEquirectangular,
                                       Median(DistancesOf(profile)).value_or(0)};
    if (rank <= best) continue;
    best = rank;
    widest = &profile;
  }
  ENFILADE_CHECK(widest != nullptr);
  InsideView inside;
  inside.view_idx = widest->view_idx;
  const double azimuth = WidestAzimuth(DistancesOf(*widest));
  inside.home_from_cam.rotation.col(0) = Vector3d(std::sin(azimuth), -std::cos(azimuth), 0);
  inside.home_from_cam.rotation.col(1) = -Vector3d::UnitZ();
  inside.home_from_cam.rotation.col(2) = Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
  inside.home_from_cam.translation =
      structure.home_from_world *
      scene.views[static_cast<size_t>(inside.view_idx)].world_from_cam.translation;
  const int height_px = width_px * 3 / 4;
  const double focal_px = 0.5 * width_px / std::tan(DegToRad(0.5 * kInsideWidth_deg));
  inside.camera =
      PinholeCamera(width_px, height_px, focal_px, focal_px, 0.5 * width_px, 0.5 * height_px);
  return inside;
}

ImageU8 RenderFromInside(const BuildingModel& model, const Floorplan& plan,
                         const Rigid3& home_from_cam, const Camera& camera, RunContext& context) {
  ENFILADE_CHECK(camera.model == CameraModel::kPinhole);
  const Visibility visibility(model, plan);
  const auto look = [&](double x, double y) -> Sample {
    const Vector3d ray = home_from_cam.rotation * camera.RayFromPixel({x, y});
    const ModelSight sight = visibility.Look(home_from_cam.translation, ray);
    const std::optional<FaceHit>& hit = sight.door ? sight.door : sight.face;
    if (!hit) return {};
    return {true, sight.door.has_value(), home_from_cam.translation + hit->distance_m * ray,
            model.faces[static_cast<size_t>(hit->face_idx)].normal};
  };
  return Paint(Cast(camera.height, camera.width, look, context), kNothingInside);
}

}  // namespace enfilade
