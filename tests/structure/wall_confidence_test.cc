// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/wall_confidence.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

constexpr int kColumns = 256;
constexpr double kClear = 0.4;
const DistanceBins kBins{0.5, 0.02, 130};
const BoxRoom kRoom;
const std::vector<uint8_t> kAllSeen(kColumns, 1);

WallPath PathOf(const ColumnTruth& truth) {
  WallPath path;
  path.family = truth.family;
  path.wall_m = truth.wall_m;
  return path;
}

// The same response everywhere.
ColumnScores Uniform(float response) {
  ColumnScores scores;
  for (const size_t f : {0, 1}) {
    scores.family[f] = ImageF(kColumns, kBins.count);
    std::fill(scores.family[f].data().begin(), scores.family[f].data().end(), response);
  }
  return scores;
}

class WallConfidenceTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<float> Confidence(const ColumnScores& lines) const {
    return WallConfidence(path_, lines, kAllSeen, kBins, kClear);
  }

  const ColumnTruth truth_ = TruthOfColumns(kRoom, {1.4, 1.2}, kColumns);
  const WallPath path_ = PathOf(truth_);
};

TEST_F(WallConfidenceTest, WallsWithClearLinesAreBelievedInFull) {
  for (const float value : Confidence(PerfectScores(truth_, kBins))) EXPECT_EQ(value, 1);
}

// Each wall's share, and as much once more for the whole panorama.
TEST_F(WallConfidenceTest, IsTheShareOfAClearResponse) {
  for (const float value : Confidence(Uniform(0.1F))) EXPECT_NEAR(value, 0.25 * 0.25, 1e-6);
  for (const float value : Confidence(Uniform(-0.1F))) EXPECT_EQ(value, 0);
}

// Half of one wall is hidden: all of that wall loses, no other.
TEST_F(WallConfidenceTest, IsOneValueAWall) {
  ColumnScores lines = Uniform(0.3F);
  const int inside = kColumns / 2;  // the column that looks along +x, at the wall of family 1
  int begin = inside, end = inside;
  while (truth_.family[static_cast<size_t>(begin - 1)] == 1) --begin;
  while (truth_.family[static_cast<size_t>(end)] == 1) ++end;
  for (int c = begin; c < inside; ++c) std::fill_n(lines.family[1].row(c), kBins.count, 0.0F);
  const std::vector<float> confidence = Confidence(lines);
  const double expected = 0.75 * (end - inside) / (end - begin);
  const double mean =
      (expected * (end - begin) + 0.75 * (kColumns - end + begin)) / static_cast<double>(kColumns);
  for (int c = 0; c < kColumns; ++c) {
    EXPECT_NEAR(confidence[static_cast<size_t>(c)],
                mean * (c >= begin && c < end ? expected : 0.75), 1e-5)
        << c;
  }
}

// A pinhole picture ends in the middle of a wall.
TEST_F(WallConfidenceTest, ColumnsBesideThePictureHaveNoSay) {
  ColumnScores lines = Uniform(0.2F);
  std::vector<uint8_t> is_seen = kAllSeen;
  for (int c = kColumns / 2; c < kColumns; ++c) {
    is_seen[static_cast<size_t>(c)] = 0;
    for (const size_t f : {0, 1}) std::fill_n(lines.family[f].row(c), kBins.count, 0.0F);
  }
  const std::vector<float> confidence = WallConfidence(path_, lines, is_seen, kBins, kClear);
  for (int c = 0; c < kColumns / 2; ++c)
    EXPECT_NEAR(confidence[static_cast<size_t>(c)], 0.5 * 0.5, 1e-6);
}

TEST_F(WallConfidenceTest, TheSeamCutsNoWall) {
  // The wall towards −x lies on both sides of the first column.
  ASSERT_EQ(truth_.family.front(), truth_.family.back());
  ColumnScores lines = Uniform(0.0F);
  std::fill_n(lines.family[1].row(0), kBins.count, 1.0F);
  const std::vector<float> confidence = Confidence(lines);
  EXPECT_GT(confidence.front(), 0);
  EXPECT_EQ(confidence.front(), confidence.back());
}

TEST_F(WallConfidenceTest, ARoundWallIsOneWall) {
  WallPath round;
  round.family.assign(kColumns, kFrontalFamily);
  round.wall_m.assign(kColumns, 2.0);
  ColumnScores lines;
  lines.family[kFrontalFamily] = ImageF(kColumns, kBins.count);
  for (const float value : WallConfidence(round, lines, kAllSeen, kBins, kClear))
    EXPECT_EQ(value, 0);
}

TEST_F(WallConfidenceTest, WhereNoLinesAreLookedForAllIsBelieved) {
  for (const float value : Confidence(ColumnScores())) EXPECT_EQ(value, 1);
  for (const float value : WallConfidence(path_, Uniform(0), kAllSeen, kBins, 0))
    EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace enfilade
