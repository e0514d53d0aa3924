// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/follow_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using testing::ElementsAre;

std::vector<View> Named(const std::vector<std::string>& names) {
  std::vector<View> views(names.size());
  for (size_t i = 0; i < names.size(); ++i) views[i].picture = names[i];
  return views;
}

TEST(OrderByName, CountsDigitsAsNumbers) {
  EXPECT_THAT(OrderByName(Named({"f10.jpg", "f9.jpg", "f0011.jpg", "f1.jpg"})),
              ElementsAre(3, 1, 0, 2));
  EXPECT_THAT(OrderByName(Named({"b.jpg", "a.jpg", "a1.jpg"})), ElementsAre(1, 2, 0));
  EXPECT_THAT(OrderByName(Named({"clip2_1.jpg", "clip1_20.jpg", "clip1_3.jpg"})),
              ElementsAre(2, 1, 0));
  // Names that differ in leading zeros alone keep their order.
  EXPECT_THAT(OrderByName(Named({"f01.jpg", "f1.jpg"})), ElementsAre(0, 1));
  EXPECT_THAT(OrderByName({}), ElementsAre());
}

TEST(FollowFrames, RefusesFramesOfSeveralSizes) {
  std::vector<View> frames = Named({"f0.jpg", "f1.jpg"});
  frames[0].camera = EquirectangularCamera(64, 32);
  frames[1].camera = EquirectangularCamera(128, 64);
  RunContext context;
  EXPECT_THROW((void)FollowFrames(frames, {}, {}, context), InvalidInputError);
}

Keyframe WithTracks(std::vector<int> track_ids) {
  Keyframe keyframe;
  keyframe.rays.resize(track_ids.size(), Eigen::Vector3f::UnitZ());
  keyframe.track_ids = std::move(track_ids);
  return keyframe;
}

TEST(MatchesOfTracks, PairsWhatHasOneTrack) {
  const std::vector<Keyframe> keyframes = {WithTracks({1, 4, 7}), WithTracks({4, 5, 7}),
                                           WithTracks({8})};
  // Two features with descriptors come before those of the first view's tracks.
  std::vector<PanoFeatures> features(3);
  features[0].rays.resize(5);
  features[1].rays.resize(3);
  features[2].rays.resize(1);
  const std::vector<PairMatches> pairs = MatchesOfTracks(keyframes, features);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].a_idx, 0);
  EXPECT_EQ(pairs[0].b_idx, 1);
  EXPECT_THAT(pairs[0].matches, ElementsAre(FeatureMatch{3, 0, 0}, FeatureMatch{4, 2, 0}));
}

}  // namespace
}  // namespace enfilade
