// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/baselines/mesh_section.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace enfilade {
namespace {

using Eigen::Vector3d;

// A box between two corners, its triangles seen from inside or, as a pillar is, from outside.
void AddBox(const Vector3d& low, const Vector3d& high, bool is_seen_inside, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                               (k & 4) != 0 ? high.z() : low.z());
  }
  // Four corners of each side, counter-clockwise seen from inside.
  constexpr int kSides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4},
                                {1, 5, 7, 3}, {0, 4, 5, 1}, {2, 3, 7, 6}};
  for (const auto& side : kSides) {
    for (const std::array<int, 3>& t :
         {std::array{side[0], side[1], side[2]}, std::array{side[0], side[2], side[3]}}) {
      mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      if (!is_seen_inside) std::swap(mesh.triangles.back()[1], mesh.triangles.back()[2]);
    }
  }
}

TEST(LevelSection, CutsRoomsPillarsAndWhatIsInThem) {
  TriangleMesh mesh;
  AddBox({0, 0, 0}, {6, 5, 2.5}, true, mesh);
  AddBox({1, 1, 0.5}, {4, 4, 2}, false, mesh);
  AddBox({2, 2, 1}, {3, 3, 1.5}, true, mesh);
  EXPECT_NEAR(Area(LevelSection(mesh, 1.2, 0.25, 0.25)), 30 - 9 + 1, 1e-9);
  EXPECT_NEAR(Area(LevelSection(mesh, 1.2, 2, 0.25)), 30 - 9, 1e-9);
  EXPECT_NEAR(Area(LevelSection(mesh, 1.2, 2, 10)), 30, 1e-9);
  EXPECT_NEAR(Area(LevelSection(mesh, 0.7, 0.25, 0.25)), 30 - 9, 1e-9);
  // At the height of vertices as well.
  EXPECT_NEAR(Area(LevelSection(mesh, 1, 0.25, 0.25)), 30 - 9, 1e-9);
  EXPECT_TRUE(LevelSection(mesh, 3, 0.25, 0.25).empty());
}

}  // namespace
}  // namespace enfilade
