// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/pose_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "enfilade/base/errors.h"
#include "enfilade/base/json.h"

namespace enfilade {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr double kMaxExtent_m = 10000;
// A world whose cameras stand upright is never turned; phones and 360° cameras on sticks tilt less.
constexpr double kMaxMeanTilt_deg = 45;
// Files whose up is another axis of theirs: the cameras' mean up differs from it by their tilt
// only.
constexpr double kAxisTolerance_deg = 20;

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool IsFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

PoseFile ReadFormat(const PoseLocation& location, double camera_height_m) {
  switch (location.source) {
    case PoseSource::kTransforms:
      return ReadTransforms(location.path);
    case PoseSource::kColmap:
      return ReadColmapModel(location.path);
    case PoseSource::kCsv:
      return ReadPoseCsv(location.path);
    default:
      return ReadZindPoses(location.path, camera_height_m);
  }
}

void CheckNames(const PoseFile& poses) {
  std::set<std::string> names;
  for (const PosedPicture& picture : poses.pictures) {
    if (!names.insert(picture.name).second) {
      throw InvalidInputError(poses.path.native(), "names '" + picture.name + "' twice",
                              "keep one pose a picture");
    }
  }
}

void CheckPositions(const PoseFile& poses) {
  const Vector3d first = poses.pictures.front().world_from_cam.translation;
  for (const PosedPicture& picture : poses.pictures) {
    const Vector3d position = picture.world_from_cam.translation;
    if (!((position - first).norm() <= kMaxExtent_m)) {
      throw InvalidInputError(poses.path.native(),
                              "the position of '" + picture.name +
                                  "' is more than 10 km from that of '" +
                                  poses.pictures.front().name + "'",
                              "check it and its unit, lengths are metres");
    }
  }
}

// Distances from the floor to the cameras that see it, one a point below its cameras.
std::vector<double> DistancesBelowCameras(const PoseFile& poses) {
  std::vector<double> distances;
  for (const ScenePoint& point : poses.points) {
    double camera_z = 0;
    for (const int i : point.view_idx) {
      camera_z += poses.pictures[static_cast<size_t>(i)].world_from_cam.translation.z();
    }
    if (point.view_idx.empty()) continue;
    const double distance =
        camera_z / static_cast<double>(point.view_idx.size()) - point.position.z();
    if (distance > 0) distances.push_back(distance);
  }
  std::sort(distances.begin(), distances.end());
  return distances;
}

// The floor is the densest level below the cameras: the window [d, 1.1 d] with the most points.
std::optional<double> CameraHeightFromPoints(const PoseFile& poses) {
  constexpr double kWindow = 1.1;
  constexpr size_t kMinPoints = 30;
  const std::vector<double> distances = DistancesBelowCameras(poses);
  size_t best_begin = 0, best_size = 0;
  for (size_t begin = 0, end = 0; begin < distances.size(); ++begin) {
    while (end < distances.size() && distances[end] <= kWindow * distances[begin]) ++end;
    if (end - begin > best_size) {
      best_begin = begin;
      best_size = end - begin;
    }
  }
  if (best_size < kMinPoints) return std::nullopt;
  return distances[best_begin + best_size / 2];
}

void Scale(PoseFile& poses, double factor) {
  for (PosedPicture& picture : poses.pictures) picture.world_from_cam.translation *= factor;
  for (ScenePoint& point : poses.points) point.position *= factor;
}

}  // namespace

bool HasColmapModel(const fs::path& folder) {
  for (const char* extension : {".bin", ".txt"}) {
    const auto has = [&](const char* stem) {
      return Exists(folder / (std::string(stem) + extension));
    };
    if (has("cameras") && has("images")) return true;
  }
  return false;
}

std::optional<PoseLocation> FindPoses(const fs::path& folder) {
  if (Exists(folder / "transforms.json")) {
    return PoseLocation{PoseSource::kTransforms, folder / "transforms.json"};
  }
  for (const fs::path& model : {folder, folder / "sparse", folder / "sparse" / "0"}) {
    if (HasColmapModel(model)) return PoseLocation{PoseSource::kColmap, model};
  }
  if (Exists(folder / "poses.csv")) return PoseLocation{PoseSource::kCsv, folder / "poses.csv"};
  if (Exists(folder / "zind_data.json")) {
    return PoseLocation{PoseSource::kZind, folder / "zind_data.json"};
  }
  return std::nullopt;
}

