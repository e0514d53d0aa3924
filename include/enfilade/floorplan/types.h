// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "enfilade/geometry/polygon2.h"
#include "enfilade/geometry/rigid3.h"

namespace enfilade {

enum class WallSeen { kSeen, kPartly, kInferred };
[[nodiscard]] std::span<const std::string_view> EnumNames(WallSeen);

/// One outline that a room may have: the best with its number of corners.
struct OutlineChoice {
  double cost_m = 0;  ///< without its corners, in metres of unseen wall; what it tells of depends
                      ///< on the method that made the curve
  Polygon2 polygon;
  std::vector<WallSeen> seen;   ///< of every edge, in ring order
  std::vector<double> sigma_m;  ///< likewise, standard deviation of the offset

  [[nodiscard]] int NumVertices() const;
};

/// A room: the region inside its walls' inner faces, in the home frame.
struct Room {
  int id = 0;
  Polygon2 polygon;
  double floor_z = 0;
  double ceiling_z = 0;
  double area_sigma_m2 = 0;
  bool has_level_ceiling = true;  ///< else ceiling_z is the ceiling's mean height
  /// The best outline for every number of corners, ascending; empty where nobody made one.
  std::vector<OutlineChoice> curve = {};
};

/// A wall face from a to b, the room on its left.
struct Wall {
  int id = 0;
  Eigen::Vector2d a, b;
  int room_id = 0;                   ///< on the left of a → b
  std::optional<int> other_room_id;  ///< behind it
  double thickness_m = 0;
  bool is_thickness_measured = false;
  WallSeen seen = WallSeen::kSeen;
  double sigma_m = 0;         ///< standard deviation of its offset
  double length_sigma_m = 0;  ///< of its length, from those of the walls beside it; 0: unknown
};

enum class OpeningKind { kDoor, kOpening, kWindow };
[[nodiscard]] std::span<const std::string_view> EnumNames(OpeningKind);

struct Opening {
  int id = 0;
  OpeningKind kind = OpeningKind::kDoor;
  int wall_id = 0;
  Eigen::Vector2d a, b;
  double sill_z = 0;
  double head_z = 0;
  int room_id = 0;
  std::optional<int> other_room_id;
};

struct Storey {
  int id = 0;
  double floor_z = 0;
  std::vector<Room> rooms;
  std::vector<Wall> walls;
  std::vector<Opening> openings;
};

/// Where a picture was taken.
struct PlanCamera {
  std::string picture;
  std::string sha256;
  int storey_idx = 0;
  int component_idx = 0;
  bool is_inferred = false;
  Rigid3 world_from_cam;
};

/// How the dial for the number of corners stands.
struct VertexDial {
  int num_vertices = 0;  ///< of all rooms with a curve together
  double cost_m = 0;     ///< of the outlines chosen, together
  double bound_m = 0;    ///< no choice of outlines with so many corners costs less
  int num_openings_dropped = 0;
};

/// The measured plan: lengths in metres, polygons in the home frame.
struct Floorplan {
  Rigid3 home_from_world;
  std::vector<Storey> storeys;
  std::vector<PlanCamera> cameras;
  std::optional<VertexDial> dial;  ///< where it was turned
  /// The storeys as they were drawn, without curves; empty where `storeys` are as drawn.
  std::vector<Storey> drawn_storeys = {};
};

}  // namespace enfilade
