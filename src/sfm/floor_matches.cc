// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/floor_matches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "enfilade/base/check.h"
#include "enfilade/base/median.h"
#include "enfilade/geometry/angles.h"
#include "src/sfm/level_rays.h"
#include "src/sfm/wall_matches.h"
#include "src/sfm/wall_view.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2i;
using Eigen::Vector3d;

constexpr int kReach = FloorPicture::kReach;
constexpr double kMinDigits = 3;
constexpr int kSpotSpacing_px = 20, kSpotHalf_px = 8, kSpotReach_px = 4;
constexpr double kMinSpotCorrelation = 0.6;
// Of a spot's square contrast; plain ones have no place.
constexpr double kMinSpotContrast = 0.2 * FloorPicture::kScale * FloorPicture::kScale;
// Of spots at a place that is known.
constexpr double kMinHeight = 0.2;  // of a camera that stands on the floor
constexpr double kMaxStep_px = 300, kAgreement_px = 1.5;
// Spots that have to agree, and their share of all that look alike: of a dozen that do so by chance
// half may agree.
struct Agreement {
  double count = 0, share = 0;
};
constexpr Agreement kAtPlace{8, 0.7}, kAside{10, 0.8};
// Rooms that few features tie may stand a quarter of a metre off.
constexpr int kStepsAbout = 2;
constexpr double kStepAbout_px = 6;

constexpr int kSpotSide = 2 * kSpotHalf_px + 1, kPlaces = 2 * kSpotReach_px + 1;
constexpr int kWindowHalf_px = kSpotHalf_px + kSpotReach_px, kWindowSide = 2 * kWindowHalf_px + 1;

// A square of a turned floor about a pixel, row by row.
template <int kHalf>
std::array<float, (2 * kHalf + 1) * (2 * kHalf + 1)> CutOut(const FloorPicture& floor,
                                                            const Vector2i& at, int turn) {
  std::array<float, (2 * kHalf + 1) * (2 * kHalf + 1)> square{};
  size_t k = 0;
  for (int r = -kHalf; r <= kHalf; ++r) {
    for (int c = -kHalf; c <= kHalf; ++c) {
      const Vector2i from = Unturned(Vector2i(at + Vector2i(c, r)), turn);
      square[k++] = floor.contrast(from.y() + kReach, from.x() + kReach);
    }
  }
  return square;
}

using Spot = std::array<float, kSpotSide * kSpotSide>;
using Window = std::array<float, kWindowSide * kWindowSide>;

// Of a spot and the part of a window whose corner lies so; 0 where that is plain.
double Correlation(const Spot& spot, double spot_squares, const Window& window, int row, int col) {
  float products = 0, squares = 0;
  for (int r = 0; r < kSpotSide; ++r) {
    const float* in_spot = spot.data() + r * kSpotSide;
    const float* in_window = window.data() + (row + r) * kWindowSide + col;
    for (int c = 0; c < kSpotSide; ++c) {
      products += in_spot[c] * in_window[c];
      squares += in_window[c] * in_window[c];
    }
  }
  if (squares < kMinSpotContrast * kSpotSide * kSpotSide) return 0;
  return products / std::sqrt(spot_squares * squares);
}

bool IsAllShown(const Vector2i& at, int margin_px) {
  const double distance = at.cast<double>().norm();
  return distance - margin_px > FloorPicture::kNearest && distance + margin_px < kReach;
}

// Where between −1 and 1 a parabola through three values has its top.
double Top(double before, double at, double after) {
  const double bend = before - 2 * at + after;
  return bend < 0 ? 0.5 * (before - after) / bend : 0;
}

std::optional<FloorSpot> FindSpot(const FloorPicture& a, const Vector2i& at_a,
                                  const FloorPicture& b, const Vector2i& expected, int turn) {
  const Spot spot_pixels = CutOut<kSpotHalf_px>(a, at_a, 0);
  double squares = 0;
  for (const float value : spot_pixels) squares += value * value;
  if (squares < kMinSpotContrast * kSpotSide * kSpotSide) return std::nullopt;
  const Window window = CutOut<kWindowHalf_px>(b, expected, turn);
  std::array<std::array<double, kPlaces>, kPlaces> values{};
  int best_row = 0, best_col = 0;
  for (int r = 0; r < kPlaces; ++r) {
    for (int c = 0; c < kPlaces; ++c) {
      double& value = values[static_cast<size_t>(r)][static_cast<size_t>(c)];
      value = Correlation(spot_pixels, squares, window, r, c);
      if (value > values[static_cast<size_t>(best_row)][static_cast<size_t>(best_col)]) {
        best_row = r;
        best_col = c;
      }
    }
  }
  const size_t r = static_cast<size_t>(best_row), c = static_cast<size_t>(best_col);
  const bool is_inside = std::clamp(best_row, 1, kPlaces - 2) == best_row &&
                         std::clamp(best_col, 1, kPlaces - 2) == best_col;
  if (!is_inside || values[r][c] < kMinSpotCorrelation) return std::nullopt;
  const double row = expected.y() + best_row - kSpotReach_px +
                     Top(values[r - 1][c], values[r][c], values[r + 1][c]);
  const double col = expected.x() + best_col - kSpotReach_px +
                     Top(values[r][c - 1], values[r][c], values[r][c + 1]);
  FloorSpot spot{at_a.cast<double>(), Vector2d(col, row)};
  spot.b_px = Unturned(spot.b_px, turn);
  return spot;
}

