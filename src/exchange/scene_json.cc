// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/scene_json.h"

#include <fmt/format.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"
#include "src/exchange/json_geometry.h"
#include "src/exchange/relative_path.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr char kFormat[] = "enfilade-scene";
constexpr int kVersion = 1;

// Paths are bytes, JSON strings are UTF-8: '%' and, in names that are no UTF-8, every byte above
// ASCII stand as %NN.
std::string PathToText(const fs::path& path) {
  const bool is_utf8 = IsValidUtf8(path.native());
  std::string text;
  for (const char c : path.native()) {
    const auto byte = static_cast<uint8_t>(c);
    if (c == '%' || (byte >= 0x80 && !is_utf8)) {
      text += fmt::format("%{:02X}", byte);
    } else {
      text += c;
    }
  }
  return text;
}

int HexDigit(char c) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  const size_t digit = kDigits.find(c);
  return digit == std::string_view::npos ? -1 : static_cast<int>(digit);
}

fs::path PathFromText(const std::string& text, const std::string& where) {
  std::string bytes;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      bytes += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? HexDigit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? HexDigit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      throw InvalidInputError(where, "the path '" + text + "' has a '%' without two digits",
                              "make the file again");
    }
    bytes += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return bytes;
}

Json CameraToJson(const Camera& camera) {
  Json json{{"width", camera.width}, {"height", camera.height}};
  if (camera.model == CameraModel::kEquirectangular) {
    json["model"] = "equirectangular";
  } else {
    json["model"] = "pinhole";
    json["fx_fy_cx_cy"] = {camera.fx, camera.fy, camera.cx, camera.cy};
  }
  return json;
}

Camera CameraFromJson(const Json& json, const std::string& where) {
  const int64_t width = JsonInteger(json, "width", where);
  const int64_t height = JsonInteger(json, "height", where);
  const std::string model = JsonString(json, "model", where);
  if (width <= 0 || height <= 0 || width > INT32_MAX || height > INT32_MAX) {
    throw InvalidInputError(where, "a camera has no sensible size", "make the file again");
  }
  const int w = static_cast<int>(width), h = static_cast<int>(height);
  if (model == "equirectangular") return EquirectangularCamera(w, h);
  const Json& values = JsonArray(json, "fx_fy_cx_cy", where);
  if (model != "pinhole" || values.size() != 4) {
    throw InvalidInputError(where, "a camera is neither equirectangular nor pinhole",
                            "make the file again");
  }
  const auto value = [&](size_t i) { return NumberFromJson(values[i], where, "a camera"); };
  if (!(value(0) > 0 && value(1) > 0)) {
    throw InvalidInputError(where, "a camera has no focal length", "make the file again");
  }
  return PinholeCamera(w, h, value(0), value(1), value(2), value(3));
}

Json MatrixToJson(const Rigid3& transform) {
  const Eigen::Matrix4d matrix = transform.Matrix();
  Json rows = Json::array();
  for (int i = 0; i < 16; ++i) rows.push_back(matrix(i / 4, i % 4));
  return rows;
}

// The exact numbers; Rigid3FromJson, which checks them, also makes the rotation orthonormal anew.
Rigid3 MatrixFromJson(const Json& json, const std::string& where) {
  Rigid3 transform = Rigid3FromJson(json, where, "world_from_cam");
  if (json.size() != 16) {
    throw InvalidInputError(where, "world_from_cam is not 16 numbers", "make the file again");
  }
  for (int row = 0; row < 3; ++row) {
    for (int col = 0; col < 3; ++col) {
      transform.rotation(row, col) = json[static_cast<size_t>(4 * row + col)].get<double>();
    }
  }
  return transform;
}

Json ViewToJson(const View& view, const fs::path& folder) {
  return {{"picture", view.picture},
          {"path", PathToText(RelativePath(view.path, folder))},
          {"sha256", view.sha256},
          {"camera", CameraToJson(view.camera)},
          {"world_from_cam", MatrixToJson(view.world_from_cam)},
          {"storey", view.storey_idx},
          {"component", view.component_idx},
          {"inferred", view.is_pose_inferred},
          {"mask", PathToText(RelativePath(view.mask_path, folder))}};
}

int IndexFromJson(const Json& json, const char* key, const std::string& where) {
  const int64_t value = JsonInteger(json, key, where);
  if (value < 0 || value > INT32_MAX) {
    throw InvalidInputError(where, std::string("key '") + key + "' is out of range",
                            "make the file again");
  }
  return static_cast<int>(value);
}

fs::path PathFromJson(const Json& json, const char* key, const fs::path& folder,
                      const std::string& where) {
  const fs::path path = PathFromText(JsonString(json, key, where), where);
  return path.empty() ? path : (folder / path).lexically_normal();
}

