// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/floor_matches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "enfilade/sfm/gravity.h"
#include "tests/sfm/floor_panorama.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

FloorPlace PlaceOne(const FloorPicture& a, const FloorPicture& b) {
  RunContext context(1);
  const std::vector<FloorPicture> floors = {a, b};
  return PlaceFloors(floors, std::vector<ViewPair>{{0, 1}}, context).front();
}

TEST(LookAtFloor, ShowsTheHeadingAtTheTop) {
  // A bright spot to the left of the heading and ahead.
  const FloorTexture texture = [](const Vector2d& at) {
    return (at - Vector2d(1.0, 0.5)).norm() < 0.05 ? 250.0 : 100.0;
  };
  for (const double yaw : {0.0, 0.4, 1.9}) {
    const FloorPano pano{{0, 0}, yaw};
    const FloorPicture picture = pano.Look(texture);
    int row = 0, col = 0;
    for (int r = 0; r < FloorPicture::kSide; ++r) {
      for (int c = 0; c < FloorPicture::kSide; ++c) {
        if (picture.contrast(r, c) > picture.contrast(row, col)) {
          row = r;
          col = c;
        }
      }
    }
    // The heading is along one of the world's axes.
    const double along = yaw + *pano.Standing().heading_rad;
    const Vector3d expected = RotationZ(-along) * Vector3d(1.0, 0.5, 0);
    EXPECT_NEAR(FloorPicture::kReach - row, 75 * expected.x(), 5) << yaw;
    EXPECT_NEAR(FloorPicture::kReach - col, 75 * expected.y(), 5) << yaw;
  }
}

TEST(LookAtFloor, SeesNothingOnPlainFloorsAndUnderTheStand) {
  const FloorPicture plain = FloorPano{}.Look([](const Vector2d&) { return 90.0; });
  EXPECT_TRUE(std::all_of(plain.contrast.data().begin(), plain.contrast.data().end(),
                          [](int8_t value) { return value == 0; }));
  const FloorPicture picture = FloorPano{}.Look(RandomFloor(1));
  EXPECT_EQ(picture.contrast(FloorPicture::kReach, FloorPicture::kReach), 0);
  EXPECT_EQ(picture.contrast(0, 0), 0);
}

// The point of the floor that a feature of a panorama shows.
Vector2d OnFloor(const FloorPano& pano, const PanoFeatures& features, int feature) {
  const Vector3d ray = RotationZ(pano.yaw_rad) * LevelFromCam(pano.Standing()) *
                       features.rays[static_cast<size_t>(feature)].cast<double>();
  return pano.at - pano.height / ray.z() * ray.head<2>();
}

TEST(PlaceFloors, FindsStepAndTurn) {
  const FloorTexture texture = RandomFloor(3);
  const FloorPano a{{0.3, -0.2}, 0.2}, b{{1.5, 0.6}, 2.6};
  const FloorPlace place = PlaceOne(a.Look(texture), b.Look(texture));
  RunContext context(1);
  std::vector<PanoFeatures> features(2);
  const std::vector<Gravity> gravity = {a.Standing(), b.Standing()};
  const std::vector<FloorMatch> matches =
      MatchFloors(std::vector<FloorPicture>{a.Look(texture), b.Look(texture)},
                  std::vector<ViewPair>{{0, 1}}, gravity, context, features);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_GT(place.digits, 20);
  EXPECT_NEAR(WrapPi(matches[0].yaw_rad - 2.4), 0, 1e-9);
  const Vector3d step = RotationZ(-a.yaw_rad) * Vector3d(1.2, 0.8, 0);
  EXPECT_NEAR((matches[0].step - step.head<2>()).norm(), 0, 0.01);
  ASSERT_GT(matches[0].spots.size(), 20U);
  for (const FeatureMatch& spot : matches[0].spots) {
    EXPECT_LT((OnFloor(a, features[0], spot.a_idx) - OnFloor(b, features[1], spot.b_idx)).norm(),
              0.01);
  }
}

TEST(PlaceFloors, DoesNotBelieveWhatRepeatsOrIsAnotherFloor) {
  const FloorPano a{{0, 0}, 0.1}, b{{1.1, 0.4}, 0.1};
  EXPECT_LT(PlaceOne(a.Look(TiledFloor), b.Look(TiledFloor)).digits, 6);
  for (uint32_t seed = 10; seed < 16; seed += 2) {
    EXPECT_LT(PlaceOne(a.Look(RandomFloor(seed)), b.Look(RandomFloor(seed + 1))).digits, 9);
  }
}

