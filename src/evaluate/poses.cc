// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/poses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "enfilade/base/check.h"
#include "src/evaluate/plane_fit.h"
#include "src/evaluate/statistics.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A camera beside its true pose.
struct PosePair {
  int view_idx;
  const JudgedCamera* camera;
  const Rigid3* truth_from_cam;

  [[nodiscard]] PointPair InPlan() const {
    return {camera->world_from_cam.translation.head<2>(), truth_from_cam->translation.head<2>()};
  }
};

std::vector<PosePair> PairPoses(std::span<const JudgedCamera> cameras, const GroundTruth& truth,
                                std::span<const int> truth_idx) {
  ENFILADE_CHECK(truth_idx.size() == cameras.size());
  std::vector<PosePair> pairs;
  for (size_t i = 0; i < cameras.size(); ++i) {
    if (truth_idx[i] < 0) continue;
    const TruthView& view = truth.views[static_cast<size_t>(truth_idx[i])];
    if (view.world_from_cam) {
      pairs.push_back({static_cast<int>(i), &cameras[i], &*view.world_from_cam});
    }
  }
  return pairs;
}

// The pairs whose camera image evidence puts into the largest component.
std::vector<PosePair> PairsOfLargest(std::span<const JudgedCamera> cameras,
                                     const std::vector<PosePair>& pairs) {
  const std::optional<int> largest = LargestComponent(cameras);
  std::vector<PosePair> kept;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(kept), [&](const PosePair& pair) {
    return !pair.camera->is_inferred && pair.camera->component_idx == largest;
  });
  return kept;
}

std::vector<PointPair> InPlan(const std::vector<PosePair>& pairs) {
  std::vector<PointPair> points;
  for (const PosePair& pair : pairs) points.push_back(pair.InPlan());
  return points;
}

Matrix3d TruthFromCameraRotation(const PosePair& pair) {
  return pair.truth_from_cam->rotation * pair.camera->world_from_cam.rotation.transpose();
}

// For cameras that stand in one place: turned as they are, their means on one another.
Similarity2 FitInOnePlace(const std::vector<PosePair>& pairs) {
  double sine = 0, cosine = 0;
  for (const PosePair& pair : pairs) {
    const double yaw = YawOf(TruthFromCameraRotation(pair));
    sine += std::sin(yaw);
    cosine += std::cos(yaw);
  }
  Similarity2 fit;
  fit.angle_rad = std::atan2(sine, cosine);
  const Similarity2 turn = fit;
  for (const PosePair& pair : pairs) {
    const PointPair points = pair.InPlan();
    fit.translation += (points.target - turn * points.source) / static_cast<double>(pairs.size());
  }
  return fit;
}

double MedianHeightShift(const std::vector<PosePair>& pairs, const Similarity2& fit) {
  std::vector<double> all, inliers;
  for (const PosePair& pair : pairs) {
    const PointPair points = pair.InPlan();
    all.push_back(pair.truth_from_cam->translation.z() -
                  pair.camera->world_from_cam.translation.z());
    if ((fit * points.source - points.target).norm() < kFitReach_m) inliers.push_back(all.back());
  }
  return Median(inliers.empty() ? all : inliers).value_or(0);
}

PoseError ErrorOf(const PosePair& pair) {
  const Matrix3d left = TruthFromCameraRotation(pair);
  PoseError error;
  error.view_idx = pair.view_idx;
  error.distance_m =
      (pair.truth_from_cam->translation - pair.camera->world_from_cam.translation).norm();
  error.angle_rad = Eigen::AngleAxisd(left).angle();
  error.yaw_rad = std::abs(YawOf(left));
  error.tilt_rad = std::atan2(left.col(2).head<2>().norm(), left(2, 2));
  return error;
}

}  // namespace

std::optional<int> LargestComponent(std::span<const JudgedCamera> cameras) {
  std::map<int, int> size_of_component;
  for (const JudgedCamera& camera : cameras) {
    if (!camera.is_inferred) ++size_of_component[camera.component_idx];
  }
  const auto largest =
      std::max_element(size_of_component.begin(), size_of_component.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return largest != size_of_component.end() ? std::optional(largest->first) : std::nullopt;
}

std::vector<JudgedCamera> JudgedCameras(const Scene& scene) {
  std::vector<JudgedCamera> cameras;
  for (const View& view : scene.views) {
    cameras.push_back({view.world_from_cam, view.component_idx, view.is_pose_inferred});
  }
  return cameras;
}

std::vector<JudgedCamera> JudgedCameras(const Floorplan& floorplan) {
  std::vector<JudgedCamera> cameras;
  for (const PlanCamera& camera : floorplan.cameras) {
    cameras.push_back({camera.world_from_cam, camera.component_idx, camera.is_inferred});
  }
  return cameras;
}

Rigid3 FitTruthFromWorld(std::span<const JudgedCamera> cameras, const GroundTruth& truth,
                         std::span<const int> truth_idx) {
  const std::vector<PosePair> pairs = PairsOfLargest(cameras, PairPoses(cameras, truth, truth_idx));
  if (pairs.empty()) return {};
  std::optional<Similarity2> fit = FitRobust(InPlan(pairs), false);
  if (!fit) fit = FitInOnePlace(pairs);
  return {RotationZ(fit->angle_rad),
          Vector3d(fit->translation.x(), fit->translation.y(), MedianHeightShift(pairs, *fit))};
}

std::optional<PoseFigures> EvaluatePoses(std::span<const JudgedCamera> cameras,
                                         const GroundTruth& truth, std::span<const int> truth_idx) {
  PoseFigures figures;
  figures.total = static_cast<int>(
      std::count_if(truth.views.begin(), truth.views.end(),
                    [](const TruthView& view) { return view.world_from_cam.has_value(); }));
  if (figures.total == 0) return std::nullopt;
  std::set<int> components;
  for (const JudgedCamera& camera : cameras) {
    if (!camera.is_inferred) components.insert(camera.component_idx);
  }
  figures.components = static_cast<int>(components.size());

  const std::optional<int> largest = LargestComponent(cameras);
  const std::vector<PosePair> pairs = PairPoses(cameras, truth, truth_idx);
  std::vector<double> distances, yaws, tilts;
  for (const PosePair& pair : pairs) {
    PoseError error = ErrorOf(pair);
    figures.inferred += pair.camera->is_inferred;
    error.is_registered = !pair.camera->is_inferred && pair.camera->component_idx == largest &&
                          error.distance_m < kRegistered_m && error.angle_rad < kRegistered_rad;
    figures.errors.push_back(error);
    if (!error.is_registered) continue;
    ++figures.registered;
    distances.push_back(error.distance_m);
    yaws.push_back(error.yaw_rad);
    tilts.push_back(error.tilt_rad);
  }
  figures.median_m = Median(distances);
  figures.max_m = Quantile(distances, 1);
  figures.yaw_median_rad = Median(yaws);
  figures.tilt_median_rad = Median(tilts);
  const auto similarity = FitRobust(InPlan(PairsOfLargest(cameras, pairs)), true);
  if (similarity) figures.scale_error = std::abs(similarity->scale - 1);
  return figures;
}

}  // namespace enfilade
