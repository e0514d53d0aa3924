// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/connection_facts.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "enfilade/base/check.h"
#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "enfilade/sfm/view_graph.h"
#include "src/exchange/short_names.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Nearer cameras have no direction to each other that could be missed.
constexpr double kMinDistance_m = 0.1;

void CheckInput(const Scene& scene, const ConnectionReport& report) {
  ENFILADE_CHECK(report.num_features.size() == scene.views.size());
  const int num_views = static_cast<int>(scene.views.size());
  for (const View& view : scene.views) ENFILADE_CHECK(view.world_from_cam.Matrix().allFinite());
  for (const ScenePoint& point : scene.points) {
    ENFILADE_CHECK(point.position.allFinite());
    for (const int view : point.view_idx) ENFILADE_CHECK(view >= 0 && view < num_views);
  }
  for (const PanoPair& pair : report.pairs) {
    ENFILADE_CHECK(pair.a_idx >= 0 && pair.a_idx < pair.b_idx && pair.b_idx < num_views);
  }
}

ViewFact DescribeView(const View& view) {
  ViewFact fact;
  fact.picture = PrintablePath(view.picture);
  fact.is_inferred = view.is_pose_inferred;
  fact.position_m = view.world_from_cam.translation;
  const Vector3d forward = view.world_from_cam.rotation.col(2);
  const Vector3d up = -view.world_from_cam.rotation.col(1);
  fact.yaw_rad = std::atan2(forward.y(), forward.x());
  fact.tilt_rad = std::atan2(up.head<2>().norm(), up.z());
  return fact;
}

std::vector<ViewFact> DescribeViews(const Scene& scene, const ConnectionReport& report) {
  std::vector<ViewFact> views;
  std::vector<std::string> pictures;
  for (size_t i = 0; i < scene.views.size(); ++i) {
    views.push_back(DescribeView(scene.views[i]));
    views.back().num_features = report.num_features[i];
    pictures.push_back(views.back().picture);
  }
  const std::vector<std::string> names = ShortNames(pictures);
  for (size_t i = 0; i < views.size(); ++i) views[i].name = names[i];
  for (const ScenePoint& point : scene.points) {
    for (const int view : point.view_idx) ++views[static_cast<size_t>(view)].num_points;
  }
  for (const PanoPair& pair : report.pairs) {
    if (!IsConnecting(pair)) continue;
    ++views[static_cast<size_t>(pair.a_idx)].num_ties;
    ++views[static_cast<size_t>(pair.b_idx)].num_ties;
  }
  return views;
}

// Groups the views and tells each its component.
std::vector<ComponentFact> DescribeComponents(const Scene& scene, std::vector<ViewFact>& views) {
  std::map<int, ComponentFact> by_idx;
  for (size_t i = 0; i < views.size(); ++i) {
    by_idx[scene.views[i].component_idx].views.push_back(static_cast<int>(i));
  }
  std::vector<ComponentFact> components;
  for (auto& [idx, component] : by_idx) {
    component.idx = idx;
    Eigen::AlignedBox2d box;
    for (const int view : component.views) {
      views[static_cast<size_t>(view)].component = static_cast<int>(components.size());
      box.extend(Vector2d(views[static_cast<size_t>(view)].position_m.head<2>()));
    }
    component.extent_m = box.sizes();
    components.push_back(std::move(component));
  }
  return components;
}

// The turn about z from the world's axes to those of the level frame in which pairs are told.
double LevelYaw(const View& view) {
  Gravity gravity;
  gravity.up_in_cam = view.world_from_cam.rotation.transpose() * Vector3d::UnitZ();
  return YawOf(view.world_from_cam.rotation * LevelFromCam(gravity).transpose());
}

// How far the scene is from what the pair tells.
void Compare(const PanoPair& pair, const Scene& scene, PairFact& fact) {
  const View& a = scene.views[static_cast<size_t>(pair.a_idx)];
  const View& b = scene.views[static_cast<size_t>(pair.b_idx)];
  const Vector3d apart = b.world_from_cam.translation - a.world_from_cam.translation;
  fact.distance_m = apart.norm();
  if (pair.inliers.empty()) return;
  const double yaw_a = LevelYaw(a);
  fact.yaw_miss_rad = WrapPi(pair.Yaw_rad() - (LevelYaw(b) - yaw_a));
  if (pair.verdict == PairVerdict::kSamePlace || apart.head<2>().norm() < kMinDistance_m) return;
  const double told = yaw_a + std::atan2(pair.direction.y(), pair.direction.x());
  fact.direction_miss_rad = std::abs(WrapPi(told - std::atan2(apart.y(), apart.x())));
}

PairFact DescribePair(const PanoPair& pair, const Scene& scene) {
  PairFact fact;
  fact.a = pair.a_idx;
  fact.b = pair.b_idx;
  fact.verdict = pair.verdict;
  fact.is_tie = IsConnecting(pair);
  fact.is_within = scene.views[static_cast<size_t>(pair.a_idx)].component_idx ==
                   scene.views[static_cast<size_t>(pair.b_idx)].component_idx;
  fact.num_matches = pair.num_matches;
  fact.num_inliers = static_cast<int>(pair.inliers.size());
  fact.parallax_rad = pair.parallax_rad;
  fact.log10_chance = pair.log10_chance;
  if (fact.is_within) Compare(pair, scene, fact);
  return fact;
}

}  // namespace

ConnectionFacts CollectConnectionFacts(const Scene& scene, const ConnectionReport& report) {
  CheckInput(scene, report);
  ConnectionFacts facts;
  facts.title = PrintablePath(report.title);
  facts.views = DescribeViews(scene, report);
  facts.components = DescribeComponents(scene, facts.views);
  for (const PanoPair& pair : report.pairs) {
    if (pair.num_matches >= kMinReportedMatches || IsConnecting(pair)) {
      facts.pairs.push_back(DescribePair(pair, scene));
    } else {
      ++facts.num_left_out;
    }
  }
  const auto num_views = static_cast<int64_t>(scene.views.size());
  facts.num_not_matched =
      num_views * (num_views - 1) / 2 - static_cast<int64_t>(report.pairs.size());
  std::ranges::sort(facts.pairs, {}, [](const PairFact& p) { return std::tuple(p.a, p.b); });
  for (const ScenePoint& point : scene.points) {
    if (point.view_idx.empty()) continue;
    const auto view = static_cast<size_t>(point.view_idx.front());
    facts.points.push_back({point.position.head<2>(), facts.views[view].component});
  }
  for (const std::string& warning : report.warnings) {
    facts.warnings.push_back(PrintablePath(warning));
  }
  return facts;
}

std::string Counted(size_t count, const std::string& thing, const std::string& things) {
  if (count == 1) return "1 " + thing;
  return fmt::format("{} {}", count, things.empty() ? thing + "s" : things);
}

}  // namespace enfilade
