// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/two_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d RandomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// A pair of cameras in one room and what the estimate should be.
struct MadePair {
  MadePair(const MadeSceneOptions& options, const MadeCamera& a, const MadeCamera& b)
      : scene(MakeRegistrationScene(options, std::vector{a, b})),
        rays_a(LevelRaysOf(scene, 0)),
        rays_b(LevelRaysOf(scene, 1)),
        truth(TruePair(scene, 0, 1)) {}

  // The first `num_true` true matches and so many of random features.
  [[nodiscard]] std::vector<FeatureMatch> Matches(size_t num_true, size_t num_false,
                                                  uint32_t seed) const {
    std::vector<FeatureMatch> matches = truth.inliers;
    matches.resize(std::min(num_true, matches.size()));
    std::mt19937 random(seed);
    for (size_t i = 0; i < num_false; ++i) {
      matches.push_back({static_cast<int>(random() % rays_a.size()),
                         static_cast<int>(random() % rays_b.size()), 0.5F});
    }
    std::sort(matches.begin(), matches.end(), [](const FeatureMatch& x, const FeatureMatch& y) {
      return std::pair(x.a_idx, x.b_idx) < std::pair(y.a_idx, y.b_idx);
    });
    return matches;
  }
  [[nodiscard]] PanoPair Estimate(const std::vector<FeatureMatch>& matches,
                                  const TwoViewOptions& options = {}) const {
    return EstimatePair(rays_a, rays_b, matches, options);
  }
  void ExpectNear(const PanoPair& pair, double max_deg, const std::string& what) const {
    EXPECT_EQ(pair.verdict, PairVerdict::kAccepted) << what;
    EXPECT_LT(RadToDeg(TurnBetween(pair.a_from_b, truth.a_from_b)), max_deg) << what;
    EXPECT_LT(RadToDeg(AngleBetween(pair.direction, truth.direction)), max_deg) << what;
  }

  RegistrationScene scene;
  std::vector<Vector3d> rays_a, rays_b;
  PanoPair truth;
};

const MadeCamera kCameraA{{0.8, 0.9}, 0.3, 1, {0, 0}};
const MadeCamera kCameraB{{2.3, 1.6}, -2.0, 1, {0, 0}};

TEST(EstimatePair, IsExactWithoutNoise) {
  const MadePair made({}, kCameraA, kCameraB);
  const PanoPair pair = made.Estimate(made.truth.inliers);
  made.ExpectNear(pair, 1e-3, "no noise");
  EXPECT_EQ(pair.inliers, made.truth.inliers);
  EXPECT_EQ(pair.num_matches, static_cast<int>(made.truth.inliers.size()));
  EXPECT_LT(pair.log10_chance, -50);
  EXPECT_NEAR(pair.Yaw_rad(), -2.3, 1e-4);
  EXPECT_EQ(pair.length, 0);
}

TEST(EstimatePair, MedianParallaxIsThatOfTheRays) {
  const MadePair made({}, kCameraA, kCameraB);
  const PanoPair pair = made.Estimate(made.truth.inliers);
  std::vector<double> parallaxes;
  for (const FeatureMatch& match : made.truth.inliers) {
    const auto& of_a = made.scene.point_of_feature[0];
    const Vector3d& point =
        made.scene.points[static_cast<size_t>(of_a[static_cast<size_t>(match.a_idx)])];
    parallaxes.push_back(AngleBetween(point - made.scene.world_from_cam[0].translation,
                                      point - made.scene.world_from_cam[1].translation));
  }
  std::sort(parallaxes.begin(), parallaxes.end());
  EXPECT_NEAR(pair.parallax_rad, parallaxes[parallaxes.size() / 2], 0.01);
}

// 100 rays that err by 0.1° at about 30° of parallax tell directions to some hundredths of a
// degree.
TEST(EstimatePair, StandsNoise) {
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    const MadePair made({.noise_rad = DegToRad(0.1), .seed = seed}, kCameraA, kCameraB);
    made.ExpectNear(made.Estimate(made.Matches(100, 0, seed)), 0.2, "seed " + std::to_string(seed));
  }
}

