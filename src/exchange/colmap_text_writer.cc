// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <string_view>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/colmap_camera.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {
namespace {

// Text that grows by formatted pieces.
class Text {
 public:
  explicit Text(std::string_view head) : text_(head) {}

  template <typename... Args>
  void Append(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string CamerasText(const ColmapModel& model) {
  Text text("# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n");
  for (const auto& [id, camera] : model.cameras) {
    const ColmapIntrinsics intrinsics = IntrinsicsOf(camera);
    text.Append("{} {} {} {} {}\n", id, intrinsics.model_name, camera.width, camera.height,
                fmt::join(intrinsics.params, " "));
  }
  return text.text();
}

std::string ImagesText(const ColmapModel& model) {
  Text text(
      "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID on the next "
      "line\n");
  for (const ColmapImage& image : model.images) {
    text.Append("{} {} {} {} {}\n", image.id,
                fmt::join(ColmapQuaternion(image.cam_from_world.rotation), " "),
                fmt::join(image.cam_from_world.translation, " "), image.camera_id, image.name);
    std::string_view separator = "";
    for (const ColmapPoint2D& point : image.points2d) {
      // Points without id, which are 2^64 − 1, stand as −1.
      text.Append("{}{} {} {}", separator, point.pixel.x(), point.pixel.y(),
                  static_cast<int64_t>(point.point_id));
      separator = " ";
    }
    text.Append("\n");
  }
  return text.text();
}

std::string PointsText(const ColmapModel& model) {
  Text text("# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n");
  for (const ColmapPoint& point : model.points) {
    text.Append("{} {} {} {}", point.id, fmt::join(point.position, " "),
                fmt::join(Eigen::Vector3i(point.rgb.cast<int>()), " "), point.error_px);
    for (const ColmapObservation& observation : point.track) {
      text.Append(" {} {}", observation.image_id, observation.point2d_idx);
    }
    text.Append("\n");
  }
  return text.text();
}

void CheckNames(const ColmapModel& model, const std::filesystem::path& path) {
  for (const ColmapImage& image : model.images) {
    if (image.name.find_first_of(" \t\n\v\f\r") == std::string::npos) continue;
    throw InvalidInputError(
        path.native(), "cannot hold the name '" + image.name + "', COLMAP ends names at a space",
        "write the binary form or rename the picture");
  }
}

}  // namespace

void WriteColmapText(const std::filesystem::path& folder, const ColmapModel& model) {
  CheckNames(model, folder / "images.txt");
  WriteFileAtomic(folder / "cameras.txt", CamerasText(model));
  WriteFileAtomic(folder / "images.txt", ImagesText(model));
  WriteFileAtomic(folder / "points3D.txt", PointsText(model));
}

}  // namespace enfilade
