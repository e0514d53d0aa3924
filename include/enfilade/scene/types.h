// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// One picture with its camera and pose.
struct View {
  std::string picture;         ///< file name without folder, as the user knows it
  std::filesystem::path path;  ///< where to read it
  std::string sha256;          ///< of the file's bytes
  Camera camera;
  Rigid3 world_from_cam;  ///< metres, world z up
  int storey_idx = 0;     ///< into the storeys, from bottom to top
  int component_idx = 0;  ///< connected component of poses
  bool is_pose_inferred = false;
  std::filesystem::path mask_path;  ///< grey picture of the same size, 0 = ignore; empty = none
  /// Upward in the camera frame, unit, as the picture's metadata tell it: a hint, often wrong.
  std::optional<Eigen::Vector3d> told_up_in_cam;
};

/// Whether the picture is a full equirectangular panorama.
[[nodiscard]] inline bool IsPanorama(const View& view) {
  return view.camera.model == CameraModel::kEquirectangular;
}

/// A reconstructed point.
struct ScenePoint {
  Eigen::Vector3d position;         ///< in world
  Eigen::Vector3d normal{0, 0, 0};  ///< unit, or zero when unknown
  Eigen::Matrix<uint8_t, 3, 1> rgb{0, 0, 0};
  std::vector<int> view_idx;  ///< views that see it
  /// Where each of view_idx shows it, in pixels of that view's picture; empty when unknown.
  std::vector<Eigen::Vector2f> pixels;
};

/// How the length unit of the world became metres.
enum class ScaleSource { kPoses, kCameraHeight, kKnownDistance, kAssumed };
[[nodiscard]] std::span<const std::string_view> EnumNames(ScaleSource);

/// Which file the poses came from.
enum class PoseSource { kTransforms, kColmap, kCsv, kZind, kEstimated };
[[nodiscard]] std::span<const std::string_view> EnumNames(PoseSource);

/// Views in the order of their picture's hash, so that renaming or regrouping files changes
/// nothing.
struct Scene {
  std::vector<View> views;
  std::vector<ScenePoint> points;
  PoseSource pose_source = PoseSource::kEstimated;
  ScaleSource scale_source = ScaleSource::kPoses;
  /// Height of the cameras above the floor as files or the user give it: a prior, not a fact.
  std::optional<double> camera_height_m;
};

}  // namespace enfilade
