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

RoomRay RayOf(const UnjoinedComponents& components, const RoomView& view, int feature) {
  const size_t i = static_cast<size_t>(view.view_idx);
  const Eigen::Vector3d ray =
      components.world_from_cam[i].rotation *
      components.features[i].rays[static_cast<size_t>(feature)].cast<double>();
  return {ray, view.outline->SurfaceDistance(view.position.z(), ray)};
}

// Leaves out matches that a turn about the vertical alone explains: the landscape behind windows is
// the same for many rooms, and through two windows it looks like a room behind a door.
void DropLandscape(ViewPairMatches& pair) {
  constexpr double kSame_rad = DegToRad(1);
  constexpr int kMinLandscape = 3;
  const auto azimuth = [](const Eigen::Vector3d& ray) { return std::atan2(ray.y(), ray.x()); };
  const size_t count = pair.matches.size();
  std::vector<char> is_level_with(count, 0);
  std::vector<double> turn_rad(count, 0);
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d &a = pair.rays_a[i].ray, &b = pair.rays_b[i].ray;
    is_level_with[i] = std::abs(std::asin(a.z()) - std::asin(b.z())) < kSame_rad ? 1 : 0;
    turn_rad[i] = azimuth(a) - azimuth(b);
  }
  std::vector<char> is_landscape(count, 0);
  for (size_t i = 0; i < count; ++i) {
    if (is_level_with[i] == 0) continue;
    int num_alike = 0;
    for (size_t k = 0; k < count; ++k) {
      const bool is_alike =
          is_level_with[k] != 0 && std::abs(WrapPi(turn_rad[i] - turn_rad[k])) < kSame_rad;
      const bool is_apart = (pair.rays_a[i].ray - pair.rays_a[k].ray).norm() > kSame_rad;
      num_alike += is_alike && is_apart ? 1 : 0;
    }
    is_landscape[i] = num_alike >= kMinLandscape ? 1 : 0;
  }
  size_t kept = 0;
  for (size_t i = 0; i < count; ++i) {
    if (is_landscape[i] != 0) continue;
    pair.matches[kept] = pair.matches[i];
    pair.rays_a[kept] = pair.rays_a[i];
    pair.rays_b[kept] = pair.rays_b[i];
    ++kept;
  }
  pair.matches.resize(kept);
  pair.rays_a.resize(kept);
  pair.rays_b.resize(kept);
}

// The matches of all pairs of panoramas of two components, in the order of the views.
std::vector<ViewPairMatches> MatchAcross(const UnjoinedComponents& components,
                                         const ComponentFloor& a, const ComponentFloor& b,
                                         double max_ratio, RunContext& context) {
  std::vector<ViewPairMatches> pairs;
  for (const RoomView& view_a : a.views()) {
    for (const RoomView& view_b : b.views()) pairs.push_back({view_a, view_b, {}, {}, {}});
  }
  ParallelFor(context, "match components", static_cast<int64_t>(pairs.size()), [&](int64_t k) {
    ViewPairMatches& pair = pairs[static_cast<size_t>(k)];
    pair.matches =
        MatchDescriptors(components.features[static_cast<size_t>(pair.a.view_idx)].descriptors,
                         components.features[static_cast<size_t>(pair.b.view_idx)].descriptors,
                         {.max_ratio = max_ratio});
    for (const FeatureMatch& match : pair.matches) {
      pair.rays_a.push_back(RayOf(components, pair.a, match.a_idx));
      pair.rays_b.push_back(RayOf(components, pair.b, match.b_idx));
    }
    DropLandscape(pair);
  });
  std::erase_if(pairs, [](const ViewPairMatches& pair) { return pair.matches.empty(); });
  return pairs;
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

  // Puts b's group to a's where `a_from_b` says, unless they are one already or would overlap.
  bool Join(size_t a, size_t b, const Rigid3& a_from_b, std::span<const ComponentFloor> floors,
            double max_overlap) {
    const int group_a = group_[a], group_b = group_[b];
    if (group_a == group_b) return false;
    const Rigid3 a_group_from_b_group = group_from_[a] * a_from_b * group_from_[b].Inverse();
    for (size_t i = 0; i < group_.size(); ++i) {
      for (size_t j = 0; j < group_.size(); ++j) {
        if (group_[i] != group_a || group_[j] != group_b) continue;
        const Rigid3 i_from_j = group_from_[i].Inverse() * a_group_from_b_group * group_from_[j];
        if (floors[i].OverlapShare(floors[j], i_from_j) > max_overlap) return false;
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
  ENFILADE_CHECK(components.outlines.size() == components.component_idx.size());
  if (components.component_idx.empty()) return {};
  const std::vector<ComponentFloor> floors = FloorsOf(components);
  std::vector<ComponentJoin> found;
  for (size_t a = 0; a < floors.size(); ++a) {
    for (size_t b = a + 1; b < floors.size(); ++b) {
      const std::vector<ViewPairMatches> pairs =
          MatchAcross(components, floors[a], floors[b], options.max_ratio, context);
      const std::optional<JudgedPlacement> best =
          FindDoorPlacement(pairs, floors[a], floors[b], options, context);
      if (!best) continue;
      found.push_back({static_cast<int>(a), static_cast<int>(b), best->placement.Transform(),
                       best->log_odds, DoorPairs(pairs, best->sight)});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const ComponentJoin& x, const ComponentJoin& y) {
    return x.log_odds > y.log_odds;
  });
  Groups groups(floors.size());
  std::erase_if(found, [&](const ComponentJoin& join) {
    return !groups.Join(static_cast<size_t>(join.a), static_cast<size_t>(join.b), join.a_from_b,
                        floors, options.max_overlap);
  });
  return found;
}

}  // namespace enfilade
