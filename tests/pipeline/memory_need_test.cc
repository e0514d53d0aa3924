// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory_need.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Scene MakePictures(int count, PoseSource poses = PoseSource::kEstimated) {
  Scene scene;
  scene.pose_source = poses;
  scene.views.resize(static_cast<size_t>(count));
  for (View& view : scene.views) view.camera = EquirectangularCamera(2048, 1024);
  return scene;
}

TEST(LeastSfmMemoryMb, IsWhatWasMeasured) {
  EXPECT_NEAR(LeastSfmMemoryMb(MakePictures(2), {}, 1), 502, 25);
  EXPECT_NEAR(LeastSfmMemoryMb(MakePictures(2), {}, 2), 898, 25);
}

// 10000 features of 224 bytes, and the refinement.
TEST(LeastSfmMemoryMb, GrowsByTheFeaturesOfAPicture) {
  const double of_thousand = LeastSfmMemoryMb(MakePictures(1000), {}, 2);
  EXPECT_NEAR(LeastSfmMemoryMb(MakePictures(2000), {}, 2) - of_thousand, 2940, 10);
  FeatureOptions half;
  half.max_features = 5000;
  EXPECT_NEAR(of_thousand - LeastSfmMemoryMb(MakePictures(1000), half, 2), 1120, 10);
}

TEST(LeastSfmMemoryMb, ThreadsHoldOnePictureEach) {
  const Scene three = MakePictures(3);
  EXPECT_LT(LeastSfmMemoryMb(three, {}, 1), LeastSfmMemoryMb(three, {}, 2));
  EXPECT_DOUBLE_EQ(LeastSfmMemoryMb(three, {}, 3), LeastSfmMemoryMb(three, {}, 64));
}

TEST(LeastSfmMemoryMb, GivenPosesNeedNoFeatures) {
  EXPECT_LT(LeastSfmMemoryMb(MakePictures(1000, PoseSource::kTransforms), {}, 2), 200);
}

TEST(RequireMemory, RefusesAThousandPicturesUnderASmallCap) {
  const double need_mb = LeastSfmMemoryMb(MakePictures(1000), {}, 2);
  RunContext enough(2, 0, static_cast<int>(need_mb) + 1), too_few(2, 0, 1000);
  EXPECT_NO_THROW(RequireMemory(need_mb, "give fewer pictures", enough));
  try {
    RequireMemory(need_mb, "give fewer pictures", too_few);
    FAIL() << "accepted";
  } catch (const InvalidInputError& error) {
    EXPECT_THAT(std::string(error.what()),
                AllOf(HasSubstr("--max-memory"), HasSubstr("1000 MB are too few"),
                      HasSubstr("give fewer pictures"), Not(HasSubstr("\n"))));
  }
}

}  // namespace
}  // namespace enfilade
