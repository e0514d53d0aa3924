// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/doubtful_walls.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/boolean.h"
#include "src/floorplan/box_index.h"
#include "src/floorplan/sound_polygon.h"
#include "src/floorplan/tidy_room.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// Probabilities that a wall's line is another surface's, between which the choice changes little.
constexpr double kDoubtful = 0.25, kSure = 0.2;
constexpr double kDeepest_m = 0.72;  // wardrobes, and what their lines are off by
constexpr double kAside_m = 0.5;     // along the walls, between the two
constexpr double kShortest_m = 0.3;
// Within a room short walls stand beside bays more often than behind furniture.
constexpr double kShortestOfOwn_m = 0.6;
constexpr double kMinSure_m = 0.5;
constexpr double kParallel = 0.9995;  // cosine: 2°

// What must be known of the space behind a wall that is moved farther than its line may be off:
// cells just behind a face are solid for those who saw it, and unknown farther on.
constexpr double kLineError_m = 0.25, kFaceDepth_m = 0.2;
constexpr float kMinFreeness = 0.01F;

constexpr double kOverlap_m = 0.005;     // of what is added and its room, so that they join
constexpr double kMaxOwnPart_m2 = 0.01;  // of its room behind a wall
struct Face {
  explicit Face(const Wall& wall)
      : length_m((wall.b - wall.a).norm()),
        along((wall.b - wall.a) / length_m),
        outward(along.y(), -along.x()) {}
  double length_m = 0;
  Vector2d along, outward;
};

// How far the line of a sure wall lies behind a doubtful one that may go on along it.
std::optional<double> DepthOf(const Wall& sure, const Wall& doubtful, double min_jog_m) {
  const Face face(doubtful), other(sure);
  if (other.length_m < kMinSure_m || face.along.dot(other.along) < kParallel) return std::nullopt;
  const bool is_own = sure.room_id == doubtful.room_id;
  if (is_own && (face.length_m < kShortestOfOwn_m || doubtful.seen == WallSeen::kInferred))
    return std::nullopt;
  const double depth_m = face.outward.dot(0.5 * (sure.a + sure.b) - doubtful.a);
  const double aside_m =
      std::max(face.along.dot(sure.a - doubtful.b), face.along.dot(doubtful.a - sure.b));
  if (depth_m < min_jog_m || depth_m > kDeepest_m || aside_m > kAside_m) return std::nullopt;
  return depth_m;
}

// Mean freeness of the space behind a wall, without what lies next to its face and to depth_m.
float FreenessBehind(const LoopField& field, const Wall& wall, double depth_m) {
  const Face face(wall);
  const double step_m = field.frame.cell_m;
  const auto num_along = static_cast<int>(std::ceil(0.8 * face.length_m / step_m));
  const auto num_deep = static_cast<int>(std::ceil((depth_m - kFaceDepth_m) / step_m)) - 2;
  double sum = 0;
  int count = 0;
  for (int i = 0; i < num_along; ++i) {
    for (int k = 0; k < num_deep; ++k) {
      const Vector2d p = wall.a + (0.1 * face.length_m + i * step_m) * face.along +
                         (kFaceDepth_m + k * step_m) * face.outward;
      const int row = field.frame.Row(p.y()), col = field.frame.Col(p.x());
      if (field.frame.IsInside(row, col)) sum += field.freeness(row, col);
      ++count;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

// Whether another room lies within half a wall's thickness of the space behind a wall, or its own
// room goes on there: the wall parts it.
bool IsTaken(const Polygon2& space, size_t own, double thickness_m,
             const std::vector<Polygon2>& polygons) {
  if (Area(Intersection({polygons[own]}, {space})) > kMaxOwnPart_m2) return true;
  const MultiPolygon2 reach = OffsetSharp({space}, 0.5 * thickness_m);
  const Box2 box = Grown(BoxOf(space.outer), thickness_m);
  for (size_t i = 0; i < polygons.size(); ++i) {
    if (i == own || !BoxOf(polygons[i].outer).intersects(box)) continue;
    if (Area(Intersection({polygons[i]}, reach)) > kMaxOverlap_m2) return true;
  }
  return false;
}

}  // namespace

int MoveDoubtfulWalls(const LoopField& field, const FloorplanOptions& options, const Storey& storey,
                      std::span<const WallSigma> sigmas, std::vector<Polygon2>& polygons) {
  ENFILADE_CHECK(sigmas.size() == storey.walls.size() && polygons.size() == storey.rooms.size());
  const BoxIndex index = IndexWalls(storey.walls);
  int num_moved = 0;
  for (size_t i = 0; i < storey.walls.size(); ++i) {
    const Wall& wall = storey.walls[i];
    const Face face(wall);
    if (sigmas[i].wrong_probability < kDoubtful || face.length_m < kShortest_m) continue;
    std::optional<double> depth_m;
    for (const size_t j : index.Touching(Grown(BoxOf(wall.a, wall.b), kDeepest_m + kAside_m))) {
      if (sigmas[j].wrong_probability > kSure) continue;
      const std::optional<double> to = DepthOf(storey.walls[j], wall, options.min_jog_m);
      if (to && (!depth_m || *to < *depth_m)) depth_m = to;
    }
    if (!depth_m) continue;
    if (*depth_m > kLineError_m && FreenessBehind(field, wall, *depth_m) < kMinFreeness) continue;
    const Vector2d out = *depth_m * face.outward, over = kOverlap_m * face.outward;
    const auto own = static_cast<size_t>(wall.room_id);
    const Ring2 space = {wall.b, wall.a, wall.a + out, wall.b + out};
    if (IsTaken({space, {}}, own, options.wall_thickness_m, polygons)) continue;
    const Ring2 added = {wall.b - over, wall.a - over, wall.a + out, wall.b + out};
    Polygon2 wider =
        TidyRoom(Union({polygons[own]}, {{added, {}}}), options.min_jog_m, LengthOf, own, polygons);
    if (wider.outer.empty()) continue;
    polygons[own] = std::move(wider);
    ++num_moved;
  }
  return num_moved;
}

}  // namespace enfilade