Eigen::Vector3f RayOfSpot(const Vector2d& at_px, const Gravity& gravity) {
  const Vector2d at = at_px / FloorPicture::kPixelsPerHeight;
  return (CamFromWalls(gravity) * WallViewFrame(kFloorWallView) * Vector3d(at.x(), at.y(), 1))
      .normalized()
      .cast<float>();
}

std::vector<FeatureMatch> AddSpots(std::span<const FloorSpot> spots, const Gravity& gravity_a,
                                   const Gravity& gravity_b, PanoFeatures& a, PanoFeatures& b) {
  std::vector<FeatureMatch> matches;
  for (const FloorSpot& spot : spots) {
    matches.push_back({a.size(), b.size()});
    a.rays.push_back(RayOfSpot(spot.a_px, gravity_a));
    b.rays.push_back(RayOfSpot(spot.b_px, gravity_b));
  }
  return matches;
}

FloorPlace PlaceByPoses(const Rigid3& pose_a, const Rigid3& pose_b, const Gravity& gravity_a,
                        const Gravity& gravity_b) {
  PanoPair standing;
  SetGeometry(pose_a, pose_b, gravity_a, gravity_b, standing);
  const double height_a = pose_a.translation.z(), height_b = pose_b.translation.z();
  const double length = (pose_b.translation - pose_a.translation).norm();
  const Vector3d step = RotationZ(-*gravity_a.heading_rad) * (length * standing.direction);
  const Vector3d in_picture = WallViewFrame(kFloorWallView).transpose() * step;
  return {TurnOfYaw(gravity_a, gravity_b, standing.Yaw_rad()),
          FloorPicture::kPixelsPerHeight / height_a * in_picture.head<2>(), height_a / height_b, 0};
}

// Those of the spots that miss a place alike; empty where they are few.
std::vector<FloorSpot> SpotsThatAgree(std::vector<FloorSpot> spots, const FloorPlace& place,
                                      const Agreement& least) {
  if (spots.empty()) return {};
  const double num_alike = static_cast<double>(spots.size());
  const auto miss = [&](const FloorSpot& spot) -> Vector2d {
    return spot.b_px - Unturned(Vector2d(place.scale * (spot.a_px - place.step_px)), place.turn);
  };
  std::vector<double> x, y;
  for (const FloorSpot& spot : spots) {
    x.push_back(miss(spot).x());
    y.push_back(miss(spot).y());
  }
  const Vector2d middle(UpperMedian(x), UpperMedian(y));
  std::erase_if(
      spots, [&](const FloorSpot& spot) { return (miss(spot) - middle).norm() > kAgreement_px; });
  const double num_agreeing = static_cast<double>(spots.size());
  const bool is_few = num_agreeing < least.count || num_agreeing < least.share * num_alike;
  if (is_few) spots.clear();
  return spots;
}

// Steps to look at about one that poses tell, the nearest first.
std::vector<Vector2d> StepsAbout() {
  std::vector<Vector2d> steps;
  for (int y = -kStepsAbout; y <= kStepsAbout; ++y) {
    for (int x = -kStepsAbout; x <= kStepsAbout; ++x) {
      steps.emplace_back(kStepAbout_px * x, kStepAbout_px * y);
    }
  }
  std::stable_sort(steps.begin(), steps.end(), [](const Vector2d& p, const Vector2d& q) {
    return p.squaredNorm() < q.squaredNorm();
  });
  return steps;
}

// Spots of two floors whose place is about known: of what repeats the nearest place counts.
std::vector<FloorSpot> SpotsAbout(const FloorPicture& a, const FloorPicture& b,
                                  const FloorPlace& place) {
  for (const Vector2d& step : StepsAbout()) {
    FloorPlace tried = place;
    tried.step_px += step;
    std::vector<FloorSpot> spots =
        SpotsThatAgree(FindFloorSpots(a, b, tried), tried, step.isZero() ? kAtPlace : kAside);
    if (!spots.empty()) return spots;
  }
  return {};
}

