// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <sstream>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "src/exchange/colmap_camera.h"
#include "src/exchange/colmap_model.h"

namespace enfilade {
namespace {

// The lines of a text file; comments are skipped.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& path)
      : where_(path.native()), lines_(ReadFile(path)) {}

  [[nodiscard]] const std::string& where() const { return where_; }

  // The words of the next line that is neither empty nor a comment.
  [[nodiscard]] std::optional<std::istringstream> NextEntry() {
    std::string text;
    while (std::getline(lines_, text)) {
      ++line_;
      if (!text.empty() && text.back() == '\r') text.pop_back();
      if (text.find_first_not_of(" \t") == std::string::npos || text.front() == '#') continue;
      return std::istringstream(text);
    }
    return std::nullopt;
  }

  // The words of the line right after an entry, which may be empty or the file's end.
  [[nodiscard]] std::istringstream LineAfterEntry() {
    std::string text;
    std::getline(lines_, text);
    ++line_;
    return std::istringstream(text);
  }

  [[noreturn]] void Fail(const std::string& entry) const {
    throw InvalidInputError(where_, entry + " cannot be read (line " + std::to_string(line_) + ")",
                            "check that it is a complete COLMAP model");
  }

 private:
  std::string where_;
  std::istringstream lines_;
  int line_ = 0;
};

void ReadCameras(TextFile file, ColmapModel& model) {
  while (auto words = file.NextEntry()) {
    uint32_t id = 0;
    std::string name;
    uint64_t width = 0, height = 0;
    if (!(*words >> id >> name >> width >> height)) file.Fail("a camera");
    const int model_id = ColmapModelId(name);
    if (model_id < 0) file.Fail("camera model '" + name + "'");
    std::vector<double> params(static_cast<size_t>(NumColmapParams(model_id, file.where())));
    for (double& param : params) {
      if (!(*words >> param)) file.Fail("a camera");
    }
    model.cameras[id] = MakeColmapCamera(model_id, width, height, params, file.where());
  }
}

std::vector<ColmapPoint2D> ReadPoints2D(TextFile& file, const std::string& image) {
  std::istringstream words = file.LineAfterEntry();
  std::vector<ColmapPoint2D> points;
  for (ColmapPoint2D point; words >> point.pixel.x();) {
    int64_t point_id = 0;  // −1 for none
    if (!(words >> point.pixel.y() >> point_id)) file.Fail("a 2D point of '" + image + "'");
    point.point_id = static_cast<uint64_t>(point_id);
    points.push_back(point);
  }
  if (!words.eof()) file.Fail("a 2D point of '" + image + "'");
  return points;
}

void ReadImages(TextFile file, ColmapModel& model) {
  while (auto words = file.NextEntry()) {
    ColmapImage image;
    Eigen::Vector4d q;
    Eigen::Vector3d translation;
    *words >> image.id >> q[0] >> q[1] >> q[2] >> q[3];
    *words >> translation.x() >> translation.y() >> translation.z() >> image.camera_id >> std::ws;
    if (!*words || !std::getline(*words, image.name)) file.Fail("an image");
    image.cam_from_world = MakeColmapPose(q, translation, image.name, file.where());
    image.points2d = ReadPoints2D(file, image.name);
    model.images.push_back(std::move(image));
  }
}

void ReadPoints(TextFile file, ColmapModel& model) {
  while (auto words = file.NextEntry()) {
    ColmapPoint point;
    Eigen::Vector3i rgb;
    Eigen::Vector3d& p = point.position;
    *words >> point.id >> p.x() >> p.y() >> p.z() >> rgb[0] >> rgb[1] >> rgb[2] >> point.error_px;
    if (!*words || rgb.minCoeff() < 0 || rgb.maxCoeff() > 255) file.Fail("a point");
    point.rgb = rgb.cast<uint8_t>();
    for (ColmapObservation observation; *words >> observation.image_id;) {
      if (!(*words >> observation.point2d_idx)) file.Fail("a track");
      point.track.push_back(observation);
    }
    if (!words->eof()) file.Fail("a track");
    model.points.push_back(std::move(point));
  }
}

}  // namespace

ColmapModel ReadColmapText(const std::filesystem::path& folder) {
  ColmapModel model;
  ReadCameras(TextFile(folder / "cameras.txt"), model);
  ReadImages(TextFile(folder / "images.txt"), model);
  std::error_code ignored;
  if (std::filesystem::exists(folder / "points3D.txt", ignored)) {
    ReadPoints(TextFile(folder / "points3D.txt"), model);
  }
  return model;
}

}  // namespace enfilade