TEST(EstimatePair, StandsFalseMatches) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const MadePair made({.noise_rad = DegToRad(0.05), .seed = seed}, kCameraA, kCameraB);
    for (const size_t num_false : {50u, 120u, 200u}) {  // 50, 71 and 80 %
      const PanoPair pair = made.Estimate(made.Matches(50, num_false, seed));
      made.ExpectNear(pair, 1.0, std::to_string(num_false) + " false");
      // All true ones, and of the false ones few: 1 % lie within 0.5° of their plane.
      EXPECT_GE(pair.inliers.size(), 48u);
      EXPECT_LE(pair.inliers.size(), 50 + num_false / 20);
    }
  }
}

// The points of one wall, of the floor or of the ceiling alone.
TEST(EstimatePair, OnePlaneIsEnough) {
  const MadePair made({.num_points_per_room = 1000, .noise_rad = DegToRad(0.05)}, kCameraA,
                      kCameraB);
  const auto is_on_plane = [&](const FeatureMatch& match, int axis, double at) {
    const int point_idx = made.scene.point_of_feature[0][static_cast<size_t>(match.a_idx)];
    return made.scene.points[static_cast<size_t>(point_idx)][axis] == at;
  };
  for (const auto& [axis, at] : {std::pair{1, 2.6}, {2, 0.0}, {2, 1.7}}) {
    std::vector<FeatureMatch> matches = made.truth.inliers;
    std::erase_if(matches, [&](const FeatureMatch& m) { return !is_on_plane(m, axis, at); });
    made.ExpectNear(made.Estimate(matches), 0.5, "axis " + std::to_string(axis));
  }
}

// Turned about, one ray of a match stays in the plane of both and meets the other behind its
// camera.
TEST(EstimatePair, WhatMeetsBehindACameraDoesNotAgree) {
  MadePair made({}, kCameraA, kCameraB);
  std::vector<FeatureMatch> expected;
  for (size_t i = 0; i < made.truth.inliers.size(); ++i) {
    const FeatureMatch& match = made.truth.inliers[i];
    if (i % 6 == 0) {
      made.rays_a[static_cast<size_t>(match.a_idx)] *= -1;
    } else if (i % 6 == 3) {
      made.rays_b[static_cast<size_t>(match.b_idx)] *= -1;
    } else {
      expected.push_back(match);
    }
  }
  const PanoPair pair = made.Estimate(made.truth.inliers);
  made.ExpectNear(pair, 0.01, "a third behind");
  EXPECT_EQ(pair.inliers, expected);
}

TEST(EstimatePair, OpposedCamerasAreTurnedAndPlacedRight) {
  for (int turn = 0; turn < 4; ++turn) {
    for (int side = 0; side < 4; ++side) {
      const Eigen::Vector2d offset =
          0.8 * Eigen::Vector2d(std::cos(side * kPi / 2), std::sin(side * kPi / 2));
      const Eigen::Vector2d middle(1.6, 1.3);
      const MadePair made({}, {middle - offset / 2, 0, 1, {0, 0}},
                          {middle + offset / 2, turn * kPi / 2, 1, {0, 0}});
      made.ExpectNear(made.Estimate(made.Matches(80, 0, 1)), 0.01,
                      std::to_string(turn) + " quarters, side " + std::to_string(side));
    }
  }
}

// Both find the minimum of nearly the same sum; the priors look at one frame each.
TEST(EstimatePair, SwappingTheViewsInvertsTheResult) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    const MadePair made({.noise_rad = DegToRad(0.05), .seed = seed}, kCameraA, kCameraB);
    const PanoPair pair = made.Estimate(made.truth.inliers);
    std::vector<FeatureMatch> back;
    for (const FeatureMatch& m : made.truth.inliers) back.push_back({m.b_idx, m.a_idx, 0});
    const PanoPair inverse = EstimatePair(made.rays_b, made.rays_a, back, {});
    EXPECT_EQ(inverse.verdict, PairVerdict::kAccepted);
    EXPECT_LT(RadToDeg(TurnBetween(inverse.a_from_b.transpose(), pair.a_from_b)), 0.02) << seed;
    EXPECT_LT(RadToDeg(AngleBetween(-(pair.a_from_b * inverse.direction), pair.direction)), 0.02)
        << seed;
  }
}

TEST(EstimatePair, LeansWithinThePriorOfTheVerticals) {
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    MadeCamera a = kCameraA, b = kCameraB;
    a.tilt_rad = {DegToRad(4), DegToRad(-2)};
    b.tilt_rad = {DegToRad(-3), DegToRad(5)};
    const MadePair made(
        {.noise_rad = DegToRad(0.05), .gravity_noise_rad = DegToRad(0.3), .seed = seed}, a, b);
    made.ExpectNear(made.Estimate(made.Matches(150, 30, seed)), 0.3,
                    "seed " + std::to_string(seed));
  }
}

