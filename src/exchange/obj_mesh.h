// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace enfilade {

struct ObjTriangle {
  std::array<int, 3> corners{};  ///< indices into the vertices
  int group_idx = -1;            ///< the group it stands in, −1 before the first
};

/// Positions, triangles and groups of a Wavefront OBJ file; all else in it is passed over.
struct ObjMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<ObjTriangle> triangles;  ///< faces as fans
  std::vector<std::string> groups;     ///< the names on its g lines, in their order
};

/// Throws IoError, and InvalidInputError with the line at fault or when there is no face.
[[nodiscard]] ObjMesh ReadObjMesh(const std::filesystem::path& path);

}  // namespace enfilade
