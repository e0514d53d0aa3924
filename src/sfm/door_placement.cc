// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/door_placement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/image/image.h"
#include "enfilade/sfm/two_view.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCell_m = 0.1;
constexpr int kReach = 150;  // cells, either way
constexpr float kMinVotes = 5;
constexpr size_t kMaxTried = 4000, kNumPlaces = 400;
// Refined are, at each turn, so many places with most votes where rooms do not overlap, and of all
// those at which most is seen through a door while matches may miss by so many times more: a cell
// is wider than what refining is to reach.
constexpr size_t kNumRefined = 40;
constexpr double kWiderBound = 4;
constexpr int kApart = 2;
// Rooms that a door joins stand wall to wall: so much floor of one lies within reach of the
// other's.
constexpr double kContact_m = 0.45, kMinContact_m2 = 0.15;
constexpr std::array<double, 5> kNudges_m = {-0.1, -0.05, 0, 0.05, 0.1};
constexpr size_t kMaxJudged = 12;
constexpr int kNumRolls = 5;
constexpr double kPriorSpots = 0.5;
constexpr double kSamePlace_m = 0.6;

// Votes for the shift at one yaw, smoothed: a cell counts in full for its neighbours and half for
// theirs.
ImageF VoteForShifts(std::span<const ViewPairMatches> pairs, double yaw_rad) {
  const int size = 2 * kReach + 1;
  ImageF votes(size, size);
  for (const ViewPairMatches& pair : pairs) {
    for (size_t i = 0; i < pair.matches.size(); ++i) {
      for (const Vector2d& shift_m : ShiftsOf(pair, i, yaw_rad)) {
        const int row = static_cast<int>(std::lround(shift_m.y() / kCell_m)) + kReach;
        const int col = static_cast<int>(std::lround(shift_m.x() / kCell_m)) + kReach;
        for (int r = std::max(0, row - 2); r <= std::min(size - 1, row + 2); ++r) {
          for (int c = std::max(0, col - 2); c <= std::min(size - 1, col + 2); ++c) {
            votes(r, c) += std::max(std::abs(r - row), std::abs(c - col)) < 2 ? 1.0F : 0.5F;
          }
        }
      }
    }
  }
  return votes;
}

bool IsPossible(const ComponentFloor& a, const ComponentFloor& b, const Placement& placement) {
  return a.SharedArea_m2(b, placement.Transform(), kContact_m) > kMinContact_m2;
}

// The possible places with the most votes for a shift at one yaw.
std::vector<Placement> BestPlaces(const ImageF& votes, double yaw_rad, size_t num_places,
                                  const std::function<bool(const Placement&)>& is_possible) {
  std::vector<int> order;
  for (int i = 0; i < static_cast<int>(votes.data().size()); ++i) {
    if (votes.data()[static_cast<size_t>(i)] >= kMinVotes) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) {
    return votes.data()[static_cast<size_t>(x)] > votes.data()[static_cast<size_t>(y)];
  });
  order.resize(std::min(order.size(), kMaxTried));
  std::vector<Placement> places;
  for (const int i : order) {
    const Vector2d shift_m =
        kCell_m * Vector2d(i % votes.cols() - kReach, i / votes.cols() - kReach);
    const bool is_near = std::any_of(places.begin(), places.end(), [&](const Placement& place) {
      return (place.shift_m - shift_m).cwiseAbs().maxCoeff() < (kApart - 0.5) * kCell_m;
    });
    if (is_near || !is_possible({yaw_rad, shift_m})) continue;
    places.push_back({yaw_rad, shift_m});
    if (places.size() == num_places) break;
  }
  return places;
}

// Those of some places at which most is seen through a door, roughly.
std::vector<Placement> MostPromising(std::span<const Placement> places,
                                     std::span<const ViewPairMatches> pairs, double bound_rad) {
  std::vector<int> num_spots;
  for (const Placement& place : places) {
    num_spots.push_back(LookThroughDoor(pairs, place, kWiderBound * bound_rad).num_spots);
  }
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t x, size_t y) { return num_spots[x] > num_spots[y]; });
  order.resize(std::min(order.size(), kNumRefined));
  std::vector<Placement> best;
  for (const size_t i : order) best.push_back(places[i]);
  return best;
}

