// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/odd_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/descriptor_matcher.h"
#include "enfilade/sfm/two_view.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/match_pairs.h"
#include "src/sfm/wall_view.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

// Far below the usual bound, as most panoramas that are tried stand upright. Of two thousand pairs
// of upright panoramas, a quarter on a real tour, the best reached -9 turned over; mirrored, where
// walls look the same from left and right, those that nothing else ties reached -8. True ties have
// -30.
constexpr double kClearUpsideDown = -15;
constexpr double kClearMirrored = -12;
constexpr size_t kClearSamePlace = 30;  // matches
constexpr int kSmallShare = 3;
constexpr double kCopyAngle_rad = DegToRad(0.3);
constexpr double kCopyShare = 0.3;

std::vector<std::vector<int>> ViewsOfComponents(std::span<const int> component_idx) {
  std::vector<std::vector<int>> views;
  for (size_t i = 0; i < component_idx.size(); ++i) {
    const size_t component = static_cast<size_t>(component_idx[i]);
    if (component >= views.size()) views.resize(component + 1);
    views[component].push_back(static_cast<int>(i));
  }
  return views;
}

bool IsSmall(const std::vector<int>& component, const std::vector<int>& largest) {
  return component.size() == 1 || kSmallShare * component.size() <= largest.size();
}

bool IsClear(const PanoPair& pair, double max_log10_chance) {
  if (pair.verdict == PairVerdict::kSamePlace) return pair.inliers.size() >= kClearSamePlace;
  return pair.verdict == PairVerdict::kAccepted && pair.log10_chance <= max_log10_chance;
}

PanoPair Compare(const PanoTrial& trial, const PanoFeatures& partner,
                 const Gravity& partner_gravity, const RegisterOptions& options) {
  const std::vector<Vector3d> rays = TurnLevel(trial.features, trial.gravity);
  const std::vector<Vector3d> partner_rays = TurnLevel(partner, partner_gravity);
  return MatchPair({}, {trial.features, trial.gravity, rays},
                   {partner, partner_gravity, partner_rays}, options.match, options.two_view);
}

// The clearest tie between the views, changed by `change`, and the partners.
std::optional<OddTie> ClearestTie(std::span<const PanoFeatures> features,
                                  std::span<const Gravity> gravity, std::span<const int> views,
                                  std::span<const int> partners, double max_log10_chance,
                                  const RegisterOptions& options, RunContext& context,
                                  const std::function<PanoTrial(size_t view_idx)>& change) {
  std::vector<PanoTrial> trials;
  for (const int view : views) trials.push_back(change(static_cast<size_t>(view)));
  std::vector<std::optional<OddTie>> ties(views.size() * partners.size());
  ParallelFor(context, "compare odd pictures", static_cast<int64_t>(ties.size()), [&](int64_t k) {
    const size_t at = static_cast<size_t>(k);
    const size_t trial = at / partners.size();
    const size_t partner = static_cast<size_t>(partners[at % partners.size()]);
    const PanoPair pair = Compare(trials[trial], features[partner], gravity[partner], options);
    if (IsClear(pair, max_log10_chance))
      ties[at] = {views[trial], static_cast<int>(partner), pair.log10_chance};
  });
  std::optional<OddTie> best;
  for (const std::optional<OddTie>& tie : ties) {
    if (tie && (!best || tie->log10_chance < best->log10_chance)) best = tie;
  }
  return best;
}

// Lets the features of a trial be seen in its own wall views: `moved_from_level`, which turns
// azimuths back, makes its level frame of the one that `before` tells.
void Move(const Eigen::Matrix3d& moved_from_level, const Gravity& before, PanoTrial& trial) {
  double heading = 0, moved_heading = 0;
  if (before.heading_rad) {
    heading = *before.heading_rad;
    moved_heading = WrapQuarter(-heading);
    trial.gravity.heading_rad = moved_heading;
  }
  PanoFeatures& features = trial.features;
  const std::array<MovedView, kNumWallViews> moved =
      MoveViews(RotationZ(-moved_heading) * moved_from_level * RotationZ(heading));
  std::vector<uint8_t> values;
  for (int i = 0; i < features.descriptors.size(); ++i) {
    // Where views are not told, descriptors still are upright.
    const MovedView& to =
        moved[features.walls.empty() ? 0 : features.walls[static_cast<size_t>(i)]];
    if (!features.walls.empty())
      features.walls[static_cast<size_t>(i)] = static_cast<uint8_t>(to.view);
    const uint8_t* row = features.descriptors.row(i);
    for (const uint8_t from : to.order) values.push_back(row[from]);
  }
  features.descriptors.values = std::move(values);
}

}  // namespace

