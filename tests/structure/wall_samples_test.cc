// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/wall_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "enfilade/geometry/angles.h"

namespace enfilade {
namespace {

constexpr int kColumns = 8;

WallProfile MakeProfile(int view_idx) {
  WallProfile profile;
  profile.view_idx = view_idx;
  profile.wall_probability = ImageF(kColumns, 3);
  for (int c = 0; c < kColumns; ++c) {
    profile.wall_m.push_back(2.0F + static_cast<float>(c));
    profile.obstacle_m.push_back(1.5F + static_cast<float>(c));
    profile.confidence.push_back(0.1F * static_cast<float>(c));
    profile.is_seen.push_back(c != 2);
    profile.wall_probability(c, c % 3) = 1;
  }
  return profile;
}

// Two views on the ground floor, one above.
class MakeWallSamplesTest : public ::testing::Test {
 protected:
  MakeWallSamplesTest() {
    structure_.home_from_world.rotation = RotationZ(kPi / 2);
    structure_.bin_m = {1, 2, 4};
    structure_.storeys.resize(2);
    for (int i = 0; i < 3; ++i) {
      View view;
      view.world_from_cam.translation = {3.0 + i, 1, 1.5};
      view.storey_idx = i == 1 ? 1 : 0;
      scene_.views.push_back(view);
      structure_.profiles.push_back(MakeProfile(i));
    }
  }

  Scene scene_;
  Structure structure_;
};

TEST_F(MakeWallSamplesTest, OneASeenColumnOfTheStorey) {
  const WallSampleSet set = MakeWallSamples(structure_, scene_, 0);
  EXPECT_EQ(set.bin_m, structure_.bin_m);
  ASSERT_EQ(set.samples.size(), 2u * (kColumns - 1));
  EXPECT_EQ(set.samples.front().view_idx, 0);
  EXPECT_EQ(set.samples.back().view_idx, 2);
  EXPECT_EQ(MakeWallSamples(structure_, scene_, 1).samples.size(), size_t{kColumns - 1});
}

TEST_F(MakeWallSamplesTest, AreInThePlanOfTheHomeFrame) {
  const WallSampleSet set = MakeWallSamples(structure_, scene_, 0);
  // Columns 0, 1, 3, …: column 3 is the third sample; it looks along −22.5°.
  const WallSample& sample = set.samples[2];
  EXPECT_LT((sample.origin - Eigen::Vector2d(-1, 3)).norm(), 1e-9);
  EXPECT_NEAR(std::atan2(sample.direction.y(), sample.direction.x()), -kPi / 8, 1e-9);
  EXPECT_NEAR(sample.spread_rad, 2 * kPi / kColumns, 1e-12);
  EXPECT_FLOAT_EQ(static_cast<float>(sample.wall_m), 5);
  EXPECT_FLOAT_EQ(static_cast<float>(sample.obstacle_m), 4.5);
  EXPECT_FLOAT_EQ(static_cast<float>(sample.confidence), 0.3F);
  EXPECT_EQ(sample.wall_probability, (std::vector<float>{1, 0, 0}));
}

TEST_F(MakeWallSamplesTest, NeedsAProfileForEachView) {
  structure_.profiles.pop_back();
  EXPECT_THROW((void)MakeWallSamples(structure_, scene_, 0), std::logic_error);
}

}  // namespace
}  // namespace enfilade
