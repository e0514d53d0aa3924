// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/pair_length.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "tests/sfm/registration_scene.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using ::testing::IsEmpty;

constexpr double kCeiling = 1.7;

// A room with a row of cameras, pairs of 0.5 to 2.4 camera heights (0.75 to 3.6 m).
class MadeRoom {
 public:
  MadeRoom(double noise_rad, uint32_t seed, int num_points = 400) {
    std::vector<MadeCamera> cameras;
    for (const double x : {0.4, 0.9, 1.7, 2.8})
      cameras.push_back({{x, 0.9 + 0.2 * x}, x, 1, {0, 0}});
    scene_ = MakeRegistrationScene({.ceiling = kCeiling,
                                    .num_points_per_room = num_points,
                                    .noise_rad = noise_rad,
                                    .seed = seed},
                                   cameras);
    for (int i = 0; i < scene_.num_views(); ++i) level_rays_.push_back(LevelRaysOf(scene_, i));
    for (int a = 0; a < scene_.num_views(); ++a) {
      for (int b = a + 1; b < scene_.num_views(); ++b) pairs.push_back(TruePair(scene_, a, b));
    }
  }
  // Keeps the matches whose points `is_kept` likes.
  template <typename Predicate>
  void Keep(const Predicate& is_kept) {
    for (PanoPair& pair : pairs) {
      const std::vector<int>& points = scene_.point_of_feature[static_cast<size_t>(pair.a_idx)];
      std::erase_if(pair.inliers, [&](const FeatureMatch& match) {
        const int point_idx = points[static_cast<size_t>(match.a_idx)];
        return !is_kept(scene_.points[static_cast<size_t>(point_idx)]);
      });
    }
  }
  [[nodiscard]] std::vector<std::vector<LengthVote>> Votes() const {
    std::vector<std::vector<LengthVote>> votes;
    for (const PanoPair& pair : pairs) {
      votes.push_back(CollectLengthVotes(pair, level_rays_[static_cast<size_t>(pair.a_idx)],
                                         level_rays_[static_cast<size_t>(pair.b_idx)]));
    }
    return votes;
  }
  // The pairs with the lengths that their votes give.
  [[nodiscard]] std::vector<PanoPair> Measured(double ceiling) const {
    const std::vector<std::vector<LengthVote>> votes = Votes();
    std::vector<PanoPair> measured = pairs;
    for (size_t k = 0; k < pairs.size(); ++k) SetLength(votes[k], ceiling, measured[k]);
    return measured;
  }

  std::vector<PanoPair> pairs;  ///< with the true lengths

 private:
  RegistrationScene scene_;
  std::vector<std::vector<Vector3d>> level_rays_;
};

void ExpectLengths(const std::vector<PanoPair>& measured, const std::vector<PanoPair>& truth,
                   double tolerance) {
  for (size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(measured[k].length, truth[k].length, tolerance * truth[k].length)
        << "pair " << truth[k].a_idx << ", " << truth[k].b_idx;
    EXPECT_GT(measured[k].length_sigma, 0);
  }
}

TEST(CollectLengthVotes, VotesOfPlanesAreTheLength) {
  MadeRoom room(0, 1);
  room.Keep([](const Vector3d& point) { return point.z() == 0 || point.z() == kCeiling; });
  const std::vector<std::vector<LengthVote>> votes = room.Votes();
  for (size_t k = 0; k < votes.size(); ++k) {
    EXPECT_GT(votes[k].size(), 20u);
    for (const LengthVote& vote : votes[k]) {
      const double log_ceiling = vote.is_above ? std::log(kCeiling - 1) : 0;
      EXPECT_NEAR(vote.log_length + log_ceiling, std::log(room.pairs[k].length), 1e-3);
      EXPECT_GT(vote.sigma, 0);
    }
  }
}

TEST(CollectLengthVotes, PointsAtTheHorizonHaveNone) {
  MadeRoom room(0, 1);
  room.Keep([](const Vector3d& point) { return std::abs(point.z() - 1) < 0.02; });
  for (const std::vector<LengthVote>& votes : room.Votes()) EXPECT_THAT(votes, IsEmpty());
}