FloorMatch MakeMatch(const ViewPair& pair, const FloorPlace& place, const Gravity& gravity_a,
                     const Gravity& gravity_b) {
  const Vector2d step = place.step_px / FloorPicture::kPixelsPerHeight;
  const Vector3d in_walls = WallViewFrame(kFloorWallView) * Vector3d(step.x(), step.y(), 0);
  const Vector3d level = RotationZ(*gravity_a.heading_rad) * in_walls;
  return {pair.a_idx,
          pair.b_idx,
          WrapPi(*gravity_a.heading_rad - *gravity_b.heading_rad - place.turn * kPi / 2),
          level.head<2>(),
          place.digits,
          {}};
}

}  // namespace

std::vector<FloorSpot> FindFloorSpots(const FloorPicture& a, const FloorPicture& b,
                                      const FloorPlace& place) {
  std::vector<FloorSpot> spots;
  for (int r = -kReach; r <= kReach; r += kSpotSpacing_px) {
    for (int c = -kReach; c <= kReach; c += kSpotSpacing_px) {
      const Vector2d expected = place.scale * (Vector2d(c, r) - place.step_px);
      const Vector2i at_a(c, r), at_b = expected.array().round().matrix().cast<int>();
      constexpr int kMargin = 2 * kSpotHalf_px;
      if (!IsAllShown(at_a, kMargin) || !IsAllShown(at_b, kMargin + kSpotReach_px)) continue;
      const std::optional<FloorSpot> spot = FindSpot(a, at_a, b, at_b, place.turn);
      if (spot) spots.push_back(*spot);
    }
  }
  return spots;
}

int MatchFloorsAgain(std::span<const FloorPicture> floors, std::span<const Gravity> gravity,
                     RunContext& context, Registration& registration,
                     std::vector<PanoFeatures>& features) {
  std::vector<PanoPair*> pairs;
  std::vector<FloorPlace> places;
  for (PanoPair& pair : registration.pairs) {
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    const bool is_one = registration.component_idx[a] == registration.component_idx[b];
    const bool is_known = !floors[a].contrast.empty() && !floors[b].contrast.empty();
    const bool is_standing = std::min(registration.world_from_cam[a].translation.z(),
                                      registration.world_from_cam[b].translation.z()) > kMinHeight;
    if (!is_one || !is_known || !is_standing || pair.verdict == PairVerdict::kSamePlace) continue;
    const FloorPlace place = PlaceByPoses(registration.world_from_cam[a],
                                          registration.world_from_cam[b], gravity[a], gravity[b]);
    if (place.step_px.norm() > kMaxStep_px) continue;
    pairs.push_back(&pair);
    places.push_back(place);
  }
  std::vector<std::vector<FloorSpot>> spots(pairs.size());
  ParallelFor(context, "match floors again", static_cast<int64_t>(pairs.size()), [&](int64_t k) {
    const PanoPair& pair = *pairs[static_cast<size_t>(k)];
    const FloorPlace& place = places[static_cast<size_t>(k)];
    spots[static_cast<size_t>(k)] = SpotsAbout(floors[static_cast<size_t>(pair.a_idx)],
                                               floors[static_cast<size_t>(pair.b_idx)], place);
  });
  int num_pairs = 0;
  for (size_t k = 0; k < pairs.size(); ++k) {
    PanoPair& pair = *pairs[k];
    const size_t a = static_cast<size_t>(pair.a_idx), b = static_cast<size_t>(pair.b_idx);
    if (spots[k].empty()) continue;
    ++num_pairs;
    if (pair.verdict != PairVerdict::kAccepted) {
      pair.inliers.clear();
      pair.verdict = PairVerdict::kAccepted;
      SetGeometry(registration.world_from_cam[a], registration.world_from_cam[b], gravity[a],
                  gravity[b], pair);
    }
    // Spots of a match before are found anew.
    std::erase_if(pair.inliers, [&](const FeatureMatch& match) {
      return match.a_idx >= features[a].descriptors.size();
    });
    const std::vector<FeatureMatch> added =
        AddSpots(spots[k], gravity[a], gravity[b], features[a], features[b]);
    pair.inliers.insert(pair.inliers.end(), added.begin(), added.end());
  }
  return num_pairs;
}

std::vector<FloorMatch> MatchFloors(std::span<const FloorPicture> floors,
                                    std::span<const ViewPair> pairs,
                                    std::span<const Gravity> gravity, RunContext& context,
                                    std::vector<PanoFeatures>& features) {
  ENFILADE_CHECK(floors.size() == features.size() && gravity.size() == features.size());
  const std::vector<FloorPlace> places = PlaceFloors(floors, pairs, context);
  std::vector<FloorMatch> matches;
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (places[k].digits < kMinDigits) continue;
    const size_t a = static_cast<size_t>(pairs[k].a_idx), b = static_cast<size_t>(pairs[k].b_idx);
    FloorMatch match = MakeMatch(pairs[k], places[k], gravity[a], gravity[b]);
    match.spots = AddSpots(FindFloorSpots(floors[a], floors[b], places[k]), gravity[a], gravity[b],
                           features[a], features[b]);
    matches.push_back(std::move(match));
  }
  return matches;
}

}  // namespace enfilade
