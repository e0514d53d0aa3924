// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/pictured_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "enfilade/image/codec.h"
#include "src/floorplan/facade_store.h"
#include "src/floorplan/wall_thickness.h"
#include "src/floorplan/window_frames.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

// The two sides of a wall run against each other (cosine) and may cross by errors.
constexpr double kOpposite = 0.98, kMinBehind_m = -0.05;
// What they say of one door: how far its middles may be apart, how sure each must be at least, and
// what they are worth together.
constexpr double kSameDoor_m = 0.3, kMinOtherSide = -1.5, kBothSides = 1;
constexpr float kMaxBaseboard = 0.45F;  // across an opening
// An opening shows from both sides where both were looked at: a wardrobe has a frame from one.
constexpr double kMinOtherStrength = 0.4, kMinLookedAt = 0.8;

FacadeView ReadView(const View& view, const Rigid3& home_from_world) {
  return {view.camera, home_from_world * view.world_from_cam, ReadImageGray(view.path),
          view.mask_path.empty() ? ImageU8() : ReadImageGray(view.mask_path)};
}

// A view with a picture, and the rooms that it stands in.
struct Audience {
  const View* view = nullptr;
  std::vector<const Polygon2*> rooms;

  [[nodiscard]] bool Sees(const PicturedWall& wall) const {
    return view->storey_idx == wall.storey_idx &&
           std::find(rooms.begin(), rooms.end(), wall.room) != rooms.end();
  }
};

// The views that stand in a room of the walls.
std::vector<Audience> AudiencesOf(const Scene& scene, const Rigid3& home_from_world,
                                  const std::vector<PicturedWall*>& walls) {
  std::vector<std::pair<int, const Polygon2*>> rooms;  // walls of a room follow each other
  for (const PicturedWall* wall : walls) {
    const std::pair room(wall->storey_idx, wall->room);
    if (rooms.empty() || rooms.back() != room) rooms.push_back(room);
  }
  std::vector<Audience> audiences;
  for (const View& view : scene.views) {
    if (view.path.empty()) continue;
    const Vector2d position = (home_from_world * view.world_from_cam.translation).head<2>();
    Audience audience{&view, {}};
    for (const auto& [storey_idx, room] : rooms) {
      if (view.storey_idx == storey_idx && Contains(*room, position))
        audience.rooms.push_back(room);
    }
    if (!audience.rooms.empty()) audiences.push_back(std::move(audience));
  }
  return audiences;
}

double DistanceToCamera(const std::vector<Vector2d>& cameras, const Vector2d& p) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Vector2d& camera : cameras) distance = std::min(distance, (camera - p).norm());
  return distance;
}

// True for the same door seen from two sides of a wall, its middles up to max_aside_m apart.
bool AreTwoSides(const DoorCandidate& a, const DoorCandidate& b, double max_wall_m,
                 double max_aside_m = kSameDoor_m) {
  if (a.Outward().dot(b.Outward()) > -kOpposite) return false;
  const Vector2d between = b.Middle() - a.Middle();
  const double behind_m = between.dot(a.Outward());
  const double aside_m = std::abs(between.dot((a.b - a.a).normalized()));
  return behind_m > kMinBehind_m && behind_m < max_wall_m && aside_m < max_aside_m;
}

// How much of a frame has this wall as the other side of its own.
double CommonWidth(const DoorCandidate& frame, const PicturedWall& wall, double max_wall_m) {
  const std::optional<FarFace> face = FarFaceOf(frame.a, frame.b, wall.a, wall.b, kOpposite);
  if (!face || face->gap_m < kMinBehind_m || face->gap_m > max_wall_m) return 0;
  return std::max(0.0, face->common_m);
}

// The first of each place, in the order given.
std::vector<DoorCandidate> OneOfEachPlace(const std::vector<DoorCandidate>& candidates,
                                          double max_wall_m) {
  std::vector<DoorCandidate> kept;
  for (const DoorCandidate& candidate : candidates) {
    const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const DoorCandidate& other) {
      return AreTwoSides(candidate, other, max_wall_m);
    });
    if (!is_known) kept.push_back(candidate);
  }
  return kept;
}

DoorCandidate CandidateOf(const PicturedWall& wall, size_t wall_idx, const DoorFrame& frame,
                          double log_odds) {
  const Vector2d along = (wall.b - wall.a).normalized();
  return {wall_idx, frame, wall.a + frame.begin_m * along, wall.a + frame.end_m * along,
          log_odds, 0};
}

void SortBySurest(std::vector<DoorCandidate>& candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const DoorCandidate& a, const DoorCandidate& b) { return a.log_odds > b.log_odds; });
}

std::vector<DoorCandidate> JoinSides(const std::vector<DoorCandidate>& doors, double max_wall_m) {
  std::vector<DoorCandidate> raised = doors;
  for (DoorCandidate& door : raised) {
    const bool agrees = std::any_of(doors.begin(), doors.end(), [&](const DoorCandidate& other) {
      return other.log_odds > kMinOtherSide && AreTwoSides(door, other, max_wall_m);
    });
    if (agrees) door.log_odds += kBothSides;
  }
  SortBySurest(raised);
  return OneOfEachPlace(raised, max_wall_m);
}

}  // namespace