TEST(PlaceFloors, KnowsNothingWithoutHeadings) {
  RunContext context(1);
  const std::vector<FloorPicture> floors = {FloorPano{}.Look(RandomFloor(1)), FloorPicture{}};
  EXPECT_EQ(PlaceFloors(floors, std::vector<ViewPair>{{0, 1}}, context).front().digits, 0);
  EXPECT_TRUE(PlaceFloors({}, {}, context).empty());
}

TEST(MatchFloors, SaysTheSameForAnyNumberOfThreads) {
  const FloorTexture texture = RandomFloor(5);
  std::vector<FloorPicture> floors;
  std::vector<Gravity> gravity;
  std::vector<ViewPair> pairs;
  for (int i = 0; i < 18; ++i) {  // more than are looked at together
    const FloorPano pano{{0.4 * i, 0.1 * i}, 0.3 * i};
    floors.push_back(pano.Look(texture));
    gravity.push_back(pano.Standing());
    if (i > 0) pairs.push_back({i - 1, i});
  }
  std::vector<PanoFeatures> one(floors.size()), three(floors.size());
  RunContext single(1), many(3);
  const std::vector<FloorMatch> x = MatchFloors(floors, pairs, gravity, single, one);
  const std::vector<FloorMatch> y = MatchFloors(floors, pairs, gravity, many, three);
  ASSERT_EQ(x.size(), pairs.size());
  ASSERT_EQ(y.size(), pairs.size());
  for (size_t k = 0; k < x.size(); ++k) {
    EXPECT_EQ(x[k].digits, y[k].digits);
    EXPECT_EQ(x[k].step, y[k].step);
    EXPECT_EQ(x[k].spots, y[k].spots);
  }
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].rays, three[i].rays);
}

TEST(MatchFloorsAgain, FindsSpotsWherePosesSayTheyAre) {
  const FloorTexture texture = RandomFloor(7), other = RandomFloor(8);
  // The third looks at another floor, the fourth does not stand where its pose says.
  const std::vector<FloorPano> panos = {
      {{0, 0}, 0.2, 0.98}, {{1.2, 0.5}, 1.9, 1.02}, {{0.5, 1.0}, 0.5}, {{-0.6, 0.9}, 0.1}};
  std::vector<FloorPicture> floors;
  std::vector<Gravity> gravity;
  Registration registration;
  for (size_t i = 0; i < panos.size(); ++i) {
    floors.push_back(panos[i].Look(i == 2 ? other : texture));
    gravity.push_back(panos[i].Standing());
    Vector3d at(panos[i].at.x(), panos[i].at.y(), panos[i].height);
    at += i == 3 ? Vector3d(0.4, 0, 0) : Vector3d(0.01, -0.01, 0) * static_cast<double>(i);
    registration.world_from_cam.push_back(
        {RotationZ(panos[i].yaw_rad) * LevelFromCam(gravity[i]), at});
  }
  registration.component_idx = {0, 0, 0, 0};
  for (int a = 0; a < 4; ++a) {
    for (int b = a + 1; b < 4; ++b) {
      PanoPair pair;
      pair.a_idx = a;
      pair.b_idx = b;
      pair.inliers = {{0, 0}};  // of a match before
      registration.pairs.push_back(pair);
    }
  }
  RunContext context(2);
  std::vector<PanoFeatures> features(panos.size());
  EXPECT_EQ(MatchFloorsAgain(floors, gravity, context, registration, features), 1);
  const PanoPair& found = registration.pairs[0];
  EXPECT_EQ(found.verdict, PairVerdict::kAccepted);
  ASSERT_GT(found.inliers.size(), 20U);
  for (const FeatureMatch& spot : found.inliers) {
    EXPECT_LT(
        (OnFloor(panos[0], features[0], spot.a_idx) - OnFloor(panos[1], features[1], spot.b_idx))
            .norm(),
        0.01);
  }
  for (size_t k = 1; k < registration.pairs.size(); ++k) {
    EXPECT_EQ(registration.pairs[k].verdict, PairVerdict::kFewMatches);
  }
}

}  // namespace
}  // namespace enfilade
