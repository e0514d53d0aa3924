// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <cmath>
#include <system_error>

#include "enfilade/base/errors.h"
#include "src/exchange/colmap_model.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

constexpr double kQuaternionTolerance = 1e-2;
constexpr double kMaxPixel = 1e7;

// `picture_of` gives the place of an image among the model's images by its id.
ScenePoint MakePoint(const ColmapPoint& point, const ColmapModel& model,
                     const std::map<uint32_t, int>& picture_of, const std::string& where) {
  if (!point.position.allFinite()) {
    throw InvalidInputError(where, "a point is not finite", "check that the model is complete");
  }
  ScenePoint made;
  made.position = point.position;
  made.rgb = point.rgb;
  for (const ColmapObservation& observation : point.track) {
    const auto it = picture_of.find(observation.image_id);
    if (it == picture_of.end()) continue;
    made.view_idx.push_back(it->second);
    const auto& points2d = model.images[static_cast<size_t>(it->second)].points2d;
    if (observation.point2d_idx >= points2d.size()) continue;
    const Eigen::Vector2d& pixel = points2d[observation.point2d_idx].pixel;
    if (!(pixel.cwiseAbs().maxCoeff() <= kMaxPixel)) {
      throw InvalidInputError(where, "a 2D point is no pixel", "check that the model is complete");
    }
    made.pixels.push_back(pixel.cast<float>());
  }
  if (made.pixels.size() != made.view_idx.size()) made.pixels.clear();
  return made;
}

}  // namespace

Rigid3 MakeColmapPose(const Eigen::Vector4d& qw_qx_qy_qz, const Eigen::Vector3d& translation,
                      const std::string& name, const std::string& where) {
  if (!(std::abs(qw_qx_qy_qz.norm() - 1) <= kQuaternionTolerance) || !translation.allFinite()) {
    throw InvalidInputError(where, "the pose of '" + name + "' is no rotation and translation",
                            "check that the model is complete");
  }
  const Eigen::Quaterniond q(qw_qx_qy_qz[0], qw_qx_qy_qz[1], qw_qx_qy_qz[2], qw_qx_qy_qz[3]);
  return {q.normalized().toRotationMatrix(), translation};
}

Eigen::Vector4d ColmapQuaternion(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Eigen::Vector4d qw_qx_qy_qz(q.w(), q.x(), q.y(), q.z());
  return (q.w() < 0 ? -1.0 : 1.0) * qw_qx_qy_qz.normalized();
}

PoseFile ReadColmapModel(const std::filesystem::path& folder) {
  const std::string& where = folder.native();
  std::error_code ignored;
  const bool is_binary = std::filesystem::exists(folder / "images.bin", ignored) &&
                         std::filesystem::exists(folder / "cameras.bin", ignored);
  const ColmapModel model = is_binary ? ReadColmapBinary(folder) : ReadColmapText(folder);
  PoseFile poses;
  poses.path = folder;
  poses.base = folder;
  poses.source = PoseSource::kColmap;
  std::map<uint32_t, int> picture_of;
  for (const ColmapImage& image : model.images) {
    const auto camera = model.cameras.find(image.camera_id);
    if (camera == model.cameras.end()) {
      throw InvalidInputError(where, "image '" + image.name + "' has a camera that is not there",
                              "check that images and cameras belong together");
    }
    if (!picture_of.emplace(image.id, static_cast<int>(poses.pictures.size())).second) {
      throw InvalidInputError(where, "has two images with id " + std::to_string(image.id),
                              "check that the model is complete");
    }
    PosedPicture picture;
    picture.name = image.name;
    picture.world_from_cam = image.cam_from_world.Inverse();
    picture.camera = camera->second;
    poses.pictures.push_back(std::move(picture));
  }
  for (const ColmapPoint& point : model.points) {
    poses.points.push_back(MakePoint(point, model, picture_of, where));
  }
  return poses;
}

}  // namespace enfilade
