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

struct ColmapImage {
  uint32_t id = 0;
  uint32_t camera_id = 0;
  Rigid3 cam_from_world;
  std::string name;
};

struct ColmapPoint {
  Eigen::Vector3d position;
  Eigen::Matrix<uint8_t, 3, 1> rgb;
  std::vector<uint32_t> image_ids;  ///< its track
};

/// A COLMAP model as its files hold it. Rigs, frames and 2D points are not read.
struct ColmapModel {
  std::map<uint32_t, Camera> cameras;
  std::vector<ColmapImage> images;
  std::vector<ColmapPoint> points;
};

/// Each reads the three files of a folder, points3D only where it exists. Throws IoError,
/// InvalidInputError.
[[nodiscard]] ColmapModel ReadColmapBinary(const std::filesystem::path& folder);
[[nodiscard]] ColmapModel ReadColmapText(const std::filesystem::path& folder);

/// Number of parameters of the supported models SIMPLE_PINHOLE (0), PINHOLE (1) and EQUIRECTANGULAR
/// (17); refuses the others.
[[nodiscard]] int NumColmapParams(int model_id, const std::string& where);
/// Id of a model by its name in text files; −1 when there is none.
[[nodiscard]] int ColmapModelId(const std::string& name);
[[nodiscard]] Camera MakeColmapCamera(int model_id, uint64_t width, uint64_t height,
                                      const std::vector<double>& params, const std::string& where);

/// The rotation of a unit quaternion (tolerance 1e-2) and a finite translation, or
/// InvalidInputError naming the image.
[[nodiscard]] Rigid3 MakeColmapPose(const Eigen::Vector4d& qw_qx_qy_qz,
                                    const Eigen::Vector3d& translation, const std::string& name,
                                    const std::string& where);

}  // namespace enfilade
