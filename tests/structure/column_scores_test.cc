// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/column_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

constexpr int kRows = 1024;
constexpr double kCamera_m = 1.435;

// Columns whose wall, of family 0, stands at the distances given.
ColumnTruth WallsAt(std::vector<double> distances_m) {
  ColumnTruth truth;
  truth.family.assign(distances_m.size(), 0);
  truth.wall_m = std::move(distances_m);
  return truth;
}

double PeakDistance(const ColumnScores& scores, const DistanceBins& bins, int column) {
  const float* row = scores.family[0].row(column);
  return bins.Distance(static_cast<double>(std::max_element(row, row + bins.count) - row));
}

TEST(DistanceBins, DistanceAndBinAreInverse) {
  const DistanceBins bins;
  for (const double bin : {-3.0, 0.0, 17.25, 279.0}) {
    EXPECT_NEAR(bins.Bin(bins.Distance(bin)), bin, 1e-9);
  }
  const std::vector<double> centers = bins.Centers();
  ASSERT_EQ(centers.size(), 280u);
  EXPECT_DOUBLE_EQ(centers[0], 0.3);
  EXPECT_DOUBLE_EQ(centers[100], bins.Distance(100));
}

TEST(ScoreLine, PeaksAtTheTrueDistance) {
  const DistanceBins bins;
  const ColumnTruth truth = WallsAt({0.6, 1.0, 2.0, 3.5, 6.0});
  for (const double height_m : {-kCamera_m, 1.1}) {
    const ColumnScores scores =
        ScoreLine(PerfectResponse(truth, kRows, {height_m}), -height_m, bins);
    for (int c = 0; c < 5; ++c) {
      const double distance = truth.wall_m[static_cast<size_t>(c)];
      // Half a bin, and what one row of the picture is worth at this distance.
      const double row_share =
          kPi / kRows * (distance / std::abs(height_m) + std::abs(height_m) / distance);
      EXPECT_NEAR(PeakDistance(scores, bins, c) / distance, 1, 0.0075 + row_share / 2) << distance;
    }
  }
}

TEST(ScoreLine, NearBinsTakeTheStrongestOfTheirRows) {
  // Between the rows of two neighbouring bins lie several rows; the line may be in any of them.
  const DistanceBins bins{0.4, 0.05, 60};
  LineResponse response{std::vector<ImageU8>(kNumFamilies)};
  response.family[0] = ImageU8(kRows, 1);
  for (double distance = 0.6; distance < 1.2; distance += 0.013) {
    ImageU8 picture(kRows, 1);
    picture(static_cast<int>(kRows * (0.5 + std::atan(kCamera_m / distance) / kPi)), 0) = 255;
    response.family[0] = picture;
    const ColumnScores scores = ScoreLine(response, kCamera_m, bins);
    EXPECT_NEAR(PeakDistance(scores, bins, 0) / distance, 1, 0.03) << distance;
  }
}

TEST(ScoreLine, LeavesOutFamiliesWithoutResponse) {
  const ColumnScores scores =
      ScoreLine(PerfectResponse(WallsAt({2, 3}), 128, {-1.4}), 1.4, DistanceBins());
  EXPECT_EQ(scores.family[0].rows(), 2);
  EXPECT_TRUE(scores.family[2].empty());
  EXPECT_TRUE(scores.family[kFrontalFamily].empty());
}

// Between floor and wall lies a baseboard of 5.5 cm whose upper edge is the stronger line.
class DoubleEdge : public ::testing::Test {
 protected:
  DoubleEdge() {
    response_ = PerfectResponse(truth_, kRows, {-kCamera_m + kBaseboard_m});
    const LineResponse lower = PerfectResponse(truth_, kRows, {-kCamera_m});
    for (size_t i = 0; i < response_.family[0].data().size(); ++i) {
      uint8_t& value = response_.family[0].data()[i];
      value = std::max<uint8_t>(value, lower.family[0].data()[i] / 2);
    }
  }

  static constexpr double kBaseboard_m = 0.055;
  DistanceBins bins_;
  ColumnTruth truth_ = WallsAt({1.5, 2.0, 2.5, 3.0});
  LineResponse response_;
};

TEST_F(DoubleEdge, OneLineAloneIsBiased) {
  const ColumnScores single = ScoreFloor(response_, kCamera_m, {}, bins_);
  for (int c = 0; c < 4; ++c) {
    // The upper edge is taken for the floor line: h / (h − b) = 1.04.
    EXPECT_NEAR(PeakDistance(single, bins_, c) / truth_.wall_m[static_cast<size_t>(c)],
                kCamera_m / (kCamera_m - kBaseboard_m), 0.012);
  }
}

TEST_F(DoubleEdge, BothLinesTogetherAreNot) {
  const ColumnScores both = ScoreFloor(response_, kCamera_m, {kBaseboard_m, 0.5}, bins_);
  for (int c = 0; c < 4; ++c) {
    EXPECT_NEAR(PeakDistance(both, bins_, c) / truth_.wall_m[static_cast<size_t>(c)], 1, 0.012);
  }
}

