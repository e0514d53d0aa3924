// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/pair_joins.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "src/sfm/assemble.h"

namespace enfilade {
namespace {

constexpr double kLeastDigits = 6;
constexpr double kRivalShare = 0.5;
// Of 21 false places that pairs told with 6 digits and more (seven made homes, a real one and three
// parts of it) two laid 0.31 and 0.33 of the smaller floor on the other one, the rest 0.43 and
// more; of 12 true ones eight 0.07 at most.
constexpr double kLogOddsBeside = 18, kMostOverlap = 0.4;
// Before the walls of a panorama stand none of another one's in its room: 0.04 of these in one true
// case, at false places 0.23 and more on one side.
constexpr double kMostBefore = 0.1;
constexpr double kBefore_m = 0.1, kBeforeShare = 0.03;  // and more, of the distance

// A pair between components a < b, and the place that it tells.
struct Told {
  const PanoPair* pair;
  Rigid3 a_from_b;  // components, metres
  double overlap;   // ComponentFloor::OverlapShare there
};

// Whether a pair's first view is in the component of the higher number.
bool IsTurned(const UnjoinedComponents& components, const PanoPair& pair) {
  return components.component_idx[static_cast<size_t>(pair.a_idx)] >
         components.component_idx[static_cast<size_t>(pair.b_idx)];
}

// The panorama's level frame in that of its component.
Rigid3 LevelPose(const UnjoinedComponents& components, int view) {
  const size_t i = static_cast<size_t>(view);
  const Rigid3& pose = components.world_from_cam[i];
  const Eigen::Matrix3d rotation = pose.rotation * LevelFromCam(components.gravity[i]).transpose();
  const Eigen::Vector3d& at = pose.translation;
  return {RotationZ(YawOf(rotation)), {at.x(), at.y(), 0}};
}

Rigid3 TellPlace(const UnjoinedComponents& components, const PanoPair& pair) {
  const Eigen::Vector3d step = components.camera_height_m * pair.length * pair.direction;
  const Rigid3 first_from_second{RotationZ(pair.Yaw_rad()), {step.x(), step.y(), 0}};
  const Rigid3 place = LevelPose(components, pair.a_idx) * first_from_second *
                       LevelPose(components, pair.b_idx).Inverse();
  return IsTurned(components, pair) ? place.Inverse() : place;
}

bool Supports(const UnjoinedComponents& components, const PanoPair& pair, const Told& told) {
  const Rigid3 place = IsTurned(components, pair) ? told.a_from_b.Inverse() : told.a_from_b;
  Rigid3 level =
      LevelPose(components, pair.a_idx).Inverse() * place * LevelPose(components, pair.b_idx);
  level.translation /= components.camera_height_m;
  return TellsPlace(pair, level);
}

// Share of the walls about one view that stand clearly before those of another one, where one lies
// so in the frame of the other.
double ShareBefore(const UnjoinedComponents& components, int view, int other,
                   const Rigid3& other_from_view) {
  const size_t i = static_cast<size_t>(view), j = static_cast<size_t>(other);
  const RoomOutline& walls = components.outlines[i];
  double before = 0;
  for (size_t c = 0; c < walls.wall_m.size(); ++c) {
    const double azimuth = walls.first_azimuth_rad + 2 * kPi * static_cast<double>(c) /
                                                         static_cast<double>(walls.wall_m.size());
    const Eigen::Vector3d ray(std::cos(azimuth), std::sin(azimuth), 0);
    const Eigen::Vector3d wall =
        components.world_from_cam[i].translation + static_cast<double>(walls.wall_m[c]) * ray;
    const Eigen::Vector2d seen =
        (other_from_view * wall - components.world_from_cam[j].translation).head<2>();
    const double free_m = components.outlines[j].WallDistance(seen);
    before += seen.norm() < free_m - (kBefore_m + kBeforeShare * free_m);
  }
  return before / static_cast<double>(walls.wall_m.size());
}

// Whether the rooms as both panoramas of a pair see them can be one.
bool MayBeOneRoom(const UnjoinedComponents& components, const Told& told) {
  const bool is_turned = IsTurned(components, *told.pair);
  const int a = is_turned ? told.pair->b_idx : told.pair->a_idx;
  const int b = is_turned ? told.pair->a_idx : told.pair->b_idx;
  return ShareBefore(components, b, a, told.a_from_b) <= kMostBefore &&
         ShareBefore(components, a, b, told.a_from_b.Inverse()) <= kMostBefore;
}

}  // namespace

std::vector<ComponentJoin> JoinsOfPairs(const UnjoinedComponents& components,
                                        std::span<const ComponentFloor> floors,
                                        const JoinOptions& options) {
  std::map<std::pair<int, int>, std::vector<Told>> told_between;
  for (const PanoPair& pair : components.pairs) {
    const int x = components.component_idx[static_cast<size_t>(pair.a_idx)];
    const int y = components.component_idx[static_cast<size_t>(pair.b_idx)];
    const bool is_placed = pair.length > 0 && pair.log10_chance <= -kLeastDigits;
    if (x == y || pair.verdict != PairVerdict::kChance || !is_placed) continue;
    const auto [a, b] = std::minmax(x, y);
    const Rigid3 place = TellPlace(components, pair);
    const Told told{
        &pair, place,
        floors[static_cast<size_t>(a)].OverlapShare(floors[static_cast<size_t>(b)], place)};
    if (told.overlap > kMostOverlap && !MayBeOneRoom(components, told)) continue;
    told_between[{a, b}].push_back(told);
  }
  std::vector<ComponentJoin> joins;
  for (const auto& [between, all] : told_between) {
    double sum = 0;
    for (const Told& told : all) sum -= told.pair->log10_chance;
    ComponentJoin best;
    double most = 0, overlap = 0;
    for (const Told& told : all) {
      double digits = 0;
      std::vector<DoorPair> pairs;
      for (const Told& other : all) {
        if (!Supports(components, *other.pair, told)) continue;
        digits -= other.pair->log10_chance;
        pairs.push_back({other.pair->a_idx, other.pair->b_idx, other.pair->inliers});
      }
      if (digits <= most) continue;
      most = digits;
      overlap = told.overlap;
      best = {between.first, between.second, told.a_from_b, digits * std::log(10.0),
              std::move(pairs)};
    }
    const double needed = overlap > kMaxOverlap ? options.min_log_odds_overlapping : kLogOddsBeside;
    if (sum - most <= kRivalShare * most && best.log_odds >= needed) {
      joins.push_back(std::move(best));
    }
  }
  return joins;
}

}  // namespace enfilade