void LookAtWalls(const Scene& scene, const Rigid3& home_from_world, FacadeStore& store,
                 RunContext& context, std::vector<PicturedWall>& walls) {
  std::vector<PicturedWall*> unseen;
  for (PicturedWall& wall : walls) {
    if (!store.Take(wall)) unseen.push_back(&wall);
  }
  const std::vector<Audience> audiences = AudiencesOf(scene, home_from_world, unseen);
  const auto batch = static_cast<size_t>(std::max(1, context.num_threads()));
  for (size_t first = 0; first < audiences.size(); first += batch) {
    const size_t count = std::min(batch, audiences.size() - first);
    std::vector<FacadeView> views(count);
    ParallelFor(context, "", static_cast<int64_t>(count), [&](int64_t i) {
      const auto k = static_cast<size_t>(i);
      views[k] = ReadView(*audiences[first + k].view, home_from_world);
    });
    ParallelFor(context, "", static_cast<int64_t>(unseen.size()), [&](int64_t i) {
      PicturedWall& wall = *unseen[static_cast<size_t>(i)];
      for (size_t k = 0; k < count; ++k) {
        if (audiences[first + k].Sees(wall)) wall.facade.Add(views[k], *wall.room);
      }
    });
  }
  for (PicturedWall* wall : unseen) wall->facade.Finish();
}

std::optional<double> FindFrames(RunContext& context, std::vector<PicturedWall>& walls) {
  std::vector<std::vector<DoorFrame>> frames(walls.size());
  const auto find = [&](std::optional<double> head_m) {
    ParallelFor(context, "", static_cast<int64_t>(walls.size()), [&](int64_t i) {
      const Facade& facade = walls[static_cast<size_t>(i)].facade;
      if (facade.num_views() > 0) frames[static_cast<size_t>(i)] = FindDoorFrames(facade, head_m);
    });
  };
  find(std::nullopt);
  const std::optional<double> head_m = HomeHead(frames);
  if (!head_m) return head_m;
  find(head_m);
  for (size_t i = 0; i < walls.size(); ++i) walls[i].frames = std::move(frames[i]);
  return head_m;
}

std::vector<DoorCandidate> FindDoors(const std::vector<PicturedWall>& walls, int storey_idx,
                                     const std::vector<Vector2d>& cameras, double home_head_m,
                                     double max_wall_m) {
  std::vector<DoorCandidate> doors;
  for (size_t i = 0; i < walls.size(); ++i) {
    const PicturedWall& wall = walls[i];
    if (wall.storey_idx != storey_idx) continue;
    for (const DoorFrame& frame : wall.frames) {
      DoorCandidate door = CandidateOf(wall, i, frame, 0);
      door.log_odds = wall.door_log_odds +
                      DoorLogOdds(frame, home_head_m, DistanceToCamera(cameras, door.Middle()));
      doors.push_back(door);
    }
  }
  return JoinSides(doors, max_wall_m);
}

std::vector<DoorCandidate> FindWideOpenings(const std::vector<PicturedWall>& walls, int storey_idx,
                                            double min_strength, double max_wall_m) {
  std::vector<DoorCandidate> frames;
  for (size_t i = 0; i < walls.size(); ++i) {
    if (walls[i].storey_idx != storey_idx || walls[i].facade.num_views() == 0) continue;
    for (const DoorFrame& frame : FindWideFrames(walls[i].facade))
      frames.push_back(CandidateOf(walls[i], i, frame, frame.score));
  }
  std::vector<DoorCandidate> openings;
  for (const DoorCandidate& frame : frames) {
    if (frame.log_odds < min_strength || frame.frame.baseboard > kMaxBaseboard) continue;
    double looked_at_m = 0;  // from the other side
    for (const PicturedWall& wall : walls) {
      if (wall.storey_idx == storey_idx && wall.facade.num_views() > 0)
        looked_at_m += CommonWidth(frame, wall, max_wall_m);
    }
    const bool is_confirmed =
        std::any_of(frames.begin(), frames.end(), [&](const DoorCandidate& other) {
          return other.log_odds >= kMinOtherStrength &&
                 AreTwoSides(frame, other, max_wall_m,
                             0.5 * std::min(frame.frame.Width(), other.frame.Width()));
        });
    if (is_confirmed || looked_at_m < kMinLookedAt * frame.frame.Width()) openings.push_back(frame);
  }
  SortBySurest(openings);
  return OneOfEachPlace(openings, max_wall_m);
}

std::vector<DoorCandidate> FindWindows(const std::vector<PicturedWall>& walls, int storey_idx,
                                       double min_strength) {
  std::vector<DoorCandidate> windows;
  for (size_t i = 0; i < walls.size(); ++i) {
    if (walls[i].storey_idx != storey_idx || walls[i].facade.num_views() == 0) continue;
    for (const WindowFrame& window :
         FindWindowFrames(walls[i].facade, static_cast<float>(min_strength))) {
      const DoorFrame frame{
          .begin_m = window.begin_m, .end_m = window.end_m, .head_m = window.head_m};
      windows.push_back(CandidateOf(walls[i], i, frame, window.strength));
      windows.back().sill_m = window.sill_m;
    }
  }
  SortBySurest(windows);
  return windows;
}

bool AreInOnePlace(const DoorCandidate& a, const DoorCandidate& b, double max_wall_m) {
  const Vector2d along = (a.b - a.a).normalized();
  const double behind_m = std::abs((b.Middle() - a.Middle()).dot(a.Outward()));
  const double begin = along.dot(b.a - a.a), end = along.dot(b.b - a.a);
  return std::abs(along.dot((b.b - b.a).normalized())) > 0.98 && behind_m < max_wall_m &&
         std::min(begin, end) < a.frame.Width() && std::max(begin, end) > 0;
}

std::vector<Vector2d> CamerasInPlan(const Scene& scene, const Rigid3& home_from_world,
                                    int storey_idx) {
  std::vector<Vector2d> cameras;
  for (const View& view : scene.views) {
    if (view.storey_idx == storey_idx)
      cameras.push_back((home_from_world * view.world_from_cam.translation).head<2>());
  }
  return cameras;
}

}  // namespace enfilade
