// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

/// The truth about one picture, all in the truth's world frame.
struct TruthView {
  std::string picture;
  std::string sha256;  ///< empty when the file is absent: matched by name then
  int storey_idx = 0;
  std::optional<Rigid3> world_from_cam;
  bool is_inside = true;  ///< taken inside its own layout
  double camera_height_m = 0;
  /// What the picture shows of the walls: layout_visible, else layout_raw, else the room's outline.
  Ring2 visible_layout;
  /// Doors, windows and openings on it as pairs of points; windows count as wall.
  std::vector<std::array<Eigen::Vector2d, 2>> doors, openings;
  /// The truth about its pixels (pixel_truth.h), empty where there is none.
  std::filesystem::path labels_path, depth_path, normals_path;
};

struct TruthRoom {
  MultiPolygon2 region;  ///< inner wall faces
  int storey_idx = 0;
  std::optional<double> floor_z, ceiling_z;  ///< none where floor or ceiling is not level
  /// The first of the rooms that wide openings make one with this, as an index into
  /// GroundTruth::rooms; none if this is the first, or alone.
  std::optional<size_t> joined_to;
  MultiPolygon2 passages;  ///< the floor within those of these openings that stand with this room
};

/// What a result is judged against, whatever file it was read from.
struct GroundTruth {
  std::vector<TruthRoom> rooms;
  std::vector<std::array<Eigen::Vector2d, 2>> walls;  ///< faces, openings left out
  std::vector<std::array<Eigen::Vector2d, 2>> doors;  ///< doors within 0.4 m merged
  std::vector<TruthView> views;
};

}  // namespace enfilade