PoseLocation LocatePoses(const fs::path& path) {
  if (!Exists(path)) {
    throw IoError(path.native(), "does not exist", "check the path given with --poses");
  }
  if (IsFolder(path)) {
    if (HasColmapModel(path)) return {PoseSource::kColmap, path};
    throw InvalidInputError(path.native(),
                            "holds no COLMAP model (cameras and images, .bin or .txt)",
                            "name the folder of the model or a pose file");
  }
  if (path.extension() == ".csv") return {PoseSource::kCsv, path};
  if (path.extension() == ".json") {
    const nlohmann::json file = ReadJsonFile(path);
    if (file.contains("frames")) return {PoseSource::kTransforms, path};
    if (file.contains("merger")) return {PoseSource::kZind, path};
  } else if (HasColmapModel(path.parent_path())) {
    return {PoseSource::kColmap, path.parent_path()};
  }
  throw InvalidInputError(path.native(), "is no known pose file",
                          "give transforms.json, a COLMAP model, poses.csv or zind_data.json");
}

PoseFile ReadPoseFile(const PoseLocation& location, double camera_height_m) {
  PoseFile poses = ReadFormat(location, camera_height_m);
  if (poses.pictures.empty()) {
    throw InvalidInputError(location.path.native(), "has no poses", "give at least one");
  }
  CheckNames(poses);
  if (poses.source == PoseSource::kColmap) ScaleToMetres(poses, camera_height_m);
  CheckPositions(poses);
  return poses;
}

void TurnUpright(PoseFile& poses) {
  Vector3d up = Vector3d::Zero();
  for (const PosedPicture& picture : poses.pictures) up -= picture.world_from_cam.rotation.col(1);
  const double cos_tilt = up.normalized().z();
  if (up.norm() < 1e-9 || cos_tilt >= std::cos(kMaxMeanTilt_deg * M_PI / 180)) return;
  up.normalize();
  Eigen::Index axis = 0;
  if (up.cwiseAbs().maxCoeff(&axis) > std::cos(kAxisTolerance_deg * M_PI / 180)) {
    up = Vector3d::Unit(axis) * (up[axis] > 0 ? 1.0 : -1.0);
  }
  const Rigid3 turn{Eigen::Quaterniond::FromTwoVectors(up, Vector3d::UnitZ()).toRotationMatrix(),
                    Vector3d::Zero()};
  for (PosedPicture& picture : poses.pictures)
    picture.world_from_cam = turn * picture.world_from_cam;
  for (ScenePoint& point : poses.points) {
    point.position = turn * point.position;
    point.normal = turn.rotation * point.normal;
  }
  poses.warnings.push_back(
      fmt::format("{}: the cameras' up is ({:.2f}, {:.2f}, {:.2f}), not z; the world is turned so "
                  "that it is z",
                  PrintablePath(poses.path), up.x(), up.y(), up.z()));
}

void ScaleToMetres(PoseFile& poses, double camera_height_m) {
  poses.scale_source = ScaleSource::kAssumed;
  const std::string where = PrintablePath(poses.path);
  if (!(camera_height_m > 0)) {
    poses.warnings.push_back(where +
                             ": these poses have no unit, metres are assumed; give "
                             "--camera-height to set the scale");
    return;
  }
  const std::optional<double> height = CameraHeightFromPoints(poses);
  if (!height) {
    poses.warnings.push_back(where +
                             ": too few points show the floor to set the scale from the "
                             "camera height; metres are assumed");
    return;
  }
  Scale(poses, camera_height_m / *height);
  poses.scale_source = ScaleSource::kCameraHeight;
  poses.warnings.push_back(fmt::format(
      "{}: lengths are scaled by {:.6g} so that the cameras stand {:g} m above the floor", where,
      camera_height_m / *height, camera_height_m));
}

}  // namespace enfilade
