// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/file.h"
#include "src/exchange/colmap_camera.h"
#include "src/exchange/colmap_model.h"
#include "src/exchange/little_endian.h"

namespace enfilade {
namespace {

std::string CamerasBytes(const ColmapModel& model) {
  std::string bytes;
  AppendLittleEndian<uint64_t>(model.cameras.size(), bytes);
  for (const auto& [id, camera] : model.cameras) {
    const ColmapIntrinsics intrinsics = IntrinsicsOf(camera);
    AppendLittleEndian<uint32_t>(id, bytes);
    AppendLittleEndian<int32_t>(intrinsics.model_id, bytes);
    AppendLittleEndian<uint64_t>(static_cast<uint64_t>(camera.width), bytes);
    AppendLittleEndian<uint64_t>(static_cast<uint64_t>(camera.height), bytes);
    for (const double param : intrinsics.params) AppendLittleEndian(param, bytes);
  }
  return bytes;
}

std::string ImagesBytes(const ColmapModel& model) {
  std::string bytes;
  AppendLittleEndian<uint64_t>(model.images.size(), bytes);
  for (const ColmapImage& image : model.images) {
    AppendLittleEndian<uint32_t>(image.id, bytes);
    for (const double q : ColmapQuaternion(image.cam_from_world.rotation)) {
      AppendLittleEndian(q, bytes);
    }
    for (const double t : image.cam_from_world.translation) AppendLittleEndian(t, bytes);
    AppendLittleEndian<uint32_t>(image.camera_id, bytes);
    bytes.append(image.name.c_str(), image.name.size() + 1);
    AppendLittleEndian<uint64_t>(image.points2d.size(), bytes);
    for (const ColmapPoint2D& point : image.points2d) {
      AppendLittleEndian(point.pixel.x(), bytes);
      AppendLittleEndian(point.pixel.y(), bytes);
      AppendLittleEndian<uint64_t>(point.point_id, bytes);
    }
  }
  return bytes;
}

std::string PointsBytes(const ColmapModel& model) {
  std::string bytes;
  AppendLittleEndian<uint64_t>(model.points.size(), bytes);
  for (const ColmapPoint& point : model.points) {
    AppendLittleEndian<uint64_t>(point.id, bytes);
    for (const double coordinate : point.position) AppendLittleEndian(coordinate, bytes);
    for (const uint8_t channel : point.rgb) AppendLittleEndian(channel, bytes);
    AppendLittleEndian(point.error_px, bytes);
    AppendLittleEndian<uint64_t>(point.track.size(), bytes);
    for (const ColmapObservation& observation : point.track) {
      AppendLittleEndian<uint32_t>(observation.image_id, bytes);
      AppendLittleEndian<uint32_t>(observation.point2d_idx, bytes);
    }
  }
  return bytes;
}

}  // namespace

void WriteColmapBinary(const std::filesystem::path& folder, const ColmapModel& model) {
  WriteFileAtomic(folder / "cameras.bin", CamerasBytes(model));
  WriteFileAtomic(folder / "images.bin", ImagesBytes(model));
  WriteFileAtomic(folder / "points3D.bin", PointsBytes(model));
}

}  // namespace enfilade
