// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/camera.h"

namespace enfilade {

/// The id of the point of a 2D point that belongs to none.
inline constexpr uint64_t kNoColmapPoint = ~uint64_t{0};

/// Where an image shows something.
struct ColmapPoint2D {
  Eigen::Vector2d pixel;
  uint64_t point_id = kNoColmapPoint;
};

struct ColmapImage {
  uint32_t id = 0;
  uint32_t camera_id = 0;
  Rigid3 cam_from_world;
  std::string name;
  std::vector<ColmapPoint2D> points2d;
};

/// One entry of a track.
struct ColmapObservation {
  uint32_t image_id = 0;
  uint32_t point2d_idx = 0;  ///< into the image's points2d
};

struct ColmapPoint {
  uint64_t id = 0;
  Eigen::Vector3d position;
  Eigen::Matrix<uint8_t, 3, 1> rgb;
  double error_px = -1;  ///< mean reprojection error, negative when unknown
  std::vector<ColmapObservation> track;
};

/// A COLMAP model as its files hold it, but for rigs and frames.
struct ColmapModel {
  std::map<uint32_t, Camera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;
};

/// Each reads the three files of a folder, points3D only where it exists. Tracks may name images
/// and 2D points that are not there. Throws IoError, InvalidInputError.
[[nodiscard]] ColmapModel ReadColmapBinary(const std::filesystem::path& folder);
[[nodiscard]] ColmapModel ReadColmapText(const std::filesystem::path& folder);

/// Each writes the three files, each atomically. Numbers are kept exactly. Throws IoError; the text
/// form also InvalidInputError, before it writes anything, for a name with white space, at which
/// COLMAP would cut it.
void WriteColmapBinary(const std::filesystem::path& folder, const ColmapModel& model);
void WriteColmapText(const std::filesystem::path& folder, const ColmapModel& model);

/// The rotation of a unit quaternion (tolerance 1e-2) and a finite translation, or
/// InvalidInputError naming the image.
[[nodiscard]] Rigid3 MakeColmapPose(const Eigen::Vector4d& qw_qx_qy_qz,
                                    const Eigen::Vector3d& translation, const std::string& name,
                                    const std::string& where);
/// The unit quaternion qw qx qy qz of a rotation, with qw ≥ 0.
[[nodiscard]] Eigen::Vector4d ColmapQuaternion(const Eigen::Matrix3d& rotation);

}  // namespace enfilade