View ViewFromJson(const Json& json, const fs::path& folder, const std::string& where) {
  View view;
  view.picture = JsonString(json, "picture", where);
  view.path = PathFromJson(json, "path", folder, where);
  view.sha256 = JsonString(json, "sha256", where);
  view.camera = CameraFromJson(JsonObject(json, "camera", where), where);
  view.world_from_cam = MatrixFromJson(JsonArray(json, "world_from_cam", where), where);
  view.storey_idx = IndexFromJson(json, "storey", where);
  view.component_idx = IndexFromJson(json, "component", where);
  view.is_pose_inferred = json.contains("inferred") && json["inferred"] == Json(true);
  view.mask_path = PathFromJson(json, "mask", folder, where);
  return view;
}

Json PointToJson(const ScenePoint& point) {
  const auto triple = [](const auto& v) { return Json{v[0], v[1], v[2]}; };
  Json json{{"xyz", triple(point.position)},
            {"normal", triple(point.normal)},
            {"rgb", triple(point.rgb)},
            {"views", point.view_idx}};
  for (const Eigen::Vector2f& pixel : point.pixels) {
    for (const float coordinate : pixel) json["pixels"].push_back(coordinate);
  }
  return json;
}

// x and y of one pixel a view, one after the other.
std::vector<Eigen::Vector2f> PixelsFromJson(const Json& json, size_t num_views,
                                            const std::string& where) {
  if (json.size() != 2 * num_views) {
    throw InvalidInputError(where, "a point has not as many pixels as views",
                            "make the file again");
  }
  std::vector<Eigen::Vector2f> pixels;
  for (size_t k = 0; k < json.size(); k += 2) {
    const Eigen::Vector2d pixel(NumberFromJson(json[k], where, "a pixel"),
                                NumberFromJson(json[k + 1], where, "a pixel"));
    if (pixel.cwiseAbs().maxCoeff() > std::numeric_limits<float>::max()) {
      throw InvalidInputError(where, "a pixel is out of range", "make the file again");
    }
    pixels.push_back(pixel.cast<float>());
  }
  return pixels;
}

ScenePoint PointFromJson(const Json& json, size_t num_views, const std::string& where) {
  ScenePoint point;
  point.position = Vector3FromJson(JsonArray(json, "xyz", where), where, "a point");
  point.normal = Vector3FromJson(JsonArray(json, "normal", where), where, "a normal");
  const Eigen::Vector3d rgb = Vector3FromJson(JsonArray(json, "rgb", where), where, "a colour");
  if (rgb.minCoeff() < 0 || rgb.maxCoeff() > 255) {
    throw InvalidInputError(where, "a colour is out of range", "make the file again");
  }
  point.rgb = rgb.cast<uint8_t>();
  for (const Json& view : JsonArray(json, "views", where)) {
    const double idx = NumberFromJson(view, where, "a point's view");
    if (idx < 0 || idx >= static_cast<double>(num_views)) {
      throw InvalidInputError(where, "a point is seen by a view that is not there",
                              "make the file again");
    }
    point.view_idx.push_back(static_cast<int>(idx));
  }
  if (json.contains("pixels")) {
    point.pixels = PixelsFromJson(JsonArray(json, "pixels", where), point.view_idx.size(), where);
  }
  return point;
}

}  // namespace

void WriteSceneJson(const fs::path& path, const Scene& scene) {
  const fs::path folder = path.parent_path();
  Json views = Json::array(), points = Json::array();
  for (const View& view : scene.views) views.push_back(ViewToJson(view, folder));
  for (const ScenePoint& point : scene.points) points.push_back(PointToJson(point));
  WriteJsonFile(path,
                {{"format", kFormat},
                 {"version", kVersion},
                 {"pose_source", EnumToName(scene.pose_source)},
                 {"scale_source", EnumToName(scene.scale_source)},
                 {"camera_height_m", scene.camera_height_m ? Json(*scene.camera_height_m) : Json()},
                 {"views", std::move(views)},
                 {"points", std::move(points)}});
}

Scene ReadSceneJson(const fs::path& path) {
  const std::string& where = path.native();
  const Json json = ReadJsonFile(path);
  if (JsonString(json, "format", where) != kFormat ||
      JsonInteger(json, "version", where) != kVersion) {
    throw InvalidInputError(where, "is no scene of this version of the program",
                            "make the file again");
  }
  Scene scene;
  scene.pose_source =
      EnumFromName<PoseSource>(JsonString(json, "pose_source", where), where, "pose_source");
  scene.scale_source =
      EnumFromName<ScaleSource>(JsonString(json, "scale_source", where), where, "scale_source");
  if (json.contains("camera_height_m") && !json["camera_height_m"].is_null()) {
    scene.camera_height_m = JsonNumber(json, "camera_height_m", where);
  }
  for (const Json& view : JsonArray(json, "views", where)) {
    scene.views.push_back(ViewFromJson(view, path.parent_path(), where));
  }
  for (const Json& point : JsonArray(json, "points", where)) {
    scene.points.push_back(PointFromJson(point, scene.views.size(), where));
  }
  return scene;
}

}  // namespace enfilade
