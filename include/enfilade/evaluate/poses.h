// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// What is judged of a camera.
struct JudgedCamera {
  Rigid3 world_from_cam;
  int component_idx = 0;
  bool is_inferred = false;
};

[[nodiscard]] std::vector<JudgedCamera> JudgedCameras(const Scene& scene);
[[nodiscard]] std::vector<JudgedCamera> JudgedCameras(const Floorplan& floorplan);

/// The component with most cameras that are not inferred (ties: the lowest index); none when all
/// are.
[[nodiscard]] std::optional<int> LargestComponent(std::span<const JudgedCamera> cameras);

/// truth_from_world for poses that were estimated: a turn about z and a shift in the plan, fitted
/// robustly to the positions of the cameras of the largest component (LargestComponent) that have a
/// true pose, without scale and never from the plan; and the shift in height that is the median of
/// those within 0.5 m. Where these cameras stand in one place, the turn is the mean of theirs. The
/// identity when there is none.
///
/// `truth_idx` gives the truth view of each camera, −1 for none (MatchPictures). Cost
/// O(min(n², 20 000) · n).
[[nodiscard]] Rigid3 FitTruthFromWorld(std::span<const JudgedCamera> cameras,
                                       const GroundTruth& truth, std::span<const int> truth_idx);

/// How far one camera is off.
struct PoseError {
  int view_idx = 0;
  bool is_registered = false;
  double distance_m = 0;
  double angle_rad = 0;  ///< of the whole rotation
  double yaw_rad = 0;    ///< about z: swing-twist decomposition
  double tilt_rad = 0;   ///< between the true up and the camera's
};

struct PoseFigures {
  int total = 0;                  ///< true views with a pose
  int registered = 0;             ///< cameras of the largest component, not inferred, within bounds
  int inferred = 0;               ///< cameras with a true pose whose own is inferred
  int components = 0;             ///< of the cameras that are not inferred
  std::vector<PoseError> errors;  ///< of all cameras with a true pose, in their order
  /// Over the registered ones.
  std::optional<double> median_m, max_m, yaw_median_rad, tilt_median_rad;
  /// |s − 1| of the robust similarity that takes the largest component to the truth.
  std::optional<double> scale_error;
};

/// A camera is registered when it is this near to its true pose.
inline constexpr double kRegistered_m = 0.5;
inline constexpr double kRegistered_rad = 0.08726646259971647;  // 5°

/// Judges cameras that were brought to the truth's world. None where the truth has no poses.
[[nodiscard]] std::optional<PoseFigures> EvaluatePoses(std::span<const JudgedCamera> cameras,
                                                       const GroundTruth& truth,
                                                       std::span<const int> truth_idx);

}  // namespace enfilade
