// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>

#include "enfilade/base/errors.h"
#include "src/exchange/colmap_model.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

constexpr int kSimplePinhole = 0;
constexpr int kPinhole = 1;
constexpr int kEquirectangular = 17;
constexpr double kQuaternionTolerance = 1e-2;
constexpr uint64_t kMaxSide_px = 1000000;

// In the order of their ids (COLMAP 4.1).
constexpr std::array<std::string_view, 18> kModelNames = {"SIMPLE_PINHOLE",
                                                          "PINHOLE",
                                                          "SIMPLE_RADIAL",
                                                          "RADIAL",
                                                          "OPENCV",
                                                          "OPENCV_FISHEYE",
                                                          "FULL_OPENCV",
                                                          "FOV",
                                                          "SIMPLE_RADIAL_FISHEYE",
                                                          "RADIAL_FISHEYE",
                                                          "THIN_PRISM_FISHEYE",
                                                          "RAD_TAN_THIN_PRISM_FISHEYE",
                                                          "SIMPLE_DIVISION",
                                                          "DIVISION",
                                                          "SIMPLE_FISHEYE",
                                                          "FISHEYE",
                                                          "EUCM",
                                                          "EQUIRECTANGULAR"};

ScenePoint MakePoint(const ColmapPoint& point, const std::map<uint32_t, int>& picture_of,
                     const std::string& where) {
  if (!point.position.allFinite()) {
    throw InvalidInputError(where, "a point is not finite", "check that the model is complete");
  }
  ScenePoint made;
  made.position = point.position;
  made.rgb = point.rgb;
  for (const uint32_t image_id : point.image_ids) {
    if (const auto it = picture_of.find(image_id); it != picture_of.end()) {
      made.view_idx.push_back(it->second);
    }
  }
  return made;
}

}  // namespace

int ColmapModelId(const std::string& name) {
  const auto it = std::find(kModelNames.begin(), kModelNames.end(), name);
  return it == kModelNames.end() ? -1 : static_cast<int>(it - kModelNames.begin());
}

int NumColmapParams(int model_id, const std::string& where) {
  if (model_id == kSimplePinhole) return 3;
  if (model_id == kPinhole) return 4;
  if (model_id == kEquirectangular) return 2;
  const bool is_known = model_id >= 0 && model_id < static_cast<int>(kModelNames.size());
  throw InvalidInputError(where,
                          "has a camera of model " +
                              (is_known ? std::string(kModelNames[static_cast<size_t>(model_id)])
                                        : "number " + std::to_string(model_id)) +
                              ", only EQUIRECTANGULAR, PINHOLE and SIMPLE_PINHOLE are supported",
                          "undistort the pictures first (colmap image_undistorter)");
}

Camera MakeColmapCamera(int model_id, uint64_t width, uint64_t height,
                        const std::vector<double>& params, const std::string& where) {
  if (width == 0 || height == 0 || width > kMaxSide_px || height > kMaxSide_px) {
    throw InvalidInputError(where, "has a camera without a sensible size",
                            "check that the model is complete");
  }
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  if (model_id == kEquirectangular) return EquirectangularCamera(w, h);
  const bool is_simple = model_id == kSimplePinhole;
  const double fx = params[0], fy = params[is_simple ? 0 : 1];
  const double cx = params[is_simple ? 1 : 2], cy = params[is_simple ? 2 : 3];
  if (!(std::isfinite(fx) && std::isfinite(fy) && fx > 0 && fy > 0 && std::isfinite(cx) &&
        std::isfinite(cy))) {
    throw InvalidInputError(where, "has a camera without a sensible focal length",
                            "check that the model is complete");
  }
  return PinholeCamera(w, h, fx, fy, cx, cy);
}

Rigid3 MakeColmapPose(const Eigen::Vector4d& qw_qx_qy_qz, const Eigen::Vector3d& translation,
                      const std::string& name, const std::string& where) {
  if (!(std::abs(qw_qx_qy_qz.norm() - 1) <= kQuaternionTolerance) || !translation.allFinite()) {
    throw InvalidInputError(where, "the pose of '" + name + "' is no rotation and translation",
                            "check that the model is complete");
  }
  const Eigen::Quaterniond q(qw_qx_qy_qz[0], qw_qx_qy_qz[1], qw_qx_qy_qz[2], qw_qx_qy_qz[3]);
  return {q.normalized().toRotationMatrix(), translation};
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
    poses.points.push_back(MakePoint(point, picture_of, where));
  }
  return poses;
}

}  // namespace enfilade
