// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/scene/point_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/image/image.h"
#include "enfilade/scene/camera.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kWidth = 1024, kHeight = kWidth / 2;
constexpr double kPixel_rad = 2 * kPi / kWidth;
// Of points before the surface that they lie on: less than a wall is thick.
constexpr double kSlack_m = 0.1;
constexpr double kMaxDiscRadius_m = 0.25;
constexpr double kMaxDisc_rad = 0.25;  // a disc next to the camera hides no more than this

double NextNeighbourDistance(const std::vector<ScenePoint>& points, const Vector3d& position,
                             size_t rank) {
  std::vector<double> nearest(rank + 1, std::numeric_limits<double>::infinity());  // and itself
  for (const ScenePoint& point : points) {
    const double squared = (point.position - position).squaredNorm();
    if (squared >= nearest.back()) continue;
    nearest.back() = squared;
    for (size_t k = rank; k > 0 && nearest[k] < nearest[k - 1]; --k)
      std::swap(nearest[k], nearest[k - 1]);
  }
  return std::sqrt(nearest.back());
}

// Discs that leave no gaps in a surface whose points lie at random: with n points a square metre
// the fourth neighbour is about 1.13/√n away, and discs of 1.5 times that cover all but exp(−9).
double DiscRadius(const std::vector<ScenePoint>& points, RunContext& context) {
  constexpr size_t kNumSamples = 256, kRank = 4;
  const size_t step = std::max<size_t>(1, points.size() / kNumSamples);
  std::vector<double> distances((points.size() + step - 1) / step);
  ParallelFor(context, "", static_cast<int64_t>(distances.size()), [&](int64_t i) {
    const auto idx = static_cast<size_t>(i);
    distances[idx] = NextNeighbourDistance(points, points[idx * step].position, kRank);
  });
  return std::min(1.5 * UpperMedian(std::move(distances)), kMaxDiscRadius_m);
}

// The sphere of distances round a camera. Its pixels are those of a panorama whose axes are the
// world's.
class DepthSphere {
 public:
  DepthSphere()
      : camera_(EquirectangularCamera(kWidth, kHeight)),
        depth_m_(kHeight, kWidth),
        rays_(static_cast<size_t>(kWidth) * kHeight) {
    for (int row = 0; row < kHeight; ++row) {
      for (int col = 0; col < kWidth; ++col) {
        rays_[Index(row, col)] = camera_.RayFromPixel({col + 0.5, row + 0.5}).cast<float>();
      }
    }
  }

  void Draw(const std::vector<ScenePoint>& points, const Vector3d& center, double radius_m) {
    std::fill(depth_m_.data().begin(), depth_m_.data().end(),
              std::numeric_limits<float>::infinity());
    for (const ScenePoint& point : points) {
      const Vector3d offset = point.position - center;
      if (!point.normal.isZero(0) && offset.norm() > radius_m) {
        DrawDisc(offset, point.normal, radius_m);
      }
    }
  }

  [[nodiscard]] bool Shows(const ScenePoint& point, const Vector3d& center) const {
    const Vector3d offset = point.position - center;
    if (point.normal.dot(offset) >= 0) return false;  // turned away, or without a normal
    const auto [row, col] = PixelOf(offset);
    return offset.norm() <= depth_m_(row, col) + kSlack_m;
  }

 private:
  static size_t Index(int row, int col) { return static_cast<size_t>(row) * kWidth + col; }

  [[nodiscard]] std::array<int, 2> PixelOf(const Vector3d& ray) const {
    const Eigen::Vector2d pixel = *camera_.PixelFromRay(ray);
    return {std::clamp(static_cast<int>(pixel.y()), 0, kHeight - 1),
            std::clamp(static_cast<int>(pixel.x()), 0, kWidth - 1)};
  }

  void Approach(int row, int col, float distance_m) {
    float& depth_m = depth_m_(row, col);
    depth_m = std::min(depth_m, distance_m);
  }

  void DrawDisc(const Vector3d& offset, const Vector3d& normal, double radius_m) {
    const double distance_m = offset.norm();
    const auto [row, col] = PixelOf(offset);
    Approach(row, col, static_cast<float>(distance_m));
    const double angle = std::min(std::asin(radius_m / distance_m), kMaxDisc_rad);
    const int rows = static_cast<int>(angle / kPixel_rad);
    if (rows == 0) return;
    const Eigen::Vector3f n = normal.cast<float>(), p = offset.cast<float>();
    const float height = n.dot(p), radius = static_cast<float>(radius_m);
    for (int r = std::max(0, row - rows); r <= std::min(kHeight - 1, row + rows); ++r) {
      // Towards the poles a disc takes more columns.
      const double elevation = kPi * (0.5 - (r + 0.5) / kHeight);
      const double cols_rad = angle / std::max(std::cos(elevation), 1e-3);
      const int cols = std::min(static_cast<int>(cols_rad / kPixel_rad), kWidth / 2 - 1);
      for (int k = -cols; k <= cols; ++k) {
        const int c = (col + k + kWidth) % kWidth;
        const Eigen::Vector3f& ray = rays_[Index(r, c)];
        const float along = n.dot(ray);
        if (std::abs(along) < 1e-3f) continue;
        const float t = height / along;
        if (t > 0 && (t * ray - p).squaredNorm() <= radius * radius) Approach(r, c, t);
      }
    }
  }

  Camera camera_;
  ImageF depth_m_;
  std::vector<Eigen::Vector3f> rays_;
};

}  // namespace

void FindViewsOfPoints(std::span<const View> views, std::vector<ScenePoint>& points,
                       RunContext& context) {
  if (points.empty()) return;
  const double radius_m = DiscRadius(points, context);
  std::vector<std::vector<bool>> is_seen(views.size());
  ParallelFor(context, "find who sees the points", static_cast<int64_t>(views.size()),
              [&](int64_t i) {
                const View& view = views[static_cast<size_t>(i)];
                DepthSphere sphere;
                sphere.Draw(points, view.world_from_cam.translation, radius_m);
                const Rigid3 cam_from_world = view.world_from_cam.Inverse();
                std::vector<bool>& seen = is_seen[static_cast<size_t>(i)];
                seen.resize(points.size());
                for (size_t k = 0; k < points.size(); ++k) {
                  seen[k] = sphere.Shows(points[k], view.world_from_cam.translation) &&
                            view.camera.PixelFromRay(cam_from_world * points[k].position);
                }
              });
  for (size_t k = 0; k < points.size(); ++k) {
    points[k].view_idx.clear();
    for (size_t i = 0; i < views.size(); ++i) {
      if (is_seen[i][k]) points[k].view_idx.push_back(static_cast<int>(i));
    }
  }
}

}  // namespace enfilade