TEST_F(DoubleEdge, EachLineCountsByItsShare) {
  const ColumnScores lower = ScoreLine(response_, kCamera_m, bins_),
                     upper = ScoreLine(response_, kCamera_m - kBaseboard_m, bins_),
                     both = ScoreFloor(response_, kCamera_m, {kBaseboard_m, 0.2}, bins_);
  for (int b = 0; b < bins_.count; ++b) {
    EXPECT_NEAR(both.family[0](1, b), 0.8F * lower.family[0](1, b) + 0.2F * upper.family[0](1, b),
                1e-6F);
  }
}

TEST(WidenScores, TakesTheStrongestNearby) {
  ColumnScores scores;
  scores.family[1] = ImageF(3, 40);
  for (size_t i = 0; i < scores.family[1].data().size(); ++i)
    scores.family[1].data()[i] = static_cast<float>(i * 2654435761u % 1000) / 1000;
  const ColumnScores wide = WidenScores(scores, 2);
  EXPECT_TRUE(wide.family[0].empty());
  for (int c = 0; c < 3; ++c) {
    for (int b = 0; b < 40; ++b) {
      float strongest = 0;
      for (int i = std::max(0, b - 2); i <= std::min(39, b + 2); ++i)
        strongest = std::max(strongest, scores.family[1](c, i));
      EXPECT_EQ(wide.family[1](c, b), strongest);
    }
  }
  EXPECT_EQ(WidenScores(scores, 0).family[1].data(), scores.family[1].data());
}

// One panorama of 64 columns over a floor: lines of the two axes at single distances.
class FloorLines : public ::testing::Test {
 protected:
  FloorLines() {
    for (const size_t f : {0, 1}) floor_.family[f] = ImageF(kColumns, bins_.count);
  }

  [[nodiscard]] int Bin(double distance_m) const {
    return static_cast<int>(std::lround(bins_.Bin(distance_m)));
  }
  void Draw(int family, int column, double distance_m, float response) {
    floor_.family[static_cast<size_t>(family)](column, Bin(distance_m)) = response;
  }
  [[nodiscard]] float Stopped(int family, int column, double distance_m) const {
    return StopFloorLines(floor_, 1.5, bins_, {0.8, 1.2})
        .family[static_cast<size_t>(family)](column, Bin(distance_m));
  }

  static constexpr int kColumns = 64;
  static constexpr int kDiagonal = 40;  // looks along 45 degrees: both axes lean in the picture
  static constexpr int kSquare = 47;    // looks square on a wall of family 0
  DistanceBins bins_;
  ColumnScores floor_;
};

TEST_F(FloorLines, KeepTheirScoreWhereTheFloorEnds) {
  Draw(0, kDiagonal, 2.0, 0.9F);
  Draw(0, kDiagonal, 2.5, 0.7F);   // along the wall: a sill
  Draw(1, kDiagonal, 1.5, 0.7F);   // a joint on the floor before it
  Draw(1, kDiagonal, 2.05, 0.7F);  // too near to tell from the line itself
  Draw(1, kDiagonal, 3.6, 0.7F);   // far behind it
  EXPECT_FLOAT_EQ(Stopped(0, kDiagonal, 2.0), 0.9F);
}

TEST_F(FloorLines, LoseItWhereTheFloorGoesOn) {
  Draw(0, kDiagonal, 2.0, 0.9F);
  Draw(1, kDiagonal, 2.6, 0.5F);
  EXPECT_FLOAT_EQ(Stopped(0, kDiagonal, 2.0), 0.9F * (1 - 0.8F * 0.5F));
}

TEST_F(FloorLines, AreNotStoppedByWhatMayBeAnUprightLineOfTheWall) {
  Draw(0, kSquare, 2.0, 0.9F);
  Draw(1, kSquare, 2.6, 1.0F);
  EXPECT_FLOAT_EQ(Stopped(0, kSquare, 2.0), 0.9F);
}

// One column of ceiling lines.
class CeilingLines : public ::testing::Test {
 protected:
  CeilingLines() {
    for (const size_t f : {0, 1, 2}) ceiling_.family[f] = ImageF(1, bins_.count);
  }

  void Draw(int family, double distance_m, float response) {
    ceiling_.family[static_cast<size_t>(family)](0, bins_.NearestBin(distance_m)) = response;
  }
  [[nodiscard]] float Kept(double distance_m) const {
    return CeilingEnds(ceiling_, bins_, {0.8, 2.5, 0.7})(0, bins_.NearestBin(distance_m));
  }

  DistanceBins bins_;
  ColumnScores ceiling_;
};

