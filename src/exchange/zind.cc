// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/zind.h"

#include <fmt/format.h>
#include <cmath>
#include <optional>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"
#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "src/exchange/json_geometry.h"
#include "src/exchange/pose_file.h"

namespace enfilade {
namespace {

using Json = nlohmann::json;

constexpr int kMaxGroupDepth = 8;

ZindPanorama ReadPanorama(const Json& object, int floor_idx, const std::string& group,
                          const std::string& where) {
  ZindPanorama panorama;
  panorama.image_path = JsonString(object, "image_path", where);
  panorama.floor_idx = floor_idx;
  panorama.group = group;
  panorama.annotation = &object;
  const std::string what = "floor_plan_transformation of '" + panorama.image_path + "'";
  const Json& transformation = JsonObject(object, "floor_plan_transformation", where);
  panorama.scale = JsonNumber(transformation, "scale", where);
  panorama.rotation_rad = DegToRad(JsonNumber(transformation, "rotation", where));
  panorama.translation =
      Vector2FromJson(JsonArray(transformation, "translation", where), where, what);
  if (object.contains("camera_height")) {
    panorama.camera_height = JsonNumber(object, "camera_height", where);
  }
  if (!(panorama.scale > 0) || !(panorama.camera_height > 0)) {
    throw InvalidInputError(where, what + " has a scale or camera height that is not positive",
                            "correct it or take the panorama out");
  }
  return panorama;
}

// Finds the panoramas below a floor, whatever groups they are in.
struct PanoramaCollector {
  const std::string& where;
  int floor_idx;
  std::vector<ZindPanorama>& panoramas;
  int num_unplaced = 0;

