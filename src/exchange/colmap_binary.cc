// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <system_error>

#include "src/exchange/byte_file.h"
#include "src/exchange/colmap_camera.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {
namespace {

constexpr char kWhat[] = "a binary COLMAP model";

Eigen::Vector3d TakeVector3(ByteFile& file) {
  const double x = file.Take<double>(), y = file.Take<double>(), z = file.Take<double>();
  return {x, y, z};
}

void ReadCameras(ByteFile file, ColmapModel& model) {
  const auto count = file.Take<uint64_t>();
  for (uint64_t i = 0; i < count; ++i) {
    const auto id = file.Take<uint32_t>();
    const auto model_id = file.Take<int32_t>();
    const auto width = file.Take<uint64_t>(), height = file.Take<uint64_t>();
    std::vector<double> params;
    const int num_params = NumColmapParams(model_id, file.where());
    for (int k = 0; k < num_params; ++k) params.push_back(file.Take<double>());
    model.cameras[id] = MakeColmapCamera(model_id, width, height, params, file.where());
  }
  file.ExpectEnd();
}

void ReadImages(ByteFile file, ColmapModel& model) {
  constexpr uint64_t kPoint2DBytes = 24;  // x, y, id of the 3D point
  const auto count = file.Take<uint64_t>();
  for (uint64_t i = 0; i < count; ++i) {
    ColmapImage image;
    image.id = file.Take<uint32_t>();
    Eigen::Vector4d q;
    for (double& component : q) component = file.Take<double>();
    const Eigen::Vector3d translation = TakeVector3(file);
    image.camera_id = file.Take<uint32_t>();
    image.name = file.TakeText();
    image.cam_from_world = MakeColmapPose(q, translation, image.name, file.where());
    image.points2d.resize(file.TakeCount(kPoint2DBytes));
    for (ColmapPoint2D& point : image.points2d) {
      point.pixel.x() = file.Take<double>();
      point.pixel.y() = file.Take<double>();
      point.point_id = file.Take<uint64_t>();
    }
    model.images.push_back(std::move(image));
  }
  file.ExpectEnd();
}

void ReadPoints(ByteFile file, ColmapModel& model) {
  constexpr uint64_t kObservationBytes = 8;  // ids of image and 2D point
  const auto count = file.Take<uint64_t>();
  for (uint64_t i = 0; i < count; ++i) {
    ColmapPoint point;
    point.id = file.Take<uint64_t>();
    point.position = TakeVector3(file);
    for (uint8_t& channel : point.rgb) channel = file.Take<uint8_t>();
    point.error_px = file.Take<double>();
    point.track.resize(file.TakeCount(kObservationBytes));
    for (ColmapObservation& observation : point.track) {
      observation.image_id = file.Take<uint32_t>();
      observation.point2d_idx = file.Take<uint32_t>();
    }
    model.points.push_back(std::move(point));
  }
  file.ExpectEnd();
}

}  // namespace

ColmapModel ReadColmapBinary(const std::filesystem::path& folder) {
  ColmapModel model;
  ReadCameras(ByteFile(folder / "cameras.bin", kWhat), model);
  ReadImages(ByteFile(folder / "images.bin", kWhat), model);
  std::error_code ignored;
  if (std::filesystem::exists(folder / "points3D.bin", ignored)) {
    ReadPoints(ByteFile(folder / "points3D.bin", kWhat), model);
  }
  return model;
}

}  // namespace enfilade