// The places to refine at one yaw.
std::vector<Placement> PlacesToRefine(std::span<const ViewPairMatches> pairs, double yaw_rad,
                                      const ComponentFloor& a, const ComponentFloor& b,
                                      double bound_rad) {
  const ImageF votes = VoteForShifts(pairs, yaw_rad);
  const auto is_possible = [&](const Placement& place) { return IsPossible(a, b, place); };
  const auto is_apart = [&](const Placement& place) {
    return is_possible(place) && a.OverlapShare(b, place.Transform()) <= kMaxOverlap;
  };
  std::vector<Placement> places = BestPlaces(votes, yaw_rad, kNumRefined, is_apart);
  const std::vector<Placement> anywhere =
      MostPromising(BestPlaces(votes, yaw_rad, kNumPlaces, is_possible), pairs, bound_rad);
  places.insert(places.end(), anywhere.begin(), anywhere.end());
  return places;
}

double MissOf(const ViewPairMatches& pair, size_t match, const Placement& placement) {
  const Rigid3 transform = placement.Transform();
  const Vector3d baseline = transform * pair.b.position - pair.a.position;
  return EpipolarError({transform.rotation, baseline.normalized()}, pair.rays_a[match].ray,
                       pair.rays_b[match].ray);
}

// One Gauss–Newton step over yaw and shift on the matches that agree, with Cauchy's loss.
Placement Refined(const Placement& placement, std::span<const ViewPairMatches> pairs,
                  const DoorSight& sight, double bound_rad) {
  constexpr double kStep = 1e-6;
  // The walls say the yaw to about 0.3°, and outlines the shift to about 10 cm.
  constexpr double kYawSigma_rad = DegToRad(0.3), kShiftSigma_m = 0.1;
  const double scale = bound_rad / 3;
  Eigen::Matrix3d normal =
      Vector3d(1 / (kYawSigma_rad * kYawSigma_rad), 1 / (kShiftSigma_m * kShiftSigma_m),
               1 / (kShiftSigma_m * kShiftSigma_m))
          .asDiagonal();
  Vector3d gradient = Vector3d::Zero();
  for (size_t p = 0; p < pairs.size(); ++p) {
    for (const size_t match : sight.inliers[p]) {
      const double residual = MissOf(pairs[p], match, placement) / scale;
      Vector3d row;
      for (int k = 0; k < 3; ++k) {
        Placement moved = placement;
        (k == 0 ? moved.yaw_rad : moved.shift_m[k - 1]) += kStep;
        row[k] = (MissOf(pairs[p], match, moved) / scale - residual) / kStep;
      }
      const double weight = 1 / (1 + residual * residual);
      normal += weight * row * row.transpose();
      gradient += weight * residual * row;
    }
  }
  const Vector3d step = -normal.ldlt().solve(gradient);
  return {placement.yaw_rad + step[0], placement.shift_m + step.tail<2>()};
}

bool IsBetter(const DoorSight& x, const DoorSight& y) {
  const auto num_inliers = [](const DoorSight& sight) {
    size_t sum = 0;
    for (const auto& inliers : sight.inliers) sum += inliers.size();
    return sum;
  };
  if (x.num_spots != y.num_spots) return x.num_spots > y.num_spots;
  return num_inliers(x) > num_inliers(y);
}

// The best placement about a place: nudged, then refined for as long as that helps.
JudgedPlacement Settle(const Placement& place, size_t turn, std::span<const ViewPairMatches> pairs,
                       double bound_rad) {
  constexpr int kMaxSteps = 5;
  JudgedPlacement best{place, turn, LookThroughDoor(pairs, place, bound_rad)};
  const auto keep_if_better = [&](const Placement& placement) {
    const DoorSight sight = LookThroughDoor(pairs, placement, bound_rad);
    if (!IsBetter(sight, best.sight)) return false;
    best = {placement, turn, sight};
    return true;
  };
  for (const double x_m : kNudges_m) {
    for (const double y_m : kNudges_m) {
      keep_if_better({place.yaw_rad, place.shift_m + Vector2d(x_m, y_m)});
    }
  }
  for (int i = 0; i < kMaxSteps; ++i) {
    if (!keep_if_better(Refined(best.placement, pairs, best.sight, bound_rad))) break;
  }
  return best;
}

