// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/odd_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/features.h"
#include "src/sfm/wall_matches.h"
#include "tests/sfm/blob_panorama.h"
#include "tests/sfm/pose_errors.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

// One room seen by five cameras, the verticals found from lines.
RegistrationScene MakeRoom(uint32_t seed) {
  return MakeRegistrationScene({.num_points_per_room = 400,
                                .noise_rad = DegToRad(0.05),
                                .false_share = 0.1,
                                .lone_share = 0.3,
                                .gravity_noise_rad = DegToRad(0.1),
                                .seed = seed},
                               SpreadCameras(0.2, 3, 2.6, 5, seed));
}

// The camera of a view hangs head down; lines do not tell.
void Turn(size_t view, RegistrationScene& scene) {
  const Eigen::Vector3f half_turn(-1, -1, 1);
  for (Eigen::Vector3f& ray : scene.features[view].rays) ray = half_turn.cwiseProduct(ray);
  scene.world_from_cam[view].rotation *= half_turn.cast<double>().asDiagonal();
  Vector3d& up = scene.gravity[view].up_in_cam;
  up = Vector3d(1, 1, -1).cwiseProduct(up);
  // Its descriptors are upright in the picture as it is.
  scene.features[view].descriptors =
      TurnedOver(scene.features[view], scene.gravity[view]).features.descriptors;
}

Registration Register(const RegistrationScene& scene, RunContext& context) {
  return RegisterFeatures(scene.features, scene.gravity, {}, context);
}

TEST(TurnOverTheUpsideDown, RegistersThemAsTheyStand) {
  RunContext context(2);
  for (const std::vector<size_t>& turned : {std::vector<size_t>{2}, std::vector<size_t>{1, 4}}) {
    RegistrationScene scene = MakeRoom(3);
    for (const size_t view : turned) Turn(view, scene);
    const Registration before = Register(scene, context);
    for (const size_t view : turned) EXPECT_NE(before.component_idx[view], 0);
    const std::vector<OddTie> ties =
        TurnOverTheUpsideDown(before.component_idx, {}, context, scene.features, scene.gravity);
    ASSERT_FALSE(ties.empty());
    EXPECT_EQ(before.component_idx[static_cast<size_t>(ties.front().partner_idx)], 0);
    const Registration after = Register(scene, context);
    EXPECT_THAT(after.component_idx, ElementsAre(0, 0, 0, 0, 0));
    const PoseErrors errors = ComparePoses(after.world_from_cam, scene.world_from_cam);
    EXPECT_LT(errors.position, 0.02);
    EXPECT_LT(RadToDeg(errors.rotation_rad), 0.2);
  }
}

TEST(TurnOverTheUpsideDown, LeavesAnotherHomeAlone) {
  RunContext context(2);
  RegistrationScene scene = MakeRoom(3);
  const RegistrationScene other = MakeRoom(77);
  scene.features[4] = other.features[4];
  scene.gravity[4] = other.gravity[4];
  const Registration registration = Register(scene, context);
  EXPECT_THAT(registration.component_idx, ElementsAre(0, 0, 0, 0, 1));
  EXPECT_THAT(
      TurnOverTheUpsideDown(registration.component_idx, {}, context, scene.features, scene.gravity),
      IsEmpty());
  EXPECT_THAT(FindMirrored(scene.features, scene.gravity, registration.component_idx, {}, context),
              IsEmpty());
}

