// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/assemble.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "enfilade/geometry/angles.h"
#include "enfilade/geometry/rigid3.h"
#include "enfilade/sfm/positions.h"
#include "enfilade/sfm/view_graph.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr double kStrongLog10Chance = -30;
constexpr double kTieDigits = 20;
// Panoramas of one room, this near to each other (camera heights), have 70 digits and more, and two
// rooms of one kind easily have a few: one laid upon the other.
constexpr double kNear = 1.2, kNearTieDigits = 45;
constexpr double kRivalShare = 0.5;
constexpr double kMaxTurn_rad = DegToRad(3);
constexpr double kMaxDirection_rad = DegToRad(8);
constexpr double kMaxMiss = 0.2, kMaxMissShare = 0.12;  // camera heights, of the length

// Views with poses in the frames of their groups: camera heights, z up, level.
struct Groups {
  std::vector<int> group_idx;
  std::vector<Rigid3> group_from_view;

  [[nodiscard]] int GroupOf(int view) const { return group_idx[static_cast<size_t>(view)]; }
  [[nodiscard]] const Rigid3& PoseOf(int view) const {
    return group_from_view[static_cast<size_t>(view)];
  }
  // Moves a group into the frame of another.
  void Join(int group, int other, const Rigid3& group_from_other) {
    for (size_t i = 0; i < group_idx.size(); ++i) {
      if (group_idx[i] != other) continue;
      group_idx[i] = group;
      group_from_view[i] = group_from_other * group_from_view[i];
    }
  }
};

Rigid3 LevelPose(double yaw_rad, double x, double y) {
  return {RotationZ(yaw_rad), Vector3d(x, y, 0)};
}

Groups GroupStrong(int num_views, std::vector<PanoPair>& pairs) {
  std::vector<PanoPair> strong;
  std::vector<size_t> at;
  for (size_t k = 0; k < pairs.size(); ++k) {
    const bool is_strong =
        pairs[k].log10_chance <= kStrongLog10Chance || pairs[k].verdict == PairVerdict::kSamePlace;
    if (!IsConnecting(pairs[k]) || !is_strong) continue;
    strong.push_back(pairs[k]);
    at.push_back(k);
  }
  const std::vector<double> yaws = AverageYaws(num_views, strong);
  const std::vector<Eigen::Vector2d> positions = SolvePositions(yaws, strong);
  for (size_t k = 0; k < strong.size(); ++k) pairs[at[k]].verdict = strong[k].verdict;
  Groups groups{FindComponents(num_views, strong), {}};
  for (size_t i = 0; i < yaws.size(); ++i) {
    groups.group_from_view.push_back(LevelPose(yaws[i], positions[i].x(), positions[i].y()));
  }
  return groups;
}

double Digits(const PanoPair& pair) { return std::max(0.0, -pair.log10_chance); }

// A place of one group in the frame of another, and how many digits of chance speak for it.
struct Tie {
  int group = 0, other = 0;
  Rigid3 group_from_other;
  double digits = 0;
};

bool IsBetween(const PanoPair& pair, const Groups& groups, const Tie& tie) {
  const int a = groups.GroupOf(pair.a_idx), b = groups.GroupOf(pair.b_idx);
  return (a == tie.group && b == tie.other) || (a == tie.other && b == tie.group);
}

bool Supports(const PanoPair& pair, const Groups& groups, const Tie& tie) {
  const Rigid3 &a = groups.PoseOf(pair.a_idx), &b = groups.PoseOf(pair.b_idx);
  const Rigid3 moved = groups.GroupOf(pair.b_idx) == tie.other
                           ? a.Inverse() * tie.group_from_other * b
                           : (tie.group_from_other * a).Inverse() * b;
  return TellsPlace(pair, moved);
}

