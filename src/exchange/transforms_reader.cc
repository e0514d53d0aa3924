// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"
#include "src/exchange/json_geometry.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

// The value of `key` for one frame: its own, else the file's, else null.
const Json& FrameValue(const Json& file, const Json& frame, const char* key) {
  static const Json kNull;
  if (const auto it = frame.find(key); it != frame.end()) return *it;
  const auto it = file.find(key);
  return it == file.end() ? kNull : *it;
}

double FrameNumber(const Json& file, const Json& frame, const char* key, double missing,
                   const std::string& where) {
  const Json& value = FrameValue(file, frame, key);
  return value.is_null() ? missing : NumberFromJson(value, where, std::string("key '") + key + "'");
}

int FrameSize(const Json& file, const Json& frame, const char* key, const std::string& where) {
  const double size = FrameNumber(file, frame, key, 0, where);
  if (size < 0 || size > 1e6 || size != std::floor(size)) {
    throw InvalidInputError(where, std::string("key '") + key + "' is no picture size",
                            "make it a whole number of pixels");
  }
  return static_cast<int>(size);
}

void RefuseDistortion(const Json& file, const Json& frame, const std::string& where) {
  for (const char* key : {"k1", "k2", "k3", "k4", "k5", "k6", "p1", "p2"}) {
    if (FrameNumber(file, frame, key, 0, where) != 0) {
      throw InvalidInputError(where, std::string("lens distortion '") + key + "' is not supported",
                              "undistort the pictures first");
    }
  }
}

Camera FrameCamera(const Json& file, const Json& frame, const std::string& where) {
  const Json& model_value = FrameValue(file, frame, "camera_model");
  const std::string model = model_value.is_string() ? model_value.get<std::string>() : "";
  Camera camera;
  camera.width = FrameSize(file, frame, "w", where);
  camera.height = FrameSize(file, frame, "h", where);
  if (model == "EQUIRECTANGULAR") return camera;
  if (!model.empty() && model != "PINHOLE" && model != "SIMPLE_PINHOLE" && model != "OPENCV") {
    throw InvalidInputError(where, "camera_model '" + model + "' is not supported",
                            "give EQUIRECTANGULAR panoramas or undistorted PINHOLE pictures");
  }
  RefuseDistortion(file, frame, where);
  camera.model = CameraModel::kPinhole;
  camera.fx = FrameNumber(file, frame, "fl_x", 0, where);
  camera.fy = FrameNumber(file, frame, "fl_y", camera.fx, where);
  if (!(camera.fx > 0 && camera.fy > 0)) {
    throw InvalidInputError(where,
                            "has neither camera_model EQUIRECTANGULAR nor a focal length fl_x",
                            "add \"camera_model\": \"EQUIRECTANGULAR\" for panoramas");
  }
  camera.cx = FrameNumber(file, frame, "cx", 0.5 * camera.width, where);
  camera.cy = FrameNumber(file, frame, "cy", 0.5 * camera.height, where);
  if (camera.width == 0 || camera.height == 0) {
    throw InvalidInputError(where, "pinhole pictures have no size", "add keys w and h");
  }
  return camera;
}

}  // namespace

PoseFile ReadTransforms(const std::filesystem::path& path) {
  const std::string& where = path.native();
  const Json file = ReadJsonFile(path);
  PoseFile poses;
  poses.path = path;
  poses.base = path.parent_path();
  poses.source = PoseSource::kTransforms;
  for (const Json& frame : JsonArray(file, "frames", where)) {
    PosedPicture picture;
    picture.name = JsonString(frame, "file_path", where);
    if (frame.contains("mask_path")) picture.mask = JsonString(frame, "mask_path", where);
    picture.camera = FrameCamera(file, frame, where);
    const Rigid3 world_from_gl = Rigid3FromJson(JsonArray(frame, "transform_matrix", where), where,
                                                "transform_matrix of '" + picture.name + "'");
    // OpenGL camera axes (x right, y up, z back) to ours (x right, y down, z forward).
    picture.world_from_cam = {world_from_gl.rotation * Eigen::Vector3d(1, -1, -1).asDiagonal(),
                              world_from_gl.translation};
    poses.pictures.push_back(std::move(picture));
  }
  return poses;
}

}  // namespace enfilade