PanoTrial TurnedOver(const PanoFeatures& features, const Gravity& gravity) {
  PanoTrial turned{features, gravity};
  turned.gravity.up_in_cam = -gravity.up_in_cam;
  Move(Eigen::DiagonalMatrix<double, 3>(-1, 1, -1), gravity, turned);
  return turned;
}

PanoTrial Mirrored(const PanoFeatures& features, const Gravity& gravity) {
  PanoTrial mirrored{features, gravity};
  mirrored.gravity.up_in_cam.x() = -gravity.up_in_cam.x();
  for (Eigen::Vector3f& ray : mirrored.features.rays) ray.x() = -ray.x();
  Move(Eigen::DiagonalMatrix<double, 3>(-1, 1, 1), gravity, mirrored);
  return mirrored;
}

std::vector<OddTie> TurnOverTheUpsideDown(std::span<const int> component_idx,
                                          const RegisterOptions& options, RunContext& context,
                                          std::vector<PanoFeatures>& features,
                                          std::vector<Gravity>& gravity) {
  const std::vector<std::vector<int>> components = ViewsOfComponents(component_idx);
  std::vector<int> partners = components.front();
  std::vector<OddTie> ties;
  for (size_t k = 1; k < components.size(); ++k) {
    const std::vector<int>& views = components[k];
    const auto turn_over = [&](size_t i) { return TurnedOver(features[i], gravity[i]); };
    const auto tie = ClearestTie(features, gravity, views, partners, kClearUpsideDown, options,
                                 context, turn_over);
    if (tie) {
      ties.push_back(*tie);
      for (const int view : views) {
        const size_t i = static_cast<size_t>(view);
        PanoTrial turned = turn_over(i);
        features[i] = std::move(turned.features);
        gravity[i] = turned.gravity;
      }
    }
    partners.insert(partners.end(), views.begin(), views.end());
  }
  return ties;
}

std::vector<OddTie> FindMirrored(std::span<const PanoFeatures> features,
                                 std::span<const Gravity> gravity,
                                 std::span<const int> component_idx, const RegisterOptions& options,
                                 RunContext& context) {
  const std::vector<std::vector<int>> components = ViewsOfComponents(component_idx);
  std::vector<int> partners = components.front();
  std::vector<OddTie> ties;
  for (size_t k = 1; k < components.size(); ++k) {
    const std::vector<int>& views = components[k];
    const auto mirror = [&](size_t i) { return Mirrored(features[i], gravity[i]); };
    if (IsSmall(views, components.front())) {
      const auto tie =
          ClearestTie(features, gravity, views, partners, kClearMirrored, options, context, mirror);
      if (tie) ties.push_back(*tie);
    }
    partners.insert(partners.end(), views.begin(), views.end());
  }
  return ties;
}

std::vector<OddTie> FindCopies(std::span<const PanoFeatures> features,
                               std::span<const Gravity> gravity, std::span<const PanoPair> pairs) {
  std::vector<OddTie> copies;
  for (const PanoPair& pair : pairs) {
    if (pair.verdict != PairVerdict::kSamePlace) continue;
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    const double num_features = std::min(features[a].size(), features[b].size());
    if (static_cast<double>(pair.inliers.size()) < kCopyShare * num_features) continue;
    const std::vector<Vector3d> rays_a = TurnLevel(features[a], gravity[a]);
    const std::vector<Vector3d> rays_b = TurnLevel(features[b], gravity[b]);
    std::vector<double> angles;
    for (const FeatureMatch& match : pair.inliers) {
      angles.push_back((rays_a[static_cast<size_t>(match.a_idx)] -
                        pair.a_from_b * rays_b[static_cast<size_t>(match.b_idx)])
                           .norm());
    }
    if (UpperMedian(angles) < kCopyAngle_rad) copies.push_back({pair.b_idx, pair.a_idx, 0});
  }
  return copies;
}

}  // namespace enfilade
