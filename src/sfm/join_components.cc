// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/join_components.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/component_floor.h"
#include "src/sfm/door_placement.h"
#include "src/sfm/landscape.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/pair_joins.h"
#include "src/sfm/wall_matches.h"

namespace enfilade {
namespace {

std::vector<ComponentFloor> FloorsOf(const UnjoinedComponents& components) {
  const int num_components =
      1 + *std::max_element(components.component_idx.begin(), components.component_idx.end());
  std::vector<std::vector<RoomView>> views(static_cast<size_t>(num_components));
  for (size_t i = 0; i < components.component_idx.size(); ++i) {
    views[static_cast<size_t>(components.component_idx[i])].push_back(
        {static_cast<int>(i), components.world_from_cam[i].translation, &components.outlines[i]});
  }
  return {views.begin(), views.end()};
}

// LogSizes of each view.
using ViewLogSizes = std::vector<std::vector<double>>;

ViewLogSizes SizesOf(const UnjoinedComponents& components) {
  ViewLogSizes sizes;
  for (size_t i = 0; i < components.features.size(); ++i) {
    const PanoFeatures& features = components.features[i];
    const Gravity& gravity = components.gravity[i];
    sizes.push_back(LogSizes(features, TurnLevel(features, gravity), gravity));
  }
  return sizes;
}

RoomRay RayOf(const UnjoinedComponents& components, const ViewLogSizes& log_sizes,
              const RoomView& view, int feature) {
  const size_t i = static_cast<size_t>(view.view_idx);
  const Eigen::Vector3d ray =
      components.world_from_cam[i].rotation *
      components.features[i].rays[static_cast<size_t>(feature)].cast<double>();
  RoomRay room_ray{ray, view.outline->SurfaceDistance(view.position.z(), ray)};
  const size_t k = static_cast<size_t>(feature);
  if (k < log_sizes[i].size()) room_ray.log_size = log_sizes[i][k];
  return room_ray;
}

// Matches a pair of panoramas with b turned, and what is known of the matches.
void FillMatches(const UnjoinedComponents& components, const ViewLogSizes& log_sizes,
                 const Rigid3& turn, double max_ratio, ViewPairMatches& pair) {
  const size_t a = static_cast<size_t>(pair.a.view_idx), b = static_cast<size_t>(pair.b.view_idx);
  const double yaw_rad =
      YawBetween(components.world_from_cam[a], turn * components.world_from_cam[b],
                 components.gravity[a], components.gravity[b]);
  const std::vector<FeatureMatch> matches =
      MatchAtYaw(components.features[a], components.gravity[a], components.features[b],
                 components.gravity[b], yaw_rad, {.max_ratio = max_ratio});
  std::vector<RoomRay> rays_a, rays_b;
  std::vector<Eigen::Vector3d> directions_a, directions_b;
  for (const FeatureMatch& match : matches) {
    rays_a.push_back(RayOf(components, log_sizes, pair.a, match.a_idx));
    rays_b.push_back(RayOf(components, log_sizes, pair.b, match.b_idx));
    directions_a.push_back(rays_a.back().ray);
    directions_b.push_back(rays_b.back().ray);
  }
  for (const size_t i : WithoutLandscape(directions_a, directions_b)) {
    pair.matches.push_back(matches[i]);
    pair.rays_a.push_back(rays_a[i]);
    pair.rays_b.push_back(rays_b[i]);
  }
}

// The matches of all pairs of panoramas of two components, in the order of the views.
TurnedMatches MatchAcross(const UnjoinedComponents& components, const ViewLogSizes& log_sizes,
                          const ComponentFloor& a, const ComponentFloor& b, double max_ratio,
                          RunContext& context) {
  std::vector<ViewPairMatches> unmatched;
  for (const RoomView& view_a : a.views()) {
    for (const RoomView& view_b : b.views()) unmatched.push_back({view_a, view_b, {}, {}, {}});
  }
  TurnedMatches of_turn;
  of_turn.fill(unmatched);
  ParallelFor(context, "match components", static_cast<int64_t>(4 * unmatched.size()),
              [&](int64_t k) {
                const size_t turn = static_cast<size_t>(k) / unmatched.size();
                const Rigid3 turned{RotationZ(static_cast<double>(turn) * kPi / 2), {0, 0, 0}};
                FillMatches(components, log_sizes, turned, max_ratio,
                            of_turn[turn][static_cast<size_t>(k) % unmatched.size()]);
              });
  for (std::vector<ViewPairMatches>& pairs : of_turn) {
    std::erase_if(pairs, [](const ViewPairMatches& pair) { return pair.matches.empty(); });
  }
  return of_turn;
}

std::vector<DoorPair> DoorPairs(std::span<const ViewPairMatches> pairs, const DoorSight& sight) {
  std::vector<DoorPair> result;
  for (size_t p = 0; p < pairs.size(); ++p) {
    if (sight.inliers[p].empty()) continue;
    DoorPair pair{pairs[p].a.view_idx, pairs[p].b.view_idx, {}};
    for (const size_t match : sight.inliers[p]) pair.inliers.push_back(pairs[p].matches[match]);
    if (pair.a_idx > pair.b_idx) {
      std::swap(pair.a_idx, pair.b_idx);
      for (FeatureMatch& match : pair.inliers) std::swap(match.a_idx, match.b_idx);
      std::sort(pair.inliers.begin(), pair.inliers.end(),
                [](const FeatureMatch& x, const FeatureMatch& y) { return x.a_idx < y.a_idx; });
    }
    result.push_back(std::move(pair));
  }
  return result;
}

// Components grouped by the joins so far, each with its place in the frame of its group.
class Groups {
 public:
  explicit Groups(size_t num_components) : group_(num_components), group_from_(num_components) {
    for (size_t c = 0; c < num_components; ++c) group_[c] = static_cast<int>(c);
  }

