// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/strip_correlation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;

constexpr int kColumns = 64;
constexpr std::array kAxisFamilies = {0, 1};
const DistanceBins kBins{0.5, 0.02, 130};
const Vector3d kHere(1.4, 1.2, 1.4), kThere(2.6, 1.7, 1.4);

std::vector<StripTable> MakeTables(const BoxRoom& room, double noise) {
  std::vector<StripTable> tables;
  int seed = 1;
  for (const Vector3d& position : {kHere, kThere}) {
    tables.emplace_back(DrawPanorama(room, position, StripTable::kNumAzimuths, noise, seed++, 1),
                        0.3, 2.1, kBins);
  }
  return tables;
}

ColumnScores Correlate(const std::vector<StripTable>& tables,
                       const std::vector<KnownDistances>& known,
                       const std::vector<int>& others = {1}) {
  return CorrelateStrips(tables, 0, others, known, kColumns, 1, kAxisFamilies, kBins, {});
}

const std::vector<KnownDistances> kNothingKnown(2);

// Columns whose whole strip lies on one wall, seen from both cameras at no flat angle.
std::vector<int> ComparableColumns(const ColumnTruth& truth) {
  std::vector<int> columns;
  for (int c = 0; c < kColumns; ++c) {
    const size_t i = static_cast<size_t>(c);
    const bool is_inner =
        truth.family[static_cast<size_t>((c + 2) % kColumns)] == truth.family[i] &&
        truth.family[static_cast<size_t>((c + kColumns - 2) % kColumns)] == truth.family[i];
    const double azimuth = AzimuthOfColumn(c, kColumns);
    const Eigen::Vector2d point =
        kHere.head<2>() + truth.wall_m[i] * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
    const Eigen::Vector2d ray = point - kThere.head<2>();
    const double depth = truth.family[i] == 0 ? std::abs(ray.y()) : std::abs(ray.x());
    if (is_inner && depth > 0.4 * ray.norm()) columns.push_back(c);
  }
  return columns;
}

TEST(CorrelateStrips, PeaksAtTheTrueDistanceOfATexturedWall) {
  BoxRoom room;
  room.wall_texture = 40;
  const ColumnTruth truth = TruthOfColumns(room, kHere.head<2>(), kColumns);
  const ColumnScores scores = Correlate(MakeTables(room, 2), kNothingKnown);
  std::vector<double> errors;
  double at_truth = 0;
  const std::vector<int> columns = ComparableColumns(truth);
  for (const int c : columns) {
    const size_t i = static_cast<size_t>(c);
    const float* row = scores.family[static_cast<size_t>(truth.family[i])].row(c);
    const double best = static_cast<double>(std::max_element(row, row + kBins.count) - row);
    errors.push_back(std::abs(kBins.Distance(best) / truth.wall_m[i] - 1));
    at_truth += row[std::lround(kBins.Bin(truth.wall_m[i]))] / static_cast<double>(columns.size());
  }
  ASSERT_GT(columns.size(), 25u);
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.02);
  EXPECT_LT(errors[errors.size() * 8 / 10], 0.05);
  EXPECT_GT(at_truth, 0.85);
}

// Expects low scores everywhere along the walls that both cameras see.
void ExpectSilence(const BoxRoom& room, double limit) {
  const ColumnTruth truth = TruthOfColumns(room, kHere.head<2>(), kColumns);
  const ColumnScores scores = Correlate(MakeTables(room, 1), kNothingKnown);
  for (const int c : ComparableColumns(truth)) {
    const size_t i = static_cast<size_t>(c);
    EXPECT_LT(std::abs(scores.family[static_cast<size_t>(truth.family[i])](
                  c, static_cast<int>(std::lround(kBins.Bin(truth.wall_m[i]))))),
              limit)
        << c;
  }
}

TEST(CorrelateStrips, ABlankWallSaysNothing) { ExpectSilence(BoxRoom(), 0.15); }

// It would agree with itself on every plane nearby.
TEST(CorrelateStrips, SlowShadingOfABareWallSaysNothing) {
  BoxRoom room;
  room.wall_slope = 15;
  ExpectSilence(room, 0.15);
}

TEST(CorrelateStrips, PointsBehindTheOthersWallsAreNotCompared) {
  BoxRoom room;
  room.wall_texture = 40;
  const std::vector<StripTable> tables = MakeTables(room, 2);
  const double nearest_wall = 0.5;
  const ColumnScores scores = Correlate(tables, {{}, KnownDistances(32, nearest_wall)});
  for (const int f : kAxisFamilies) {
    for (int c = 0; c < kColumns; ++c) {
      const double azimuth = AzimuthOfColumn(c, kColumns);
      for (int b = 0; b < kBins.count; ++b) {
        const Eigen::Vector2d point =
            kHere.head<2>() +
            kBins.Distance(b) * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth));
        // Half a metre, and some slack as walls are not known well.
        if ((point - kThere.head<2>()).norm() > nearest_wall + 0.3) {
          ASSERT_EQ(scores.family[static_cast<size_t>(f)](c, b), 0) << f << ", " << c << ", " << b;
        }
      }
    }
  }
}

TEST(CorrelateStrips, TrueKnownDistancesHideNoTrueWall) {
  BoxRoom room;
  room.wall_texture = 40;
  const std::vector<StripTable> tables = MakeTables(room, 2);
  const ColumnTruth truth = TruthOfColumns(room, kHere.head<2>(), kColumns);
  const ColumnScores free = Correlate(tables, kNothingKnown);
  const ColumnScores known =
      Correlate(tables, {{}, TruthOfColumns(room, kThere.head<2>(), 256).wall_m});
  for (const int c : ComparableColumns(truth)) {
    const size_t i = static_cast<size_t>(c), f = static_cast<size_t>(truth.family[i]);
    const int bin = static_cast<int>(std::lround(kBins.Bin(truth.wall_m[i])));
    EXPECT_FLOAT_EQ(known.family[f](c, bin), free.family[f](c, bin)) << c;
  }
}

TEST(CorrelateStrips, AloneThereIsNothingToCompare) {
  BoxRoom room;
  room.wall_texture = 40;
  const ColumnScores scores = Correlate(MakeTables(room, 2), kNothingKnown, {});
  for (const int f : kAxisFamilies) {
    for (const float value : scores.family[static_cast<size_t>(f)].data()) ASSERT_EQ(value, 0);
  }
  EXPECT_TRUE(scores.family[kFrontalFamily].empty());
}

TEST(CorrelateStrips, ColumnsBetweenStepsRepeat) {
  BoxRoom room;
  room.wall_texture = 40;
  const std::vector<StripTable> tables = MakeTables(room, 2);
  const ColumnScores scores = CorrelateStrips(tables, 0, std::array{1}, kNothingKnown, kColumns, 4,
                                              kAxisFamilies, kBins, {});
  for (int c = 0; c < kColumns; ++c) {
    for (int b = 0; b < kBins.count; ++b) {
      ASSERT_EQ(scores.family[0](c, b), scores.family[0](c / 4 * 4, b));
    }
  }
}

}  // namespace
}  // namespace enfilade
