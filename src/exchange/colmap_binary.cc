// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>
#include <system_error>
#include <type_traits>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/colmap_camera.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {
namespace {

static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

// Values one after the other from the bytes of one file.
class BinaryFile {
 public:
  explicit BinaryFile(const std::filesystem::path& path)
      : where_(path.native()), bytes_(ReadFile(path)) {}

  [[nodiscard]] const std::string& where() const { return where_; }

  template <typename T>
  requires std::is_arithmetic_v<T>
  [[nodiscard]] T Take() {
    Require(sizeof(T));
    T value;
    std::memcpy(&value, bytes_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    return value;
  }

  [[nodiscard]] Eigen::Vector3d TakeVector3() {
    const double x = Take<double>(), y = Take<double>(), z = Take<double>();
    return {x, y, z};
  }

  // Up to the next zero byte, which is taken as well.
  [[nodiscard]] std::string TakeText() {
    const size_t end = bytes_.find('\0', position_);
    if (end == std::string::npos) Fail();
    std::string text = bytes_.substr(position_, end - position_);
    position_ = end + 1;
    return text;
  }

  // A number of entries of `size` bytes each, for which the file must have room.
  [[nodiscard]] size_t TakeCount(uint64_t size) {
    const auto count = Take<uint64_t>();
    if (count > (bytes_.size() - position_) / size) Fail();
    return static_cast<size_t>(count);
  }

  void ExpectEnd() const {
    if (position_ != bytes_.size()) {
      throw InvalidInputError(where_, "goes on after its last entry",
                              "check that it is a binary COLMAP model");
    }
  }

 private:
  [[noreturn]] void Fail() const {
    throw InvalidInputError(where_, "ends too early", "check that the file is complete");
  }
  void Require(size_t size) const {
    if (bytes_.size() - position_ < size) Fail();
  }

  std::string where_;
  std::string bytes_;
  size_t position_ = 0;
};

void ReadCameras(BinaryFile file, ColmapModel& model) {
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

void ReadImages(BinaryFile file, ColmapModel& model) {
  constexpr uint64_t kPoint2DBytes = 24;  // x, y, id of the 3D point
  const auto count = file.Take<uint64_t>();
  for (uint64_t i = 0; i < count; ++i) {
    ColmapImage image;
    image.id = file.Take<uint32_t>();
    Eigen::Vector4d q;
    for (double& component : q) component = file.Take<double>();
    const Eigen::Vector3d translation = file.TakeVector3();
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

void ReadPoints(BinaryFile file, ColmapModel& model) {
  constexpr uint64_t kObservationBytes = 8;  // ids of image and 2D point
  const auto count = file.Take<uint64_t>();
  for (uint64_t i = 0; i < count; ++i) {
    ColmapPoint point;
    point.id = file.Take<uint64_t>();
    point.position = file.TakeVector3();
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
  ReadCameras(BinaryFile(folder / "cameras.bin"), model);
  ReadImages(BinaryFile(folder / "images.bin"), model);
  std::error_code ignored;
  if (std::filesystem::exists(folder / "points3D.bin", ignored)) {
    ReadPoints(BinaryFile(folder / "points3D.bin"), model);
  }
  return model;
}

}  // namespace enfilade