std::optional<Tie> TieOf(const PanoPair& pair, const Groups& groups) {
  if (pair.length <= 0) return std::nullopt;
  const Vector3d step = pair.length * pair.direction;
  const Rigid3 a_from_b = LevelPose(pair.Yaw_rad(), step.x(), step.y());
  return Tie{groups.GroupOf(pair.a_idx), groups.GroupOf(pair.b_idx),
             groups.PoseOf(pair.a_idx) * a_from_b * groups.PoseOf(pair.b_idx).Inverse(), 0};
}

double DigitsNeeded(const Groups& groups, const Tie& tie) {
  for (size_t i = 0; i < groups.group_idx.size(); ++i) {
    if (groups.group_idx[i] != tie.group) continue;
    for (size_t j = 0; j < groups.group_idx.size(); ++j) {
      if (groups.group_idx[j] != tie.other) continue;
      const Vector3d moved = tie.group_from_other * groups.group_from_view[j].translation;
      if ((groups.group_from_view[i].translation - moved).norm() < kNear) return kNearTieDigits;
    }
  }
  return kTieDigits;
}

// The clearest tie between two groups, if any is clear enough.
std::optional<Tie> ClearestTie(std::span<const PanoPair* const> weak, const Groups& groups) {
  std::vector<Tie> ties;
  for (const PanoPair* pair : weak) {
    if (groups.GroupOf(pair->a_idx) == groups.GroupOf(pair->b_idx)) continue;
    std::optional<Tie> tie = TieOf(*pair, groups);
    if (!tie) continue;
    for (const PanoPair* other : weak) {
      if (IsBetween(*other, groups, *tie) && Supports(*other, groups, *tie))
        tie->digits += Digits(*other);
    }
    ties.push_back(*tie);
  }
  std::stable_sort(ties.begin(), ties.end(),
                   [](const Tie& x, const Tie& y) { return x.digits > y.digits; });
  for (const Tie& tie : ties) {
    if (tie.digits < DigitsNeeded(groups, tie)) continue;
    double all = 0;
    for (const PanoPair* pair : weak) {
      if (IsBetween(*pair, groups, tie)) all += Digits(*pair);
    }
    if (all - tie.digits <= kRivalShare * tie.digits) return tie;
  }
  return std::nullopt;
}

}  // namespace

bool TellsPlace(const PanoPair& pair, const Rigid3& a_from_b) {
  if (std::abs(WrapPi(pair.Yaw_rad() - YawOf(a_from_b.rotation))) > kMaxTurn_rad) return false;
  const Eigen::Vector2d apart = a_from_b.translation.head<2>();
  const Eigen::Vector2d told = pair.direction.head<2>().normalized();
  if (pair.length > 0) {
    return (pair.length * told - apart).norm() <
           std::max(kMaxMiss, kMaxMissShare * std::max(pair.length, apart.norm()));
  }
  return std::acos(std::clamp(told.dot(apart.normalized()), -1.0, 1.0)) < kMaxDirection_rad;
}

void AssembleGroups(int num_views, std::vector<PanoPair>& pairs) {
  Groups groups = GroupStrong(num_views, pairs);
  std::vector<PanoPair*> weak;
  for (PanoPair& pair : pairs) {
    if (pair.verdict == PairVerdict::kAccepted && pair.log10_chance > kStrongLog10Chance)
      weak.push_back(&pair);
  }
  while (const std::optional<Tie> tie = ClearestTie(weak, groups)) {
    groups.Join(tie->group, tie->other, tie->group_from_other);
  }
  for (PanoPair* pair : weak) {
    const Rigid3 &a = groups.PoseOf(pair->a_idx), &b = groups.PoseOf(pair->b_idx);
    if (groups.GroupOf(pair->a_idx) != groups.GroupOf(pair->b_idx)) {
      pair->verdict = PairVerdict::kChance;
    } else if (!TellsPlace(*pair, a.Inverse() * b)) {
      pair->verdict = PairVerdict::kAgainstPositions;
    }
  }
}

}  // namespace enfilade
