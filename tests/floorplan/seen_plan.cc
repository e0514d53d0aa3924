// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/floorplan/seen_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/floorplan/drawn_evidence.h"
#include "tests/support/plan_fixtures.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kColumns = 256;

WallProfile PerfectProfile(int view_idx, const Vector2d& camera, const Ring2& room) {
  WallProfile profile;
  profile.view_idx = view_idx;
  profile.ceiling_z = 2.4;
  for (int c = 0; c < kColumns; ++c) {
    const double azimuth = AzimuthOfColumn(c, kColumns);
    const double distance =
        RayDistance(room, camera, Vector2d(std::cos(azimuth), std::sin(azimuth)));
    profile.wall_m.push_back(static_cast<float>(distance));
  }
  profile.obstacle_m = profile.wall_m;
  profile.confidence.assign(kColumns, 1);
  profile.is_seen.assign(kColumns, 1);
  return profile;
}

}  // namespace

SeenPlan MakeSeenPlan(double angle_rad, bool has_passage) {
  const Eigen::Rotation2Dd turn(angle_rad);
  std::vector<Room> rooms = {MakeRoom(0, "0,0 4,0 4,3 2.5,3 2.5,4 0,4"),
                             MakeRoom(1, "4.1,0 7,0 7,3 4.1,3")};
  for (Room& room : rooms) {
    for (Vector2d& p : room.polygon.outer) p = turn * p;
  }
  SeenPlan home;
  home.evidence = DrawEvidence({rooms[0].polygon, rooms[1].polygon});
  const Vector2d cameras[] = {turn * Vector2d(2, 1.5), turn * Vector2d(5.5, 1.5)};
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<size_t>(i);
    View view;
    view.picture = i == 0 ? "first.jpg" : "second.jpg";
    view.world_from_cam.translation = Vector3d(cameras[k].x(), cameras[k].y(), 1.4);
    home.scene.views.push_back(view);
    home.structure.profiles.push_back(PerfectProfile(i, cameras[k], rooms[k].polygon.outer));
  }
  home.structure.storeys = {{0, 2.4, 0}};
  home.plan = MakePlan(std::move(rooms));
  for (const View& view : home.scene.views)
    home.plan.cameras.push_back({view.picture, "", 0, 0, false, view.world_from_cam});
  if (has_passage) {
    Opening opening;
    opening.kind = OpeningKind::kOpening;
    opening.wall_id = static_cast<int>(home.partition);
    opening.a = turn * Vector2d(4, 1);
    opening.b = turn * Vector2d(4, 2);
    opening.other_room_id = 1;
    home.plan.storeys[0].openings.push_back(opening);
  }
  return home;
}

}  // namespace enfilade
