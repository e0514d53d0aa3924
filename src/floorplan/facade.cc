// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/facade.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "enfilade/image/sampling.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinDistance_m = 0.25;
constexpr double kMinCosine = 0.2;
// Pictures count half from this far: their pixels grow as large as the edges.
constexpr double kHalfWeight_m = 2.5;
// Grey levels a step from which a change of brightness stands out.
constexpr float kContrast = 3;
constexpr int kReach = 3;           // cells that smoothing and the difference look at
constexpr double kBefore_m = 0.03;  // of the plane, so that its own wall does not hide it

float Saturated(float gradient) { return gradient / (std::abs(gradient) + kContrast); }

// Binomial smoothing over five values along rows, then along columns; the border repeats.
ImageF Smoothed(const ImageF& image) {
  constexpr float kKernel[5] = {1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
  ImageF along(image.rows(), image.cols()), both(image.rows(), image.cols());
  for (int r = 0; r < image.rows(); ++r) {
    for (int c = 0; c < image.cols(); ++c) {
      for (int k = -2; k <= 2; ++k) {
        along(r, c) += kKernel[k + 2] * image(r, std::clamp(c + k, 0, image.cols() - 1));
      }
    }
  }
  for (int r = 0; r < image.rows(); ++r) {
    for (int k = -2; k <= 2; ++k) {
      const float* row = along.row(std::clamp(r + k, 0, image.rows() - 1));
      for (int c = 0; c < image.cols(); ++c) both(r, c) += kKernel[k + 2] * row[c];
    }
  }
  return both;
}

// Grey value of the point, negative where the picture does not show it.
float Look(const FacadeView& view, const Rigid3& cam_from_home, const Vector3d& point) {
  const std::optional<Vector2d> pixel = view.camera.PixelFromRay(cam_from_home * point);
  if (!pixel) return -1;
  if (!view.mask.empty() &&
      view.mask(std::clamp(static_cast<int>(pixel->y()), 0, view.mask.rows() - 1),
                std::clamp(static_cast<int>(pixel->x()), 0, view.mask.cols() - 1)) == 0) {
    return -1;
  }
  return view.camera.model == CameraModel::kEquirectangular
             ? SampleBilinearWrapped(view.gray, pixel->x(), pixel->y())
             : SampleBilinear(view.gray, pixel->x(), pixel->y());
}

}  // namespace

Facade::Facade(const Vector2d& a, const Vector2d& b, double floor_z, double ceiling_z,
               double step_m)
    : a_(a), along_((b - a).normalized()), floor_z_(floor_z), step_m_(step_m) {
  inward_ = {-along_.y(), along_.x()};
  const int rows = static_cast<int>((ceiling_z - floor_z) / step_m);
  const int cols = static_cast<int>((b - a).norm() / step_m);
  ENFILADE_CHECK(rows > 0 && cols > 0);
  upright_ = level_ = brightness_ = weight_ = ImageF(rows, cols);
}

std::vector<float> Facade::ColumnWeights(const Vector2d& camera, const Polygon2& room) const {
  std::vector<float> weights(static_cast<size_t>(cols()), 0.0F);
  const double distance = inward_.dot(camera - a_);
  if (distance < kMinDistance_m) return weights;
  const std::vector<Ring2> rings = RingsOf(room);
  for (int c = 0; c < cols(); ++c) {
    const Vector2d ray = PlanPoint(c) + kBefore_m * inward_ - camera;
    const double range = ray.norm(), cosine = distance / range;
    if (cosine < kMinCosine) continue;
    const bool is_hidden = std::any_of(rings.begin(), rings.end(), [&](const Ring2& ring) {
      return RayDistance(ring, camera, ray / range) < range;
    });
    if (is_hidden) continue;
    const double falloff = range / kHalfWeight_m;
    weights[static_cast<size_t>(c)] = static_cast<float>(cosine / (1 + falloff * falloff));
  }
  return weights;
}

void Facade::Add(const FacadeView& view, const Polygon2& room) {
  const std::vector<float> weights = ColumnWeights(view.home_from_cam.translation.head<2>(), room);
  const auto is_seen = [](float weight) { return weight > 0; };
  if (std::none_of(weights.begin(), weights.end(), is_seen)) return;
  ++num_views_;
  const Rigid3 cam_from_home = view.home_from_cam.Inverse();
  ImageF gray(rows(), cols(), 1, -1.0F);
  for (int r = 0; r < rows(); ++r) {
    for (int c = 0; c < cols(); ++c) {
      if (!is_seen(weights[static_cast<size_t>(c)])) continue;
      Vector3d point;
      point << PlanPoint(c), floor_z_ + (r + 0.5) * step_m_;
      gray(r, c) = Look(view, cam_from_home, point);
    }
  }
  const ImageF smooth = Smoothed(gray);
  for (int r = kReach; r + kReach < rows(); ++r) {
    for (int c = kReach; c + kReach < cols(); ++c) {
      bool is_whole = true;
      for (int k = -kReach; k <= kReach; ++k)
        is_whole = is_whole && gray(r + k, c) >= 0 && gray(r, c + k) >= 0;
      if (!is_whole) continue;
      const float weight = weights[static_cast<size_t>(c)];
      upright_(r, c) += weight * Saturated(0.5F * (smooth(r, c + 1) - smooth(r, c - 1)));
      level_(r, c) += weight * Saturated(0.5F * (smooth(r + 1, c) - smooth(r - 1, c)));
      brightness_(r, c) += weight * gray(r, c);
      weight_(r, c) += weight;
    }
  }
}

void Facade::Finish() {
  for (size_t i = 0; i < weight_.data().size(); ++i) {
    if (weight_.data()[i] <= 0) continue;
    const float scale = 1 / weight_.data()[i];
    upright_.data()[i] *= scale;
    level_.data()[i] *= scale;
    brightness_.data()[i] *= scale;
  }
}

}  // namespace enfilade
