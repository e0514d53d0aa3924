// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/surface_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace enfilade {

void Describe(const Eigen::Vector3d& normal, const std::vector<StoreyStructure>& storeys,
              ModelFace& face) {
  face.normal = normal;
  face.kind = SurfaceKind::kWall;
  if (std::abs(normal.z()) > 0.5 * std::numbers::sqrt2)
    face.kind = normal.z() > 0 ? SurfaceKind::kFloor : SurfaceKind::kCeiling;
  double z = 0;
  for (const Eigen::Vector3d& vertex : face.vertices)
    z += vertex.z() / static_cast<double>(face.vertices.size());
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < storeys.size(); ++i) {
    const double gap = std::max({storeys[i].floor_z - z, z - storeys[i].ceiling_z, 0.0});
    if (gap >= least) continue;
    least = gap;
    face.storey_idx = static_cast<int>(i);
  }
}

BuildingModel ModelOf(const TriangleMesh& mesh, const std::vector<StoreyStructure>& storeys) {
  BuildingModel model;
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    ModelFace face;
    for (const int vertex : triangle)
      face.vertices.push_back(mesh.vertices[static_cast<size_t>(vertex)]);
    face.triangles = {{0, 1, 2}};
    const Eigen::Vector3d across =
        (face.vertices[1] - face.vertices[0]).cross(face.vertices[2] - face.vertices[0]);
    if (!(across.norm() > 0)) continue;
    Describe(across.normalized(), storeys, face);
    model.faces.push_back(std::move(face));
  }
  return model;
}

}  // namespace enfilade
