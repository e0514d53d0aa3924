// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/register.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/view_graph.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kOneCentimetre = 0.01 / kCameraHeight_m;

// Two rooms that a door joins, one camera in it, and a third behind a door that is shut. Verticals
// err by 0.1°, rays by 0.05°, one feature in ten points anywhere and one in three has no partner.
const std::vector<int> kOpenRooms = {0, 1, 2, 3, 4, 5, 6};
const std::vector<int> kShutRoom = {7, 8};

RegistrationScene MakeThreeRooms(uint32_t seed) {
  std::vector<MadeCamera> cameras = SpreadCameras(0.2, 3, 2.6, 3, seed);
  cameras.push_back({{3.2, 1.3}, 0.7, 1, {0, 0}});
  for (const MadeCamera& camera : SpreadCameras(3.4, 6.2, 2.6, 3, seed + 1)) {
    cameras.push_back(camera);
  }
  for (const MadeCamera& camera : SpreadCameras(6.6, 9.4, 2.6, 2, seed + 2)) {
    cameras.push_back(camera);
  }
  for (size_t i = 0; i < cameras.size(); ++i) {
    cameras[i].tilt_rad = {DegToRad(1) * std::sin(2.0 * static_cast<double>(i)),
                           DegToRad(1) * std::cos(3.0 * static_cast<double>(i))};
  }
  return MakeRegistrationScene({.wall_x = {0, 3.2, 6.4, 9.6},
                                .is_door_open = {true, false},
                                .num_points_per_room = 150,
                                .noise_rad = DegToRad(0.05),
                                .false_share = 0.1,
                                .lone_share = 0.3,
                                .gravity_noise_rad = DegToRad(0.1),
                                .seed = seed},
                               cameras);
}

Registration Register(const RegistrationScene& scene, int num_threads = 1) {
  RunContext context(num_threads);
  return RegisterFeatures(scene.features, scene.gravity, {}, context);
}

bool AreSameBytes(const Registration& x, const Registration& y) {
  if (x.component_idx != y.component_idx || x.ceilings != y.ceilings ||
      x.ray_error_rad != y.ray_error_rad || x.world_from_cam.size() != y.world_from_cam.size() ||
      x.tracks.size() != y.tracks.size() || x.pairs.size() != y.pairs.size()) {
    return false;
  }
  for (size_t i = 0; i < x.world_from_cam.size(); ++i) {
    if (std::memcmp(&x.world_from_cam[i], &y.world_from_cam[i], sizeof(Rigid3)) != 0) return false;
  }
  for (size_t i = 0; i < x.tracks.size(); ++i) {
    if (x.tracks[i].position != y.tracks[i].position) return false;
  }
  for (size_t i = 0; i < x.pairs.size(); ++i) {
    if (x.pairs[i].verdict != y.pairs[i].verdict || x.pairs[i].inliers != y.pairs[i].inliers ||
        x.pairs[i].a_from_b != y.pairs[i].a_from_b || x.pairs[i].length != y.pairs[i].length) {
      return false;
    }
  }
  return true;
}

// The shut room is a component of its own, at the right scale.
TEST(RegisterFeatures, PlacesRoomsBehindOpenAndShutDoors) {
  for (uint32_t seed = 1; seed <= 2; ++seed) {
    const RegistrationScene scene = MakeThreeRooms(seed);
    const Registration result = Register(scene);
    EXPECT_THAT(result.component_idx, ElementsAre(0, 0, 0, 0, 0, 0, 0, 1, 1));
    for (const std::vector<int>& views : {kOpenRooms, kShutRoom}) {
      const PoseErrors errors = ComparePoses(result.world_from_cam, scene.world_from_cam, views);
      EXPECT_LT(errors.position, kOneCentimetre) << "seed " << seed;
      EXPECT_LT(RadToDeg(errors.rotation_rad), 0.1) << "seed " << seed;
    }
    ASSERT_FALSE(result.ceilings.empty());
    EXPECT_NEAR(result.ceilings.front(), 1.7, 0.005);
    EXPECT_LT(RadToDeg(result.ray_error_rad), 0.1);
    EXPECT_GT(result.tracks.size(), 200u);
  }
}

TEST(RegisterFeatures, TellsWhatBecameOfEveryPair) {
  const RegistrationScene scene = MakeThreeRooms(1);
  const Registration result = Register(scene);
  EXPECT_EQ(result.pairs.size(), 9u * 8u / 2u);
  size_t k = 0;
  for (int a = 0; a < 9; ++a) {
    for (int b = a + 1; b < 9; ++b, ++k) {
      EXPECT_EQ(result.pairs[k].a_idx, a);
      EXPECT_EQ(result.pairs[k].b_idx, b);
      if (a <= 6 && b > 6) {
        EXPECT_FALSE(IsConnecting(result.pairs[k])) << a << ", " << b;
      }
      if (b <= 2 || (a >= 4 && b <= 6) || a > 6) {
        EXPECT_EQ(result.pairs[k].verdict, PairVerdict::kAccepted) << a << ", " << b;
        EXPECT_NEAR(result.pairs[k].length, TruePair(scene, a, b).length,
                    0.03 * TruePair(scene, a, b).length);
      }
    }
  }
}