TEST(EstimatePair, TheOptionsTellHowFreelyAPairLeansAndClimbs) {
  MadeCamera b = kCameraB;
  b.height = 1.1;
  const MadePair made({.noise_rad = DegToRad(0.05), .gravity_noise_rad = DegToRad(1)}, kCameraA, b);
  const PanoPair stiff =
      made.Estimate(made.Matches(40, 0, 1), {.tilt_sigma_deg = 0.01, .climb_sigma_deg = 0.01});
  EXPECT_LT(RadToDeg(AngleBetween(stiff.a_from_b.col(2), Vector3d::UnitZ())), 0.1);
  EXPECT_LT(RadToDeg(std::asin(std::abs(stiff.direction.z()))), 0.1);
  made.ExpectNear(
      made.Estimate(made.Matches(40, 0, 1), {.tilt_sigma_deg = 5, .climb_sigma_deg = 20}), 0.3,
      "free");
}

// 0.3 m over 2 m is a slope of 8.5°, almost three times what the options expect.
TEST(EstimatePair, CamerasOfDifferentHeights) {
  for (const double climb : {0.2, -0.2}) {
    MadeCamera b = kCameraB;
    b.at = {2.0, 1.5};
    b.height = 1 + climb;
    const MadePair made({.noise_rad = DegToRad(0.05)}, kCameraA, b);
    made.ExpectNear(made.Estimate(made.Matches(150, 50, 1)), 0.3, "climb " + std::to_string(climb));
  }
}

TEST(EstimatePair, ARotationAloneIsTheSamePlace) {
  for (const double yaw : {0.0, 1.0, kPi, -2.5}) {
    const MadePair made({.noise_rad = DegToRad(0.05)}, {{1, 1}, 0.4, 1, {0, 0}},
                        {{1, 1}, 0.4 + yaw, 1, {0, 0}});
    const PanoPair pair = made.Estimate(made.Matches(100, 30, 1));
    EXPECT_EQ(pair.verdict, PairVerdict::kSamePlace) << yaw;
    EXPECT_LT(RadToDeg(std::abs(WrapPi(pair.Yaw_rad() - yaw))), 0.3) << yaw;
  }
}

// What EstimatePair may say of features that have nothing to do with each other. Either all over
// the sphere, or as in homes: most near the horizon and many on few things.
std::vector<Vector3d> UnrelatedRays(int count, bool is_clustered, std::mt19937& random) {
  std::vector<Vector3d> things;
  for (int i = 0; i < 12; ++i) {
    Vector3d thing = RandomDirection(random);
    thing.z() *= 0.3;
    things.push_back(thing.normalized());
  }
  std::vector<Vector3d> rays;
  for (int i = 0; i < count; ++i) {
    const Vector3d ray = RandomDirection(random);
    const Vector3d near = things[random() % things.size()] + 0.05 * ray;
    rays.push_back(is_clustered ? near.normalized() : ray);
  }
  return rays;
}

int NumAccepted(int num_seeds, int num_matches, bool is_clustered) {
  int num_accepted = 0;
  for (int seed = 1; seed <= num_seeds; ++seed) {
    std::mt19937 random(static_cast<uint32_t>(seed));
    std::vector<FeatureMatch> matches;
    for (int i = 0; i < num_matches; ++i) matches.push_back({i, i, 0.5F});
    const std::vector<Vector3d> a = UnrelatedRays(num_matches, is_clustered, random);
    const std::vector<Vector3d> b = UnrelatedRays(num_matches, is_clustered, random);
    const PairVerdict verdict = EstimatePair(a, b, matches, {}).verdict;
    num_accepted += verdict == PairVerdict::kAccepted || verdict == PairVerdict::kSamePlace;
  }
  return num_accepted;
}

TEST(EstimatePair, UnrelatedFeaturesAreNeverAccepted) {
  EXPECT_EQ(NumAccepted(60, 30, false), 0);
  EXPECT_EQ(NumAccepted(40, 100, false), 0);
}

TEST(EstimatePair, UnrelatedThingsAreNeverAccepted) {
  EXPECT_EQ(NumAccepted(60, 30, true), 0);
  EXPECT_EQ(NumAccepted(40, 100, true), 0);
}

