// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Views with so many features that look in different directions.
std::vector<PanoFeatures> Features(const std::vector<int>& counts) {
  std::vector<PanoFeatures> features;
  for (const int count : counts) {
    PanoFeatures view;
    for (int i = 0; i < count; ++i) {
      view.rays.emplace_back(std::cos(0.1F * static_cast<float>(i)), 0,
                             std::sin(0.1F * static_cast<float>(i)));
    }
    features.push_back(view);
  }
  return features;
}

PanoPair Matched(int a_idx, int b_idx, const std::vector<std::pair<int, int>>& matches,
                 PairVerdict verdict = PairVerdict::kAccepted) {
  PanoPair pair;
  pair.a_idx = a_idx;
  pair.b_idx = b_idx;
  pair.verdict = verdict;
  for (const auto& [a, b] : matches) pair.inliers.push_back({a, b, 0.5F});
  return pair;
}

std::vector<std::pair<int, int>> SightsOf(const Track& track) {
  std::vector<std::pair<int, int>> sights;
  for (const Observation& observation : track.observations) {
    sights.emplace_back(observation.view_idx, observation.feature_idx);
  }
  return sights;
}

TEST(BuildTracks, ChainsMatches) {
  const std::vector<PanoPair> pairs = {Matched(0, 1, {{2, 0}, {3, 1}}), Matched(1, 2, {{0, 4}}),
                                       Matched(2, 3, {{4, 1}})};
  const std::vector<Track> tracks = BuildTracks(pairs, Features({5, 5, 5, 5}));
  ASSERT_THAT(tracks, SizeIs(2));
  EXPECT_EQ(SightsOf(tracks[0]),
            (std::vector<std::pair<int, int>>{{0, 2}, {1, 0}, {2, 4}, {3, 1}}));
  EXPECT_EQ(SightsOf(tracks[1]), (std::vector<std::pair<int, int>>{{0, 3}, {1, 1}}));
}

TEST(BuildTracks, DropsChainsThatReturnToAnotherFeature) {
  const std::vector<PanoPair> pairs = {Matched(0, 1, {{0, 0}, {1, 1}}), Matched(1, 2, {{0, 0}}),
                                       Matched(0, 2, {{2, 0}})};
  const std::vector<Track> tracks = BuildTracks(pairs, Features({3, 3, 3}));
  ASSERT_THAT(tracks, SizeIs(1));
  EXPECT_EQ(SightsOf(tracks[0]), (std::vector<std::pair<int, int>>{{0, 1}, {1, 1}}));
}

TEST(BuildTracks, KeepsOneFeatureWithTwoOrientations) {
  std::vector<PanoFeatures> features = Features({3, 3, 3});
  features[0].rays[2] = features[0].rays[0];
  const std::vector<PanoPair> pairs = {Matched(0, 1, {{0, 0}}), Matched(1, 2, {{0, 0}}),
                                       Matched(0, 2, {{2, 0}})};
  const std::vector<Track> tracks = BuildTracks(pairs, features);
  ASSERT_THAT(tracks, SizeIs(1));
  EXPECT_EQ(SightsOf(tracks[0]), (std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {2, 0}}));
}

TEST(BuildTracks, UsesAcceptedPairsOnly) {
  const std::vector<PanoFeatures> features = Features({3, 3});
  for (const PairVerdict verdict :
       {PairVerdict::kFewMatches, PairVerdict::kChance, PairVerdict::kAgainstTriplets,
        PairVerdict::kAgainstPositions}) {
    const std::vector<PanoPair> pairs = {Matched(0, 1, {{0, 0}}, verdict)};
    EXPECT_THAT(BuildTracks(pairs, features), IsEmpty());
  }
  EXPECT_THAT(BuildTracks({}, features), IsEmpty());
  EXPECT_THAT(BuildTracks({}, {}), IsEmpty());
}

TEST(BuildTracks, FindsThePointsOfAScene) {
  const RegistrationScene scene = MakeRegistrationScene({}, SpreadCameras(0.2, 3, 2.6, 5, 1));
  std::vector<PanoPair> pairs;
  for (int a = 0; a < 5; ++a) {
    for (int b = a + 1; b < 5; ++b) pairs.push_back(TruePair(scene, a, b));
  }
  const std::vector<Track> tracks = BuildTracks(pairs, scene.features);
  EXPECT_EQ(tracks.size(), TrueTracks(scene).size());
  for (size_t t = 0; t < tracks.size(); ++t) {
    const Observation& front = tracks[t].observations.front();
    const auto point_of = [&](const Observation& sight) {
      return scene.point_of_feature[static_cast<size_t>(sight.view_idx)]
                                   [static_cast<size_t>(sight.feature_idx)];
    };
    for (const Observation& sight : tracks[t].observations) {
      EXPECT_EQ(point_of(sight), point_of(front));
    }
    if (t == 0) continue;
    const Observation& before = tracks[t - 1].observations.front();
    EXPECT_LT(std::tie(before.view_idx, before.feature_idx),
              std::tie(front.view_idx, front.feature_idx));
  }
}

