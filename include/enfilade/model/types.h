// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "enfilade/image/image.h"

namespace enfilade {

enum class SurfaceKind { kFloor, kCeiling, kWall };

/// One planar face: triangles over its own vertices, seen from the side that its normal points to
/// (into the room), with a place in a texture.
struct ModelFace {
  SurfaceKind kind = SurfaceKind::kWall;
  int storey_idx = 0;
  int room_id = 0;
  int wall_id = -1;  ///< −1 for floors, ceilings and walls that the plan does not list
  Eigen::Vector3d normal{0, 0, 1};
  std::vector<Eigen::Vector3d> vertices;      ///< home frame, metres
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the room
  std::vector<Eigen::Vector2d> uv;            ///< one a vertex; (0, 0) is the texture's top left
  int texture_idx = 0;                        ///< used where `uv` is not empty
};

/// The extruded home. The faces of a room form a closed surface: every edge is shared by two.
struct BuildingModel {
  std::vector<ModelFace> faces;
  std::vector<ImageU8> textures;  ///< RGB
};

}  // namespace enfilade
