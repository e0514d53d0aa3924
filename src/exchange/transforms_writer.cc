// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/transforms_writer.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "enfilade/base/json.h"
#include "src/exchange/relative_path.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json CameraToJson(const Camera& camera) {
  const bool is_pinhole = camera.model == CameraModel::kPinhole;
  // Nerfstudio's rays of a panorama are those of x in [−1, 1] and y in [−½, ½] after division by
  // the focal length.
  const double pano_focal_px = 0.5 * camera.width;
  return {{"camera_model", is_pinhole ? "PINHOLE" : "EQUIRECTANGULAR"},
          {"w", camera.width},
          {"h", camera.height},
          {"fl_x", is_pinhole ? camera.fx : pano_focal_px},
          {"fl_y", is_pinhole ? camera.fy : pano_focal_px},
          {"cx", is_pinhole ? camera.cx : 0.5 * camera.width},
          {"cy", is_pinhole ? camera.cy : 0.5 * camera.height}};
}

Json MatrixToJson(const Rigid3& world_from_cam) {
  Eigen::Matrix4d matrix = world_from_cam.Matrix();
  matrix.middleCols<2>(1) *= -1;  // our y down and z forward are OpenGL's −y and −z
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  }
  return rows;
}

Json FrameToJson(const View& view, const fs::path& folder) {
  const fs::path picture =
      view.path.empty() ? fs::path(view.picture) : RelativePath(view.path, folder);
  Json frame{{"file_path", picture.generic_string()},
             {"transform_matrix", MatrixToJson(view.world_from_cam)}};
  if (!view.mask_path.empty()) {
    frame["mask_path"] = RelativePath(view.mask_path, folder).generic_string();
  }
  return frame;
}

}  // namespace

void WriteTransforms(const fs::path& path, const Scene& scene) {
  std::vector<Json> cameras;
  for (const View& view : scene.views) cameras.push_back(CameraToJson(view.camera));
  const bool is_one_camera =
      !cameras.empty() && std::all_of(cameras.begin(), cameras.end(),
                                      [&](const Json& camera) { return camera == cameras[0]; });
  Json file = is_one_camera ? cameras[0] : Json::object();
  file["frames"] = Json::array();
  for (size_t i = 0; i < scene.views.size(); ++i) {
    Json frame = FrameToJson(scene.views[i], path.parent_path());
    if (!is_one_camera) frame.update(cameras[i]);
    file["frames"].push_back(std::move(frame));
  }
  WriteJsonFile(path, file);
}

}  // namespace enfilade