double LogOdds(std::span<const ViewPairMatches> pairs, const JudgedPlacement& judged,
               double bound_rad) {
  double by_chance = kPriorSpots;
  for (int roll = 1; roll <= kNumRolls; ++roll) {
    by_chance += static_cast<double>(
                     LookThroughDoor(pairs, judged.placement, bound_rad, 4 * roll - 1).num_spots) /
                 kNumRolls;
  }
  const double spots = judged.sight.num_spots;
  return spots > by_chance ? spots * std::log(spots / by_chance) - (spots - by_chance) : 0;
}

bool IsSame(const Placement& x, const Placement& y) {
  return (x.shift_m - y.shift_m).norm() < kSamePlace_m &&
         std::abs(WrapPi(x.yaw_rad - y.yaw_rad)) < kPi / 4;
}

// Of placements, best first, the first of each place.
std::vector<JudgedPlacement> DifferentPlaces(std::span<const JudgedPlacement> judged) {
  std::vector<JudgedPlacement> different;
  for (const JudgedPlacement& one : judged) {
    if (different.size() == kMaxJudged) break;
    const bool is_known = std::any_of(
        different.begin(), different.end(),
        [&](const JudgedPlacement& other) { return IsSame(one.placement, other.placement); });
    if (!is_known) different.push_back(one);
  }
  return different;
}

// Where one component covers so much of the smaller one's floor (OverlapShare).
double LogOddsNeeded(double overlap_share, const JoinOptions& options) {
  return overlap_share > kMaxOverlap ? options.min_log_odds_overlapping : options.min_log_odds;
}

}  // namespace

std::optional<JudgedPlacement> FindDoorPlacement(const TurnedMatches& matches,
                                                 const ComponentFloor& a, const ComponentFloor& b,
                                                 const JoinOptions& options, RunContext& context) {
  const double bound_rad = DegToRad(options.inlier_deg);
  std::array<std::vector<Placement>, 4> of_turn;
  ParallelFor(context, "", 4, [&](int64_t i) {
    const size_t turn = static_cast<size_t>(i);
    const double yaw_rad = static_cast<double>(turn) * kPi / 2;
    of_turn[turn] = PlacesToRefine(matches[turn], yaw_rad, a, b, bound_rad);
  });
  struct Place {
    Placement placement;
    size_t turn;
  };
  std::vector<Place> places;
  for (size_t turn = 0; turn < of_turn.size(); ++turn) {
    for (const Placement& placement : of_turn[turn]) places.push_back({placement, turn});
  }
  if (places.empty()) return std::nullopt;

  std::vector<JudgedPlacement> judged(places.size());
  ParallelFor(context, "", static_cast<int64_t>(places.size()), [&](int64_t i) {
    const auto& [placement, turn] = places[static_cast<size_t>(i)];
    judged[static_cast<size_t>(i)] = Settle(placement, turn, matches[turn], bound_rad);
  });
  std::erase_if(judged,
                [&](const JudgedPlacement& one) { return !IsPossible(a, b, one.placement); });
  std::stable_sort(judged.begin(), judged.end(),
                   [](const JudgedPlacement& x, const JudgedPlacement& y) {
                     return IsBetter(x.sight, y.sight);
                   });
  judged = DifferentPlaces(judged);
  for (JudgedPlacement& one : judged) {
    one.log_odds = LogOdds(matches[one.turn], one, bound_rad);
  }
  std::stable_sort(
      judged.begin(), judged.end(),
      [](const JudgedPlacement& x, const JudgedPlacement& y) { return x.log_odds > y.log_odds; });
  if (judged.empty()) return std::nullopt;
  const JudgedPlacement& best = judged.front();
  if (best.log_odds < LogOddsNeeded(a.OverlapShare(b, best.placement.Transform()), options)) {
    return std::nullopt;
  }
  if (judged.size() > 1 && judged[1].log_odds > options.max_rival_share * best.log_odds) {
    return std::nullopt;
  }
  return best;
}

}  // namespace enfilade