TEST(FindMirrored, NamesThePicture) {
  RunContext context(2);
  RegistrationScene scene = MakeRoom(3);
  const PanoTrial mirrored = Mirrored(scene.features[2], scene.gravity[2]);
  scene.features[2] = mirrored.features;
  scene.gravity[2] = mirrored.gravity;
  const Registration registration = Register(scene, context);
  EXPECT_THAT(registration.component_idx, ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(
      TurnOverTheUpsideDown(registration.component_idx, {}, context, scene.features, scene.gravity),
      IsEmpty());
  const std::vector<OddTie> ties =
      FindMirrored(scene.features, scene.gravity, registration.component_idx, {}, context);
  ASSERT_EQ(ties.size(), 1U);
  EXPECT_EQ(ties[0].view_idx, 2);
}

TEST(FindCopies, NamesBothPictures) {
  RunContext context(2);
  RegistrationScene scene = MakeRoom(3);
  scene.features[4] = scene.features[1];
  scene.gravity[4] = scene.gravity[1];
  const Registration registration = Register(scene, context);
  const std::vector<OddTie> copies = FindCopies(scene.features, scene.gravity, registration.pairs);
  ASSERT_EQ(copies.size(), 1U);
  EXPECT_EQ(copies[0].partner_idx, 1);
  EXPECT_EQ(copies[0].view_idx, 4);
  const RegistrationScene without = MakeRoom(3);
  EXPECT_THAT(FindCopies(without.features, without.gravity, Register(without, context).pairs),
              IsEmpty());
}

// A panorama and what is found in it when the walls have a heading.
struct Looked {
  Gravity gravity;
  PanoFeatures features;
};

Looked Look(const ImageU8& panorama, double heading_rad) {
  const ImageU8 trusted(panorama.rows(), panorama.cols(), 1, 255);
  Looked looked;
  looked.gravity.heading_rad = heading_rad;
  looked.features =
      ExtractFeatures(panorama, trusted, EquirectangularCamera(panorama.cols(), panorama.rows()),
                      CamFromWalls(looked.gravity), {});
  return looked;
}

// Features of the same views at the same places, with like descriptors.
void ExpectFound(const PanoFeatures& expected, const PanoFeatures& found) {
  const auto matches = MatchWalls(expected, found, 0, {});
  EXPECT_GT(static_cast<int>(matches.size()), found.size() / 2);
  double num_right = 0;
  for (const FeatureMatch& match : matches) {
    num_right += (expected.rays[static_cast<size_t>(match.a_idx)] -
                  found.rays[static_cast<size_t>(match.b_idx)])
                     .norm() < 0.01;
  }
  EXPECT_GT(num_right, 0.95 * static_cast<double>(matches.size()));
}

// Against features that are found in the mirrored picture.
TEST(Mirrored, IsWhatTheMirroredPictureShows) {
  constexpr int kRows = 512;
  const ImageU8 panorama = BlobPanorama(kRows, 5);
  ImageU8 flipped(kRows, 2 * kRows);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < 2 * kRows; ++c) flipped(r, c) = panorama(r, 2 * kRows - 1 - c);
  }
  for (const double heading_rad : {0.0, 0.3, -0.7}) {
    const Looked looked = Look(panorama, heading_rad);
    const PanoTrial mirrored = Mirrored(looked.features, looked.gravity);
    ExpectFound(mirrored.features, Look(flipped, *mirrored.gravity.heading_rad).features);
    // Twice mirrored is as before.
    const PanoTrial twice = Mirrored(mirrored.features, mirrored.gravity);
    EXPECT_EQ(twice.features.descriptors.values, looked.features.descriptors.values);
    EXPECT_EQ(twice.features.walls, looked.features.walls);
  }
}

// Against features that are found when the vertical is known to be the other way.
TEST(TurnedOver, IsWhatIsFoundUpsideDown) {
  constexpr int kRows = 512;
  const ImageU8 panorama = BlobPanorama(kRows, 6);
  const ImageU8 trusted(kRows, 2 * kRows, 1, 255);
  for (const double heading_rad : {0.0, 0.3, -0.7}) {
    const Looked looked = Look(panorama, heading_rad);
    const PanoTrial turned = TurnedOver(looked.features, looked.gravity);
    ExpectFound(turned.features,
                ExtractFeatures(panorama, trusted, EquirectangularCamera(2 * kRows, kRows),
                                CamFromWalls(turned.gravity), {}));
  }
}

}  // namespace
}  // namespace enfilade