  void Collect(const Json& object, const std::string& group, int depth) {
    if (!object.is_object()) return;
    if (object.contains("image_path")) {
      const auto transformation = object.find("floor_plan_transformation");
      if (transformation == object.end() || transformation->is_null()) {
        ++num_unplaced;
      } else {
        panoramas.push_back(ReadPanorama(object, floor_idx, group, where));
      }
      return;
    }
    if (depth == kMaxGroupDepth) return;
    for (const auto& [key, value] : object.items()) {
      Collect(value, depth == 0 ? key : group, depth + 1);
    }
  }
};

std::optional<double> FileScale(const Json& file, const std::string& floor,
                                const std::string& where) {
  const auto scales = file.find("scale_meters_per_coordinate");
  if (scales == file.end() || !scales->is_object()) return std::nullopt;
  const auto scale = scales->find(floor);
  if (scale == scales->end() || scale->is_null()) return std::nullopt;
  const double value =
      NumberFromJson(*scale, where, "scale_meters_per_coordinate of '" + floor + "'");
  if (!(value > 0)) {
    throw InvalidInputError(where, "scale_meters_per_coordinate of '" + floor + "' is not positive",
                            "make it null if it is unknown");
  }
  return value;
}

// Camera heights of one floor in floor coordinates.
double MedianHeight(const ZindTour& tour, int floor_idx) {
  std::vector<double> heights;
  for (const ZindPanorama& panorama : tour.panoramas) {
    if (panorama.floor_idx == floor_idx) heights.push_back(panorama.scale * panorama.camera_height);
  }
  return UpperMedian(heights);
}

// Fills m_per_coordinate of every floor and says where it came from.
void FindScales(ZindTour& tour, double camera_height_m, const std::string& where) {
  std::vector<int> unknown;
  std::vector<double> known_heights_m;
  for (int i = 0; i < static_cast<int>(tour.floors.size()); ++i) {
    ZindFloor& floor = tour.floors[static_cast<size_t>(i)];
    const std::optional<double> scale = FileScale(tour.json, floor.key, where);
    if (scale) {
      floor.m_per_coordinate = *scale;
      known_heights_m.push_back(*scale * MedianHeight(tour, i));
    } else {
      unknown.push_back(i);
    }
  }
  if (unknown.empty()) return;
  double height_m = kAssumedCameraHeight_m;
  std::string source = fmt::format("assumed {} m above the floor; give --camera-height", height_m);
  tour.scale_source = ScaleSource::kAssumed;
  if (camera_height_m > 0) {
    height_m = camera_height_m;
    source = fmt::format("{} m above the floor, as given", height_m);
    tour.scale_source = ScaleSource::kCameraHeight;
  } else if (!known_heights_m.empty()) {
    height_m = UpperMedian(known_heights_m);
    source = fmt::format("{:.3f} m above the floor, as on the floors with a scale", height_m);
    tour.scale_source = ScaleSource::kPoses;
  }
  for (const int i : unknown) {
    ZindFloor& floor = tour.floors[static_cast<size_t>(i)];
    floor.m_per_coordinate = height_m / MedianHeight(tour, i);
    tour.warnings.push_back(
        fmt::format("{}: the scale of {} is unknown; its cameras are taken as {}",
                    PrintablePath(where), floor.key, source));
  }
}

}  // namespace

double ZindTour::MetresPerLocal(const ZindPanorama& panorama) const {
  return floors[static_cast<size_t>(panorama.floor_idx)].m_per_coordinate * panorama.scale;
}

Eigen::Vector2d ZindTour::WorldFromLocal(const ZindPanorama& panorama,
                                         const Eigen::Vector2d& local) const {
  const double c = std::cos(panorama.rotation_rad), s = std::sin(panorama.rotation_rad);
  const Eigen::Vector2d rotated(c * local.x() - s * local.y(), s * local.x() + c * local.y());
  const Eigen::Vector2d g = panorama.scale * rotated + panorama.translation;
  const double m = floors[static_cast<size_t>(panorama.floor_idx)].m_per_coordinate;
  return {m * g.x(), -m * g.y()};
}

Rigid3 ZindTour::WorldFromCam(const ZindPanorama& panorama) const {
  // Forward is local +y and right local −x: the image runs to the right as atan2(−x, y) grows.
  const double c = std::cos(panorama.rotation_rad), s = std::sin(panorama.rotation_rad);
  Rigid3 world_from_cam;
  world_from_cam.rotation.col(0) = Eigen::Vector3d(-c, s, 0);
  world_from_cam.rotation.col(1) = Eigen::Vector3d(0, 0, -1);
  world_from_cam.rotation.col(2) = Eigen::Vector3d(-s, -c, 0);
  const double z = floors[static_cast<size_t>(panorama.floor_idx)].floor_z +
                   MetresPerLocal(panorama) * panorama.camera_height;
  world_from_cam.translation << WorldFromLocal(panorama, {0, 0}), z;
  return world_from_cam;
}

ZindTour ReadZindTour(const std::filesystem::path& path, double camera_height_m) {
  const std::string& where = path.native();
  ZindTour tour;
  tour.json = ReadJsonFile(path);
  int num_unplaced = 0;
  for (const auto& [key, floor] : JsonObject(tour.json, "merger", where).items()) {
    const size_t num_before = tour.panoramas.size();
    const int floor_idx = static_cast<int>(tour.floors.size());
    PanoramaCollector collector{where, floor_idx, tour.panoramas};
    collector.Collect(floor, "", 0);
    num_unplaced += collector.num_unplaced;
    if (tour.panoramas.size() == num_before) continue;
    tour.floors.push_back({key, 0, kZindStoreyHeight_m * floor_idx});
  }
  if (tour.panoramas.empty()) {
    throw InvalidInputError(where, "has no panorama with a position under 'merger'",
                            "give a whole tour of the Zillow Indoor Dataset");
  }
  if (num_unplaced > 0) {
    tour.warnings.push_back(fmt::format("{}: {} panoramas have no position and are left out",
                                        PrintablePath(path), num_unplaced));
  }
  FindScales(tour, camera_height_m, where);
  std::vector<double> heights_m;
  for (const ZindPanorama& panorama : tour.panoramas) {
    heights_m.push_back(tour.MetresPerLocal(panorama) * panorama.camera_height);
  }
  tour.camera_height_m = UpperMedian(heights_m);
  return tour;
}

PoseFile ReadZindPoses(const std::filesystem::path& path, double camera_height_m) {
  ZindTour tour = ReadZindTour(path, camera_height_m);
  PoseFile poses;
  poses.path = path;
  poses.base = path.parent_path();
  poses.source = PoseSource::kZind;
  poses.scale_source = tour.scale_source;
  poses.camera_height_m = tour.camera_height_m;
  for (const ZindPanorama& panorama : tour.panoramas) {
    PosedPicture picture;
    picture.name = panorama.image_path;
    picture.world_from_cam = tour.WorldFromCam(panorama);
    picture.storey_idx = panorama.floor_idx;
    poses.pictures.push_back(std::move(picture));
  }
  poses.warnings = std::move(tour.warnings);
  return poses;
}

}  // namespace enfilade
