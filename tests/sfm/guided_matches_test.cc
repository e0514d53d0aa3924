// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/guided_matches.h"

#include <gtest/gtest.h>

#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

// Five panoramas of one room, all pairs accepted with a few of their matches, poses as they are.
class MatchGuidedTest : public testing::Test {
 protected:
  MatchGuidedTest() {
    MadeSceneOptions options;
    options.noise_rad = DegToRad(0.05);
    options.false_share = 0.3;
    options.lone_share = 0.5;
    scene = MakeRegistrationScene(
        options, SpreadCameras(0, options.wall_x[1], options.depth, 5, options.seed));
    registration.world_from_cam = scene.world_from_cam;
    registration.component_idx.assign(5, 0);
    for (int a = 0; a < 5; ++a) {
      for (int b = a + 1; b < 5; ++b) {
        PanoPair pair = TruePair(scene, a, b);
        pair.inliers.resize(pair.inliers.size() / 4);
        registration.pairs.push_back(pair);
      }
    }
  }

  [[nodiscard]] size_t NumInliers() const {
    size_t sum = 0;
    for (const PanoPair& pair : registration.pairs) sum += pair.inliers.size();
    return sum;
  }
  [[nodiscard]] size_t NumTrue() const {
    size_t sum = 0;
    for (const PanoPair& pair : registration.pairs) {
      for (const FeatureMatch& match : pair.inliers) {
        const auto point = [&](int view, int feature) {
          return scene.point_of_feature[static_cast<size_t>(view)][static_cast<size_t>(feature)];
        };
        sum += point(pair.a_idx, match.a_idx) >= 0 &&
               point(pair.a_idx, match.a_idx) == point(pair.b_idx, match.b_idx);
      }
    }
    return sum;
  }

  void Match() {
    RunContext context(2);
    MatchGuided(scene.features, scene.gravity, {}, context, registration);
  }

  RegistrationScene scene;
  Registration registration;
};

TEST_F(MatchGuidedTest, FindsMoreMatchesThatAreTrue) {
  const size_t before = NumInliers();
  Match();
  EXPECT_GT(NumInliers(), 2 * before);
  EXPECT_GT(static_cast<double>(NumTrue()), 0.97 * static_cast<double>(NumInliers()));
}

TEST_F(MatchGuidedTest, AcceptsPairsThatThePosesExplain) {
  registration.pairs[3].verdict = PairVerdict::kChance;
  Match();
  EXPECT_EQ(registration.pairs[3].verdict, PairVerdict::kAccepted);
}

TEST_F(MatchGuidedTest, LeavesPairsOfTwoComponentsAndThoseOfOnePlaceAlone) {
  registration.component_idx[4] = 1;
  registration.pairs[0].verdict = PairVerdict::kSamePlace;
  const std::vector<PanoPair> before = registration.pairs;
  Match();
  for (size_t k = 0; k < before.size(); ++k) {
    if (k != 0 && before[k].b_idx != 4) continue;
    EXPECT_EQ(registration.pairs[k].inliers.size(), before[k].inliers.size());
    EXPECT_EQ(registration.pairs[k].verdict, before[k].verdict);
  }
}

// Where poses are wrong hardly anything agrees, and nothing is taken.
TEST_F(MatchGuidedTest, TakesNothingWherePosesAreWrong) {
  const size_t before = NumInliers();
  registration.world_from_cam[2].rotation =
      RotationZ(DegToRad(40)) * registration.world_from_cam[2].rotation;
  size_t of_view_2 = 0;
  for (const PanoPair& pair : registration.pairs) {
    if (pair.a_idx == 2 || pair.b_idx == 2) of_view_2 += pair.inliers.size();
  }
  Match();
  size_t after = 0;
  for (const PanoPair& pair : registration.pairs) {
    if (pair.a_idx == 2 || pair.b_idx == 2) after += pair.inliers.size();
  }
  EXPECT_EQ(after, of_view_2);
  EXPECT_GT(NumInliers(), before);
}

}  // namespace
}  // namespace enfilade