// Cameras of a room find each other among those of all rooms.
TEST(RegisterFeatures, PlacesRoomsFromSelectedPairs) {
  const RegistrationScene scene = MakeThreeRooms(1);
  RegisterOptions options;
  options.selection = {.all_pairs_up_to = 2, .num_partners = 3, .num_coarse_features = 100};
  RunContext context(1);
  const Registration result = RegisterFeatures(scene.features, scene.gravity, options, context);
  EXPECT_LT(result.pairs.size(), 9U * 3U);
  EXPECT_THAT(result.component_idx, ElementsAre(0, 0, 0, 0, 0, 0, 0, 1, 1));
  for (const std::vector<int>& views : {kOpenRooms, kShutRoom}) {
    EXPECT_LT(ComparePoses(result.world_from_cam, scene.world_from_cam, views).position,
              kOneCentimetre);
  }
}

TEST(RegisterFeatures, PointsLieWhereTheyAre) {
  const RegistrationScene scene = MakeRegistrationScene(
      {.num_points_per_room = 200, .noise_rad = DegToRad(0.05), .false_share = 0.1},
      SpreadCameras(0.2, 3, 2.6, 4, 1));
  const Registration result = Register(scene);
  // Points as seen from the first camera that shows them do not depend on the frame.
  std::vector<double> errors;
  for (const Track& track : result.tracks) {
    const Observation& sight = track.observations.front();
    const size_t view = static_cast<size_t>(sight.view_idx);
    const int point_idx = scene.point_of_feature[view][static_cast<size_t>(sight.feature_idx)];
    if (point_idx < 0) continue;
    const Eigen::Vector3d truth =
        scene.world_from_cam[view].Inverse() * scene.points[static_cast<size_t>(point_idx)];
    errors.push_back((result.world_from_cam[view].Inverse() * track.position - truth).norm());
  }
  EXPECT_GT(errors.size(), 0.98 * static_cast<double>(result.tracks.size()));
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], kOneCentimetre);
  EXPECT_LT(errors[errors.size() * 9 / 10], 4 * kOneCentimetre);
}

// Over all components; the last one, of the view without features, has no rays.
TEST(RegisterFeatures, RayErrorIsThatOfAllTracks) {
  RegistrationScene scene = MakeRegistrationScene(
      {.num_points_per_room = 150, .noise_rad = DegToRad(0.05)}, SpreadCameras(0.2, 3, 2.6, 4, 1));
  scene.features[3] = {};
  const Registration result = Register(scene);
  double sum = 0, count = 0;
  for (const Track& track : result.tracks) {
    for (const Observation& sight : track.observations) {
      const size_t view = static_cast<size_t>(sight.view_idx);
      const Eigen::Vector3f& ray =
          scene.features[view].rays[static_cast<size_t>(sight.feature_idx)];
      const double angle =
          AngleBetween(result.world_from_cam[view].Inverse() * track.position, ray.cast<double>());
      sum += angle * angle;
      count += 1;
    }
  }
  ASSERT_GT(count, 0);
  EXPECT_NEAR(result.ray_error_rad, std::sqrt(sum / count), 1e-6);
}

TEST(RegisterFeatures, CamerasOfDifferentHeights) {
  std::vector<MadeCamera> cameras = SpreadCameras(0.2, 3, 2.6, 4, 1);
  for (size_t i = 0; i < cameras.size(); ++i) {
    cameras[i].height = 1 + 0.015 * (static_cast<double>(i) - 1.5);  // ±3.4 cm, mean 1
  }
  const RegistrationScene scene =
      MakeRegistrationScene({.num_points_per_room = 150, .noise_rad = DegToRad(0.05)}, cameras);
  const PoseErrors errors = ComparePoses(Register(scene).world_from_cam, scene.world_from_cam);
  // Heights scatter by 1.7 %, so the scale is off by up to 1.7 % / √4, over 1.5 from the middle.
  EXPECT_LT(errors.position, 0.02);
}

TEST(RegisterFeatures, PermutingTheViewsPermutesTheResult) {
  const RegistrationScene scene = MakeThreeRooms(2);
  const Registration result = Register(scene);
  const std::vector<size_t> order = {7, 2, 0, 4, 5, 1, 8, 3, 6};
  RegistrationScene permuted;
  std::vector<Rigid3> expected;
  std::vector<int> expected_component;
  std::vector<int> open_rooms, shut_room;
  for (const size_t view : order) {
    permuted.features.push_back(scene.features[view]);
    permuted.gravity.push_back(scene.gravity[view]);
    expected.push_back(result.world_from_cam[view]);
    expected_component.push_back(result.component_idx[view]);
    (view <= 6 ? open_rooms : shut_room).push_back(static_cast<int>(expected.size()) - 1);
  }
  const Registration again = Register(permuted);
  EXPECT_EQ(again.component_idx, expected_component);
  for (const std::vector<int>& views : {open_rooms, shut_room}) {
    const PoseErrors errors = ComparePoses(again.world_from_cam, expected, views);
    EXPECT_LT(errors.position, 0.1 * kOneCentimetre);
    EXPECT_LT(RadToDeg(errors.rotation_rad), 0.02);
  }
}

