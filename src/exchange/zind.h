// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "enfilade/geometry/rigid3.h"
#include "enfilade/scene/types.h"

namespace enfilade {

/// Camera height taken when nothing tells the scale: what tripods for 360° cameras are set to.
inline constexpr double kAssumedCameraHeight_m = 1.5;

/// Distance between the floors of a tour, which its file does not tell.
inline constexpr double kZindStoreyHeight_m = 3.0;

/// One floor of a tour; the lowest has storey_idx 0.
struct ZindFloor {
  std::string key;
  double m_per_coordinate = 0;
  double floor_z = 0;
};

/// One panorama of a tour. Its local frame has the camera at the origin and its unit is the
/// camera's height; (x, y, z up) is left-handed.
struct ZindPanorama {
  std::string image_path;
  int floor_idx = 0;
  double scale = 1;         ///< floor coordinates per local unit
  double rotation_rad = 0;  ///< of local in floor coordinates
  Eigen::Vector2d translation{0, 0};
  double camera_height = 1;  ///< local units

  // For the truth only, never for poses.
  std::string group;                           ///< key of the group that the floor lists it in
  const nlohmann::json* annotation = nullptr;  ///< its object in ZindTour::json
};

/// A tour of the Zillow Indoor Dataset (Cruz et al. 2021), zind_data.json.
struct ZindTour {
  nlohmann::json json;
  std::vector<ZindFloor> floors;        ///< those with panoramas, in the order of their keys
  std::vector<ZindPanorama> panoramas;  ///< in the order of the file's keys
  ScaleSource scale_source = ScaleSource::kPoses;
  double camera_height_m = 0;  ///< median
  std::vector<std::string> warnings;

  /// Metres per local unit of a panorama.
  [[nodiscard]] double MetresPerLocal(const ZindPanorama& panorama) const;
  /// World: X = m·gx, Y = −m·gy, Z up; Z = 0 is the floor of the lowest storey.
  [[nodiscard]] Eigen::Vector2d WorldFromLocal(const ZindPanorama& panorama,
                                               const Eigen::Vector2d& local) const;
  [[nodiscard]] Rigid3 WorldFromCam(const ZindPanorama& panorama) const;
};

/// Reads positions, yaws, camera heights and scale. A floor whose scale is null is scaled so that
/// its cameras stand at `camera_height_m` (0: not given), else at the height of the other floors'
/// cameras, else at kAssumedCameraHeight_m, with a warning. The grouping of panoramas below a floor
/// may be of any depth. Panoramas without position are left out with a warning.
[[nodiscard]] ZindTour ReadZindTour(const std::filesystem::path& path, double camera_height_m);

}  // namespace enfilade