// Few unrelated things, each with a dozen features within half a degree that are matched alike: any
// pose that five of them allow has sixty agreeing matches.
TEST(EstimatePair, FewThingsWithManyFeaturesAreNoEvidence) {
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    std::vector<Vector3d> a = UnrelatedRays(10, false, random);
    std::vector<Vector3d> b = UnrelatedRays(10, false, random);
    for (int thing = 0; thing < 5; ++thing) {
      const Vector3d in_a = RandomDirection(random), in_b = RandomDirection(random);
      for (int i = 0; i < 12; ++i) {
        a.push_back((in_a + DegToRad(0.3) * RandomDirection(random)).normalized());
        b.push_back((in_b + DegToRad(0.3) * RandomDirection(random)).normalized());
      }
    }
    std::vector<FeatureMatch> matches;
    for (int i = 0; i < static_cast<int>(a.size()); ++i) matches.push_back({i, i, 0.5F});
    EXPECT_NE(EstimatePair(a, b, matches, {}).verdict, PairVerdict::kAccepted) << "seed " << seed;
  }
}

TEST(EstimatePair, FewMatchesSayNothing) {
  const MadePair made({}, kCameraA, kCameraB);
  for (const size_t count : {0u, 1u, 7u}) {
    const PanoPair pair = made.Estimate(made.Matches(count, 0, 1));
    EXPECT_EQ(pair.verdict, PairVerdict::kFewMatches);
    EXPECT_EQ(pair.num_matches, static_cast<int>(count));
  }
  TwoViewOptions options;
  options.min_inliers = 41;
  EXPECT_EQ(EstimatePair(made.rays_a, made.rays_b, made.Matches(40, 0, 1), options).verdict,
            PairVerdict::kFewMatches);
}

TEST(JudgePlace, CountsMatchesAndDigitsAtTheToldPlace) {
  const MadePair made({.noise_rad = DegToRad(0.05)}, kCameraA, kCameraB);
  const std::vector<FeatureMatch> matches = made.Matches(12, 60, 1);
  const std::vector<FeatureMatch> spots = made.Matches(made.truth.inliers.size(), 0, 1);
  // Told to a degree or two.
  const TwoViewGeometry told{RotationZ(DegToRad(0.5)) * made.truth.a_from_b,
                             RotationZ(DegToRad(1.5)) * made.truth.direction};
  const auto judge = [&](const std::vector<FeatureMatch>& on_floor, const TwoViewGeometry& place,
                         double digits) {
    return JudgePlace(made.rays_a, made.rays_b, matches, on_floor, place, digits, {});
  };
  const PanoPair alone = judge({}, told, 0), with_spots = judge(spots, told, 0);
  made.ExpectNear(with_spots, 0.2, "with spots");
  // Spots help to tell the place, not how likely it is.
  EXPECT_NEAR(with_spots.log10_chance, alone.log10_chance, 2);
  EXPECT_GT(with_spots.inliers.size(), spots.size());
  EXPECT_NEAR(judge(spots, told, 7).log10_chance, with_spots.log10_chance - 7, 1e-9);
  // One hypothesis instead of thousands.
  EXPECT_LT(alone.log10_chance, made.Estimate(matches).log10_chance - 2);
  // At a wrong place nothing agrees but what the floor says for itself.
  const TwoViewGeometry wrong{RotationZ(kPi / 2) * made.truth.a_from_b, made.truth.direction};
  EXPECT_GT(judge({}, wrong, 0).log10_chance, -4);
  EXPECT_NE(judge({}, wrong, 0).verdict, PairVerdict::kAccepted);
}

TEST(JudgePlace, TakesTheFloorsWordWhereNothingElseMatches) {
  const MadePair made({}, kCameraA, kCameraB);
  const TwoViewGeometry told{made.truth.a_from_b, made.truth.direction};
  const PanoPair pair = JudgePlace(made.rays_a, made.rays_b, {}, made.truth.inliers, told, 12, {});
  EXPECT_EQ(pair.verdict, PairVerdict::kAccepted);
  EXPECT_EQ(pair.log10_chance, -12);
  EXPECT_EQ(pair.inliers.size(), made.truth.inliers.size());
  EXPECT_EQ(JudgePlace(made.rays_a, made.rays_b, {}, {}, told, 12, {}).verdict,
            PairVerdict::kFewMatches);
}

}  // namespace
}  // namespace enfilade
