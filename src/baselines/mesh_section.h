// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "enfilade/geometry/polygon2.h"

namespace enfilade {

/// Triangles in the home frame, counter-clockwise seen from the inside of the home.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The inside of a closed mesh at the height z. Parts of less than `min_part_m2` and holes of less
/// than `min_hole_m2` are left out. Where the mesh is open, the section is closed by a straight
/// line. Cost O(triangles + s log s) for s that the height cuts.
[[nodiscard]] MultiPolygon2 LevelSection(const TriangleMesh& mesh, double z, double min_part_m2,
                                         double min_hole_m2);

}  // namespace enfilade