  // Puts b's group to a's as a join says, unless they are one already or would overlap by more than
  // the join is worth.
  bool Join(const ComponentJoin& join, std::span<const ComponentFloor> floors,
            const JoinOptions& options) {
    const size_t a = static_cast<size_t>(join.a), b = static_cast<size_t>(join.b);
    const int group_a = group_[a], group_b = group_[b];
    if (group_a == group_b) return false;
    const Rigid3 a_group_from_b_group = group_from_[a] * join.a_from_b * group_from_[b].Inverse();
    for (size_t i = 0; i < group_.size(); ++i) {
      for (size_t j = 0; j < group_.size(); ++j) {
        if (group_[i] != group_a || group_[j] != group_b) continue;
        const Rigid3 i_from_j = group_from_[i].Inverse() * a_group_from_b_group * group_from_[j];
        const bool is_overlapping = floors[i].OverlapShare(floors[j], i_from_j) > kMaxOverlap;
        if (is_overlapping && join.log_odds < options.min_log_odds_overlapping) return false;
      }
    }
    for (size_t j = 0; j < group_.size(); ++j) {
      if (group_[j] != group_b) continue;
      group_from_[j] = a_group_from_b_group * group_from_[j];
      group_[j] = group_a;
    }
    return true;
  }

 private:
  std::vector<int> group_;
  std::vector<Rigid3> group_from_;
};

}  // namespace

std::vector<ComponentJoin> JoinComponents(const UnjoinedComponents& components,
                                          const JoinOptions& options, RunContext& context) {
  ENFILADE_CHECK(components.world_from_cam.size() == components.component_idx.size());
  ENFILADE_CHECK(components.features.size() == components.component_idx.size());
  ENFILADE_CHECK(components.gravity.size() == components.component_idx.size());
  ENFILADE_CHECK(components.outlines.size() == components.component_idx.size());
  if (components.component_idx.empty()) return {};
  const std::vector<ComponentFloor> floors = FloorsOf(components);
  const ViewLogSizes log_sizes = SizesOf(components);
  std::vector<ComponentJoin> found = JoinsOfPairs(components, floors, options);
  for (size_t a = 0; a < floors.size(); ++a) {
    for (size_t b = a + 1; b < floors.size(); ++b) {
      const TurnedMatches matches =
          MatchAcross(components, log_sizes, floors[a], floors[b], options.max_ratio, context);
      const std::optional<JudgedPlacement> best =
          FindDoorPlacement(matches, floors[a], floors[b], options, context);
      if (!best) continue;
      found.push_back({static_cast<int>(a), static_cast<int>(b), best->placement.Transform(),
                       best->log_odds, DoorPairs(matches[best->turn], best->sight)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const ComponentJoin& x, const ComponentJoin& y) {
    return x.log_odds > y.log_odds;
  });
  Groups groups(floors.size());
  std::erase_if(found,
                [&](const ComponentJoin& join) { return !groups.Join(join, floors, options); });
  return found;
}

}  // namespace enfilade