TEST_F(CeilingLines, EndTheCeilingAtTheirWall) {
  Draw(0, 2.0, 0.9F);
  EXPECT_FLOAT_EQ(Kept(2.0), 1);
  EXPECT_FLOAT_EQ(Kept(2.1), 1);  // still its own line
  EXPECT_FLOAT_EQ(Kept(2.5), 1);  // hidden: nothing is known of it
  EXPECT_FLOAT_EQ(Kept(4.0), 1);
}

TEST_F(CeilingLines, TakeFromWhatStandsBelowTheCeiling) {
  Draw(1, 2.0, 0.9F);
  EXPECT_FLOAT_EQ(Kept(1.2), 1 - 0.8F * 0.9F);
  Draw(0, 1.2, 0.3F);
  EXPECT_FLOAT_EQ(Kept(1.2), 1 - 0.8F * 0.6F);
  Draw(2, 1.2, 0.5F);  // an oblique wall ends the ceiling as well
  EXPECT_FLOAT_EQ(Kept(1.2), 1 - 0.8F * 0.4F);
}

TEST_F(CeilingLines, LeaveAWallBehindABulkheadAlone) {
  Draw(0, 2.0, 0.8F);  // the bulkhead's front, under the ceiling
  Draw(0, 3.2, 0.8F);  // its lower edge on the wall at 2.4 m, taken for a ceiling's line
  EXPECT_FLOAT_EQ(Kept(2.4), 1);
}

TEST_F(CeilingLines, TellNothingFromAfar) {
  Draw(0, 4.0, 0.9F);
  EXPECT_FLOAT_EQ(Kept(1.2), 1);
  Draw(2, 3.0, 0.9F);  // what runs across the axes is no wall's
  EXPECT_FLOAT_EQ(Kept(1.2), 1);
}

TEST(ScaleScores, TakesFromWhatSpeaksForAWallOnly) {
  ColumnScores scores;
  scores.family[1] = ImageF(1, 2);
  scores.family[1](0, 0) = 0.5F;
  scores.family[1](0, 1) = -0.5F;
  ScaleScores(ImageF(1, 2, 1, 0.25F), scores);
  EXPECT_FLOAT_EQ(scores.family[1](0, 0), 0.125F);
  EXPECT_FLOAT_EQ(scores.family[1](0, 1), -0.5F);
  EXPECT_TRUE(scores.family[0].empty());
}

TEST(AllowObstacles, AWallMayStandBehindTheLineAtACost) {
  const DistanceBins bins;
  const ObstacleOptions options;
  ColumnScores floor;
  floor.family[0] = ImageF(1, bins.count);
  const int line = static_cast<int>(std::lround(bins.Bin(2.0)));
  floor.family[0](0, line) = 1;
  const ColumnScores allowed = AllowObstacles(floor, bins, options);
  const auto at = [&](double distance) {
    return allowed.family[0](0, static_cast<int>(std::lround(bins.Bin(distance))));
  };
  EXPECT_FLOAT_EQ(at(2.0), 1);
  EXPECT_FLOAT_EQ(at(2.5), 1 - static_cast<float>(options.cost));
  EXPECT_FLOAT_EQ(at(2.1), 0);  // too near to tell apart
  EXPECT_FLOAT_EQ(at(3.0), 0);  // too deep for furniture
  EXPECT_FLOAT_EQ(at(1.5), 0);  // nothing stands behind the wall
  EXPECT_TRUE(allowed.family[1].empty());
}

TEST(AllowObstacles, NeverLowersAScore) {
  const DistanceBins bins{0.3, 0.05, 70};
  ColumnScores floor;
  floor.family[1] = ImageF(3, bins.count);
  for (size_t i = 0; i < floor.family[1].data().size(); ++i) {
    floor.family[1].data()[i] = static_cast<float>(i * 2654435761u % 1000) / 1000;
  }
  const ColumnScores allowed = AllowObstacles(floor, bins, {});
  for (size_t i = 0; i < floor.family[1].data().size(); ++i) {
    EXPECT_GE(allowed.family[1].data()[i], floor.family[1].data()[i]);
  }
}

TEST(AddScores, AddsWeighedAndBeginsAtZero) {
  ColumnScores a, b, sum;
  a.family[0] = ImageF(2, 3, 1, 2.0F);
  b.family[0] = ImageF(2, 3, 1, 10.0F);
  b.family[2] = ImageF(2, 3, 1, 4.0F);
  AddScores(a, 1, sum);
  AddScores(b, 0.5, sum);
  EXPECT_FLOAT_EQ(sum.family[0](1, 2), 7);
  EXPECT_FLOAT_EQ(sum.family[2](0, 0), 2);
  EXPECT_TRUE(sum.family[1].empty());
}

TEST(AddScores, RefusesPicturesOfDifferentSize) {
  ColumnScores a, b;
  a.family[0] = ImageF(2, 3);
  b.family[0] = ImageF(2, 4);
  EXPECT_THROW(AddScores(a, 1, b), std::logic_error);
}

}  // namespace
}  // namespace enfilade