// Cameras in a row along x that look along z, one apart, and what each sees of some points.
class Row {
 public:
  explicit Row(std::vector<Vector3d> targets) {
    for (size_t i = 0; i < targets.size(); ++i) {
      poses.push_back({RotationZ(0.3 * static_cast<double>(i)), {static_cast<double>(i), 0, 0}});
      PanoFeatures view;
      view.rays.push_back((poses.back().Inverse() * targets[i]).normalized().cast<float>());
      features.push_back(view);
      track.observations.push_back({static_cast<int>(i), 0});
    }
  }
  bool Triangulate(const TriangulationBounds& bounds = {}) {
    return TriangulateTrack(poses, features, bounds, track);
  }
  std::vector<Rigid3> poses;
  std::vector<PanoFeatures> features;
  Track track;
};

const Vector3d kPoint(1.2, 0.4, 3);

TEST(TriangulateTrack, IsExactForTrueRays) {
  for (size_t num_views = 2; num_views <= 9; ++num_views) {
    Row row(std::vector<Vector3d>(num_views, kPoint));
    ASSERT_TRUE(row.Triangulate());
    EXPECT_LT((row.track.position - kPoint).norm(), 1e-5);  // rays are floats
    EXPECT_THAT(row.track.observations, SizeIs(num_views));
  }
}

TEST(TriangulateTrack, RemovesAFalseSight) {
  for (size_t wrong = 0; wrong < 5; ++wrong) {
    std::vector<Vector3d> targets(5, kPoint);
    targets[wrong] = {-1, 1, 2};
    Row row(targets);
    ASSERT_TRUE(row.Triangulate());
    EXPECT_LT((row.track.position - kPoint).norm(), 1e-5) << wrong;
    EXPECT_THAT(row.track.observations, SizeIs(4));
    for (const Observation& sight : row.track.observations) {
      EXPECT_NE(sight.view_idx, static_cast<int>(wrong));
    }
  }
}

TEST(TriangulateTrack, LeavesAFailedTrackAsItIs) {
  const std::vector<std::vector<Vector3d>> failures = {
      {kPoint, {-1, 2, 3}},         // two rays that do not meet
      {{5, 0, 300}, {5, 0, 300}},   // at 0.2°
      {{0, 0, 1e6}, {1, 0, 1e6}},   // parallel
      {{-20, 0, 40}, {21, 0, 40}},  // meet behind both
      {kPoint},                     // one sight
  };
  for (size_t k = 0; k < failures.size(); ++k) {
    Row row(failures[k]);
    row.track.position = {7, 8, 9};
    EXPECT_FALSE(row.Triangulate()) << k;
    EXPECT_EQ(row.track.position, Vector3d(7, 8, 9));
    EXPECT_THAT(row.track.observations, SizeIs(failures[k].size()));
  }
}

// Two cameras one apart see a point 10 ahead of their middle at 2 · atan(0.05) = 5.72°.
TEST(TriangulateTrack, BoundsTheAngleBetweenRays) {
  const std::vector<Vector3d> targets(2, Vector3d(0.5, 0, 10));
  EXPECT_TRUE(Row(targets).Triangulate({.min_angle_rad = DegToRad(5.7)}));
  EXPECT_FALSE(Row(targets).Triangulate({.min_angle_rad = DegToRad(5.8)}));
}

// The middle one of three cameras looks 1° past the point that the other two see.
TEST(TriangulateTrack, BoundsTheErrorOfRays) {
  const double past = std::tan(DegToRad(1)) * 3;
  const std::vector<Vector3d> targets = {{1, 0, 3}, {1, past, 3}, {1, 0, 3}};
  Row strict(targets), lenient(targets);
  ASSERT_TRUE(strict.Triangulate({.max_error_rad = DegToRad(0.3)}));
  EXPECT_THAT(strict.track.observations, SizeIs(2));
  EXPECT_LT((strict.track.position - targets[0]).norm(), 1e-5);
  ASSERT_TRUE(lenient.Triangulate({.max_error_rad = DegToRad(2)}));
  EXPECT_THAT(lenient.track.observations, SizeIs(3));
}

TEST(TriangulateTrack, TwoGroupsOfSightsTheLargerWins) {
  const Vector3d other(-2, 1, 2);
  Row row({kPoint, other, kPoint, other, kPoint, kPoint});
  ASSERT_TRUE(row.Triangulate());
  EXPECT_LT((row.track.position - kPoint).norm(), 1e-5);
  EXPECT_THAT(row.track.observations, SizeIs(4));
}

}  // namespace
}  // namespace enfilade
