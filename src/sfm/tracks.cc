// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/tracks.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "enfilade/base/disjoint_sets.h"
#include "enfilade/sfm/view_graph.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr float kSameRay = 1e-5F;
// Pairs of rays that are tried: all of short tracks, neighbours in long ones.
constexpr size_t kMaxSpread = 6;

struct Ray {
  Vector3d center, direction;
};

Ray RayOf(const Observation& observation, std::span<const Rigid3> world_from_cam,
          std::span<const PanoFeatures> features) {
  const Rigid3& pose = world_from_cam[static_cast<size_t>(observation.view_idx)];
  const Eigen::Vector3f& ray = features[static_cast<size_t>(observation.view_idx)]
                                   .rays[static_cast<size_t>(observation.feature_idx)];
  return {pose.translation, pose.rotation * ray.cast<double>()};
}

// The point nearest to the chosen rays; false where they are parallel.
bool NearestPoint(std::span<const Ray> rays, const std::vector<size_t>& chosen, Vector3d& point) {
  Matrix3d normal = Matrix3d::Zero();
  Vector3d rhs = Vector3d::Zero();
  for (const size_t i : chosen) {
    const Matrix3d across =
        Matrix3d::Identity() - rays[i].direction * rays[i].direction.transpose();
    normal += across;
    rhs += across * rays[i].center;
  }
  const Eigen::LDLT<Matrix3d> ldlt(normal);
  if (ldlt.vectorD().minCoeff() < 1e-7) return false;
  point = ldlt.solve(rhs);
  return true;
}

double ErrorOf(const Ray& ray, const Vector3d& point) {
  const Vector3d to_point = point - ray.center;
  return std::atan2(ray.direction.cross(to_point).norm(), ray.direction.dot(to_point));
}

std::vector<size_t> Agreeing(std::span<const Ray> rays, const Vector3d& point, double bound_rad) {
  std::vector<size_t> agreeing;
  for (size_t i = 0; i < rays.size(); ++i) {
    if (ErrorOf(rays[i], point) < bound_rad) agreeing.push_back(i);
  }
  return agreeing;
}

double LargestAngle(std::span<const Ray> rays, const std::vector<size_t>& chosen,
                    const Vector3d& point) {
  double largest = 0;
  for (size_t i = 0; i < chosen.size(); ++i) {
    for (size_t j = i + 1; j < chosen.size(); ++j) {
      const Vector3d a = (point - rays[chosen[i]].center).normalized();
      const Vector3d b = (point - rays[chosen[j]].center).normalized();
      largest = std::max(largest, std::atan2(a.cross(b).norm(), a.dot(b)));
    }
  }
  return largest;
}

}  // namespace

std::vector<Track> BuildTracks(std::span<const PanoPair> pairs,
                               std::span<const PanoFeatures> features) {
  std::vector<int> first(features.size() + 1, 0);
  for (size_t i = 0; i < features.size(); ++i) first[i + 1] = first[i] + features[i].size();
  DisjointSets sets(first.back());
  for (const PanoPair& pair : pairs) {
    if (pair.verdict != PairVerdict::kAccepted) continue;
    for (const FeatureMatch& match : pair.inliers) {
      sets.Join(first[static_cast<size_t>(pair.a_idx)] + match.a_idx,
                first[static_cast<size_t>(pair.b_idx)] + match.b_idx);
    }
  }
  std::vector<Track> of_root(static_cast<size_t>(first.back()));
  std::vector<bool> is_false(of_root.size(), false);
  for (size_t view = 0; view < features.size(); ++view) {
    for (int i = 0; i < features[view].size(); ++i) {
      const size_t root = static_cast<size_t>(sets.Find(first[view] + i));
      std::vector<Observation>& seen = of_root[root].observations;
      if (!seen.empty() && seen.back().view_idx == static_cast<int>(view)) {
        const auto& rays = features[view].rays;
        const auto& other = rays[static_cast<size_t>(seen.back().feature_idx)];
        is_false[root] = is_false[root] || (rays[static_cast<size_t>(i)] - other).norm() > kSameRay;
        continue;
      }
      seen.push_back({static_cast<int>(view), i});
    }
  }
  std::vector<Track> tracks;
  for (size_t root = 0; root < of_root.size(); ++root) {
    if (of_root[root].observations.size() >= 2 && !is_false[root]) {
      tracks.push_back(std::move(of_root[root]));
    }
  }
  return tracks;
}

bool TriangulateTrack(std::span<const Rigid3> world_from_cam,
                      std::span<const PanoFeatures> features, const TriangulationBounds& bounds,
                      Track& track) {
  std::vector<Ray> rays;
  for (const Observation& observation : track.observations) {
    rays.push_back(RayOf(observation, world_from_cam, features));
  }
  std::vector<size_t> best;
  Vector3d best_point = Vector3d::Zero();
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t j = i + 1; j < std::min(rays.size(), i + 1 + kMaxSpread); ++j) {
      Vector3d point;
      if (!NearestPoint(rays, {i, j}, point)) continue;
      std::vector<size_t> agreeing = Agreeing(rays, point, bounds.max_error_rad);
      if (agreeing.size() <= best.size() || agreeing.size() < 2) continue;
      best = std::move(agreeing);
      best_point = point;
    }
  }
  if (best.size() < 2 || !NearestPoint(rays, best, best_point)) return false;
  best = Agreeing(rays, best_point, bounds.max_error_rad);
  if (best.size() < 2 || LargestAngle(rays, best, best_point) < bounds.min_angle_rad) return false;
  std::vector<Observation> kept;
  for (const size_t i : best) kept.push_back(track.observations[i]);
  track.observations = std::move(kept);
  track.position = best_point;
  return true;
}

std::vector<Track> TriangulateTracks(std::span<const Rigid3> world_from_cam,
                                     std::span<const PanoFeatures> features,
                                     const TriangulationBounds& bounds, std::vector<Track> tracks) {
  std::erase_if(tracks, [&](Track& track) {
    return !TriangulateTrack(world_from_cam, features, bounds, track);
  });
  return tracks;
}

}  // namespace enfilade
