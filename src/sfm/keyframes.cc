// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/keyframes.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kNumReweightings = 15;
// Angles below this count alike: that of a pixel or so.
constexpr double kMinAngle_rad = 1e-3;

// Robust against rounding for both small and large angles.
double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct RayPairs {
  std::vector<Vector3d> first, second;
};

// Rays of the tracks that both frames have; both list them by rising id.
RayPairs SharedRays(const TrackedFrame& a, const TrackedFrame& b, const Camera& camera) {
  RayPairs pairs;
  auto other = b.points.begin();
  for (const TrackPoint& point : a.points) {
    while (other != b.points.end() && other->track_id < point.track_id) ++other;
    if (other == b.points.end() || other->track_id != point.track_id) continue;
    pairs.first.push_back(camera.RayFromPixel(point.position_px));
    pairs.second.push_back(camera.RayFromPixel(other->position_px));
  }
  return pairs;
}

}  // namespace

std::optional<Matrix3d> FitRotation(std::span<const Vector3d> first_rays,
                                    std::span<const Vector3d> second_rays) {
  ENFILADE_CHECK(first_rays.size() == second_rays.size());
  if (first_rays.size() < 3) return std::nullopt;
  std::vector<double> weights(first_rays.size(), 1.0);
  Matrix3d rotation = Matrix3d::Identity();
  for (int round = 0; round <= kNumReweightings; ++round) {
    Matrix3d correlation = Matrix3d::Zero();
    for (size_t i = 0; i < first_rays.size(); ++i) {
      correlation += weights[i] * second_rays[i] * first_rays[i].transpose();
    }
    const Eigen::JacobiSVD<Matrix3d> svd(correlation);
    // Parallel rays leave the turn about themselves open.
    if (!(svd.singularValues()[1] > 1e-9 * svd.singularValues()[0])) return std::nullopt;
    rotation = NearestRotation(correlation);
    for (size_t i = 0; i < first_rays.size(); ++i) {
      weights[i] =
          1 / std::max(AngleBetween(rotation * first_rays[i], second_rays[i]), kMinAngle_rad);
    }
  }
  return rotation;
}

std::optional<double> MedianParallax(std::span<const Vector3d> first_rays,
                                     std::span<const Vector3d> second_rays) {
  const std::optional<Matrix3d> rotation = FitRotation(first_rays, second_rays);
  if (!rotation) return std::nullopt;
  std::vector<double> angles;
  angles.reserve(first_rays.size());
  for (size_t i = 0; i < first_rays.size(); ++i) {
    angles.push_back(AngleBetween(*rotation * first_rays[i], second_rays[i]));
  }
  return UpperMedian(std::move(angles));
}

std::vector<int> SelectKeyframes(std::span<const TrackedFrame> frames, const Camera& camera,
                                 const KeyframeOptions& options) {
  std::vector<int> keyframes;
  if (frames.empty()) return keyframes;
  keyframes.push_back(0);
  const double min_parallax = DegToRad(options.min_parallax_deg);
  for (int f = 1; f < static_cast<int>(frames.size()); ++f) {
    const auto shared_with = [&](int keyframe) {
      return SharedRays(frames[static_cast<size_t>(keyframe)], frames[static_cast<size_t>(f)],
                        camera);
    };
    const auto is_cut_off = [&](const RayPairs& pairs) {
      const size_t before = frames[static_cast<size_t>(keyframes.back())].points.size();
      return static_cast<double>(pairs.first.size()) <
             options.min_shared_share * static_cast<double>(before);
    };
    RayPairs pairs = shared_with(keyframes.back());
    if (is_cut_off(pairs)) {
      if (keyframes.back() < f - 1) keyframes.push_back(f - 1);
      pairs = shared_with(keyframes.back());
    }
    const std::optional<double> parallax = MedianParallax(pairs.first, pairs.second);
    if (is_cut_off(pairs) || (parallax && *parallax >= min_parallax)) keyframes.push_back(f);
  }
  return keyframes;
}

}  // namespace enfilade
