// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/facade.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "enfilade/image/sampling.h"
#include "enfilade/scene/locate_rays.h"

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

bool IsMasked(const FacadeView& view, double x, double y) {
  return !view.mask.empty() &&
         view.mask(std::clamp(static_cast<int>(y), 0, view.mask.rows() - 1),
                   std::clamp(static_cast<int>(x), 0, view.mask.cols() - 1)) == 0;
}

// Grey values of points from + i · step in the camera's frame, negative where the picture does not
// show them.
void LookAlong(const FacadeView& view, const Vector3d& from, const Vector3d& step,
               std::span<float> gray) {
  if (view.camera.model == CameraModel::kEquirectangular) {
    std::vector<float> u(gray.size()), v(gray.size());
    LocateRays(from, step, view.camera.width, view.camera.height, u, v);
    for (size_t i = 0; i < gray.size(); ++i) {
      const double x = double{u[i]} + 0.5, y = double{v[i]} + 0.5;
      gray[i] = IsMasked(view, x, y) ? -1 : SampleBilinearWrapped(view.gray, x, y);
    }
    return;
  }
  for (size_t i = 0; i < gray.size(); ++i) {
    const std::optional<Vector2d> pixel =
        view.camera.PixelFromRay(from + static_cast<double>(i) * step);
    gray[i] = pixel && !IsMasked(view, pixel->x(), pixel->y())
                  ? SampleBilinear(view.gray, pixel->x(), pixel->y())
                  : -1;
  }
}

// Whether all values up to kReach cells away along the row, and along the column, are known.
ImageU8 WholeCells(const ImageF& gray) {
  constexpr uint8_t kLength = 2 * kReach + 1;
  ImageU8 whole(gray.rows(), gray.cols());
  std::vector<uint8_t> up(static_cast<size_t>(gray.cols()), 0);  // known cells in a row, so far
  for (int r = 0; r < gray.rows(); ++r) {
    uint8_t along = 0;
    for (int c = 0; c < gray.cols(); ++c) {
      const auto next = [&](uint8_t count) {
        return gray(r, c) >= 0 ? std::min<uint8_t>(count + 1, kLength) : uint8_t{0};
      };
      along = next(along);
      up[static_cast<size_t>(c)] = next(up[static_cast<size_t>(c)]);
      if (along == kLength) whole(r, c - kReach) = 1;
      if (up[static_cast<size_t>(c)] == kLength) whole(r - kReach, c) |= 2;
    }
  }
  return whole;
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
  const auto first = std::find_if(weights.begin(), weights.end(), is_seen) - weights.begin();
  const auto last = weights.rend() - std::find_if(weights.rbegin(), weights.rend(), is_seen);
  const Rigid3 cam_from_home = view.home_from_cam.Inverse();
  Vector3d step;
  step << step_m_ * along_, 0;
  ImageF gray(rows(), cols(), 1, -1.0F);
  for (int r = 0; r < rows(); ++r) {
    Vector3d from;
    from << PlanPoint(static_cast<int>(first)), floor_z_ + (r + 0.5) * step_m_;
    LookAlong(view, cam_from_home * from, cam_from_home.rotation * step,
              {gray.row(r) + first, gray.row(r) + last});
    for (auto c = first; c < last; ++c) {
      if (!is_seen(weights[static_cast<size_t>(c)])) gray.row(r)[c] = -1;
    }
  }
  AddSmoothed(gray, weights);
}

void Facade::AddSmoothed(const ImageF& gray, const std::vector<float>& weights) {
  const ImageF smooth = Smoothed(gray);
  const ImageU8 whole = WholeCells(gray);
  for (int r = kReach; r + kReach < rows(); ++r) {
    for (int c = kReach; c + kReach < cols(); ++c) {
      if (whole(r, c) != 3) continue;
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
  weight_ = {};
}

}  // namespace enfilade