// What a mirror shows lies below the floor: many features of one thing there are one vote.
TEST(CollectLengthVotes, OneSpotIsOneVote) {
  MadeRoom room(0, 1);
  room.Keep([](const Vector3d& point) { return point.z() == 0; });
  const FeatureMatch first = room.pairs[0].inliers.front();
  room.pairs[0].inliers = std::vector<FeatureMatch>(8, first);
  const std::vector<std::vector<LengthVote>> votes = room.Votes();
  double sum = 0;
  for (const LengthVote& vote : votes[0]) sum += vote.weight;
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(FindCeiling, IsTheHeightAboveTheCameras) {
  for (uint32_t seed = 1; seed <= 2; ++seed) {
    const MadeRoom room(DegToRad(0.1), seed, 200);
    EXPECT_NEAR(FindCeiling(room.Votes()), kCeiling - 1, 0.03 * (kCeiling - 1)) << "seed " << seed;
  }
}

TEST(FindCeiling, IsZeroWithoutPointsAbove) {
  MadeRoom room(0, 1);
  room.Keep([](const Vector3d& point) { return point.z() < 1; });
  EXPECT_EQ(FindCeiling(room.Votes()), 0);
  EXPECT_EQ(FindCeiling({}), 0);
}

TEST(SetLength, FloorAndCeilingTellItTo3Percent) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    const MadeRoom room(DegToRad(0.1), seed);
    ExpectLengths(room.Measured(kCeiling - 1), room.pairs, 0.03);
  }
}

TEST(SetLength, TheFloorAloneTellsItTo3Percent) {
  MadeRoom room(DegToRad(0.1), 1);
  ExpectLengths(room.Measured(0), room.pairs, 0.03);
  room.Keep([](const Vector3d& point) { return point.z() < 1; });
  ExpectLengths(room.Measured(kCeiling - 1), room.pairs, 0.03);
}

TEST(SetLength, TheCeilingAloneTellsItTo3Percent) {
  MadeRoom room(DegToRad(0.1), 1);
  room.Keep([](const Vector3d& point) { return point.z() > 1; });
  ExpectLengths(room.Measured(kCeiling - 1), room.pairs, 0.03);
  for (const PanoPair& pair : room.Measured(0)) EXPECT_EQ(pair.length, 0);
}

// Every point of a wall lies between floor and ceiling, so none speaks for less than the truth.
TEST(SetLength, WallsAloneTellNothingShorter) {
  for (uint32_t seed = 1; seed <= 5; ++seed) {
    MadeRoom room(DegToRad(0.05), seed);
    room.Keep(
        [](const Vector3d& point) { return point.z() > 0.01 && point.z() < kCeiling - 0.01; });
    const std::vector<PanoPair> measured = room.Measured(kCeiling - 1);
    for (size_t k = 0; k < measured.size(); ++k) {
      if (measured[k].length == 0) continue;
      EXPECT_GT(measured[k].length, 0.97 * room.pairs[k].length) << "seed " << seed;
    }
  }
}

TEST(SetLength, FewPointsOnPlanesTellNothing) {
  MadeRoom room(0, 1);
  room.Keep([](const Vector3d& point) { return point.z() == 0; });
  for (PanoPair& pair : room.pairs) pair.inliers.resize(2);
  for (const PanoPair& pair : room.Measured(0)) EXPECT_EQ(pair.length, 0);
  PanoPair pair = room.pairs.front();
  SetLength({}, kCeiling - 1, pair);
  EXPECT_EQ(pair.length, 0);
}

// Table tops may show more points than the floor, but the floor would lie below itself if they were
// it.
TEST(SetLength, TheFloorLiesBelowTheTables) {
  const double floor_log = std::log(1.5), table_log = std::log(1.5 / 0.5);
  std::vector<LengthVote> votes;
  for (int i = 0; i < 10; ++i) votes.push_back({floor_log + 0.01 * std::sin(i), 0.04, false});
  for (int i = 0; i < 12; ++i) votes.push_back({table_log + 0.01 * std::cos(i), 0.04, false});
  PanoPair pair;
  SetLength(votes, 0, pair);
  EXPECT_NEAR(pair.length, 1.5, 0.03 * 1.5);
}

// Reflections in a polished floor lie below it: some of them leave the length.
TEST(SetLength, StandsPointsBelowTheFloor) {
  const double true_log = std::log(1.5);
  std::vector<LengthVote> votes;
  for (int i = 0; i < 20; ++i) votes.push_back({true_log + 0.02 * std::sin(i), 0.04, false});
  for (int i = 0; i < 3; ++i) votes.push_back({true_log - 0.4 - 0.1 * i, 0.04, false});
  PanoPair pair;
  SetLength(votes, 0, pair);
  EXPECT_NEAR(pair.length, 1.5, 0.03 * 1.5);
  EXPECT_LT(pair.length_sigma, 0.1);
}

}  // namespace
}  // namespace enfilade
