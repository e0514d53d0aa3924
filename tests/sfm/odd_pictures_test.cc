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
        TurnOverTheUpsideDown(scene.features, before.component_idx, {}, context, scene.gravity);
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
      TurnOverTheUpsideDown(scene.features, registration.component_idx, {}, context, scene.gravity),
      IsEmpty());
  EXPECT_THAT(FindMirrored(scene.features, scene.gravity, registration.component_idx, {}, context),
              IsEmpty());
}

TEST(FindMirrored, NamesThePicture) {
  RunContext context(2);
  RegistrationScene scene = MakeRoom(3);
  scene.features[2] = Mirrored(scene.features[2]);
  scene.gravity[2] = Mirrored(scene.gravity[2]);
  const Registration registration = Register(scene, context);
  EXPECT_THAT(registration.component_idx, ElementsAre(0, 0, 1, 0, 0));
  EXPECT_THAT(
      TurnOverTheUpsideDown(scene.features, registration.component_idx, {}, context, scene.gravity),
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

// Against features that are found in the mirrored picture.
TEST(Mirrored, IsWhatTheMirroredPictureShows) {
  constexpr int kRows = 512;
  const ImageU8 panorama = BlobPanorama(kRows, 5);
  ImageU8 flipped(kRows, 2 * kRows);
  for (int r = 0; r < kRows; ++r) {
    for (int c = 0; c < 2 * kRows; ++c) flipped(r, c) = panorama(r, 2 * kRows - 1 - c);
  }
  const ImageU8 trusted(kRows, 2 * kRows, 1, 255);
  const Camera camera = EquirectangularCamera(2 * kRows, kRows);
  const PanoFeatures mirrored = Mirrored(ExtractFeatures(panorama, trusted, camera, {}));
  const PanoFeatures found = ExtractFeatures(flipped, trusted, camera, {});
  const auto matches = MatchDescriptors(mirrored.descriptors, found.descriptors, {});
  EXPECT_GT(static_cast<int>(matches.size()), found.size() / 2);
  double num_right = 0;
  for (const FeatureMatch& match : matches) {
    num_right += (mirrored.rays[static_cast<size_t>(match.a_idx)] -
                  found.rays[static_cast<size_t>(match.b_idx)])
                     .norm() < 0.01;
  }
  EXPECT_GT(num_right, 0.95 * static_cast<double>(matches.size()));
  // Twice mirrored is as before.
  EXPECT_EQ(Mirrored(mirrored).descriptors.values,
            ExtractFeatures(panorama, trusted, camera, {}).descriptors.values);
}

}  // namespace
}  // namespace enfilade
