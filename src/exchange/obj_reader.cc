// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/obj_reader.h"

#include <Eigen/Geometry>
#include <map>
#include <regex>
#include <string>

#include "enfilade/base/errors.h"
#include "src/exchange/obj_mesh.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr size_t kMaxName = 100;

// The inverse of the group names of WriteObj.
ModelFace FaceOfGroup(const std::string& name, const std::string& where) {
  static const std::regex kName(
      R"(storey_(\d{1,6})/room_(-?\d{1,9})/(?:(floor)|(ceiling)|wall_(\d{1,9})|wall_f\d+))");
  std::smatch parts;
  if (name.size() > kMaxName || !std::regex_match(name, parts, kName)) {
    throw InvalidInputError(where, "has a face outside the groups of a model",
                            "give a model.obj of this program");
  }
  ModelFace face;
  face.kind = parts[3].matched   ? SurfaceKind::kFloor
              : parts[4].matched ? SurfaceKind::kCeiling
                                 : SurfaceKind::kWall;
  face.storey_idx = std::stoi(parts[1]);
  face.room_id = std::stoi(parts[2]);
  if (parts[5].matched) face.wall_id = std::stoi(parts[5]);
  return face;
}

// The direction of the sum of the triangles' areas.
Vector3d NormalOf(const ModelFace& face, const std::string& where) {
  Vector3d sum = Vector3d::Zero();
  for (const std::array<int, 3>& triangle : face.triangles) {
    const auto corner = [&](size_t k) { return face.vertices[static_cast<size_t>(triangle[k])]; };
    sum += (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
  if (sum.norm() == 0) {
    throw InvalidInputError(where, "has a face without area", "make the model anew");
  }
  return sum.normalized();
}

}  // namespace

BuildingModel ReadObj(const std::filesystem::path& path) {
  const ObjMesh mesh = ReadObjMesh(path);
  BuildingModel model;
  int group_idx = -2;
  std::map<int, int> vertex_of_corner;
  for (const ObjTriangle& triangle : mesh.triangles) {
    if (triangle.group_idx != group_idx) {
      group_idx = triangle.group_idx;
      const std::string name =
          group_idx >= 0 ? mesh.groups[static_cast<size_t>(group_idx)] : std::string();
      model.faces.push_back(FaceOfGroup(name, path.native()));
      vertex_of_corner.clear();
    }
    ModelFace& face = model.faces.back();
    std::array<int, 3> corners{};
    for (size_t k = 0; k < 3; ++k) {
      const auto [entry, is_new] =
          vertex_of_corner.try_emplace(triangle.corners[k], static_cast<int>(face.vertices.size()));
      if (is_new) face.vertices.push_back(mesh.vertices[static_cast<size_t>(triangle.corners[k])]);
      corners[k] = entry->second;
    }
    face.triangles.push_back(corners);
  }
  for (ModelFace& face : model.faces) face.normal = NormalOf(face, path.native());
  return model;
}

}  // namespace enfilade