TEST(RegisterFeatures, ThreadsDoNotChangeAByte) {
  const RegistrationScene scene = MakeThreeRooms(3);
  EXPECT_TRUE(AreSameBytes(Register(scene, 1), Register(scene, 2)));
}

TEST(RegisterFeatures, AViewWithoutFeaturesStandsAlone) {
  RegistrationScene scene =
      MakeRegistrationScene({.num_points_per_room = 150}, SpreadCameras(0.2, 3, 2.6, 4, 1));
  scene.features[1] = {};
  const Registration result = Register(scene);
  EXPECT_THAT(result.component_idx, ElementsAre(0, 1, 0, 0));
  const PoseErrors errors =
      ComparePoses(result.world_from_cam, scene.world_from_cam, std::vector<int>{0, 2, 3});
  EXPECT_LT(errors.position, kOneCentimetre);
  // Upright, at its origin, one above the floor.
  const Rigid3& alone = result.world_from_cam[1];
  EXPECT_LT(AngleBetween(alone.rotation * scene.gravity[1].up_in_cam, Eigen::Vector3d::UnitZ()),
            1e-9);
  EXPECT_LT((alone.translation - Eigen::Vector3d(0, 0, 1)).norm(), 1e-9);
}

TEST(RegisterFeatures, OneView) {
  const RegistrationScene scene = MakeRegistrationScene({}, SpreadCameras(0.2, 3, 2.6, 1, 1));
  const Registration result = Register(scene);
  EXPECT_THAT(result.component_idx, ElementsAre(0));
  EXPECT_THAT(result.world_from_cam, SizeIs(1));
  EXPECT_THAT(result.pairs, IsEmpty());
  EXPECT_THAT(result.tracks, IsEmpty());
  EXPECT_EQ(result.ray_error_rad, 0);
}

TEST(RegisterFeatures, NoViews) {
  const Registration result = Register({});
  EXPECT_THAT(result.component_idx, IsEmpty());
  EXPECT_THAT(result.world_from_cam, IsEmpty());
  EXPECT_THAT(result.pairs, IsEmpty());
}

TEST(RegisterFeatures, UnrelatedViewsStayApart) {
  RegistrationScene scene = MakeRegistrationScene({}, SpreadCameras(0.2, 3, 2.6, 2, 1));
  const RegistrationScene other =
      MakeRegistrationScene({.seed = 99}, SpreadCameras(0.2, 3, 2.6, 1, 5));
  scene.features.push_back(other.features[0]);
  scene.gravity.push_back(other.gravity[0]);
  EXPECT_THAT(Register(scene).component_idx, ElementsAre(0, 0, 1));
}

TEST(RegisterFeatures, StopsOnRequest) {
  const RegistrationScene scene = MakeRegistrationScene({}, SpreadCameras(0.2, 3, 2.6, 3, 1));
  RunContext context(1);
  context.RequestStop();
  EXPECT_THROW((void)RegisterFeatures(scene.features, scene.gravity, {}, context), StoppedError);
}

// What floors tell ties a room behind a shut door.
TEST(RegisterFeatures, TakesFloorsForPairs) {
  RegistrationScene scene = MakeThreeRooms(1);
  const PanoPair truth = TruePair(scene, 6, 7);
  FloorMatch floor{6, 7, truth.Yaw_rad(), truth.length * truth.direction.head<2>(), 40, {}};
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d at(6.2 + 0.1 * (i % 6), 0.9 + 0.15 * (i / 6), 0);
    floor.spots.push_back({scene.features[6].size(), scene.features[7].size()});
    for (const size_t view : {size_t{6}, size_t{7}}) {
      const Eigen::Vector3d ray = scene.world_from_cam[view].Inverse() * at;
      scene.features[view].rays.push_back(ray.normalized().cast<float>());
    }
  }
  RunContext context(1);
  const Registration result = RegisterFeatures(scene.features, scene.gravity, {}, context, {},
                                               std::vector<FloorMatch>{floor});
  EXPECT_THAT(result.component_idx, ElementsAre(0, 0, 0, 0, 0, 0, 0, 0, 0));
  const std::vector<int> all = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_LT(ComparePoses(result.world_from_cam, scene.world_from_cam, all).position,
            2 * kOneCentimetre);
}

}  // namespace
}  // namespace enfilade
