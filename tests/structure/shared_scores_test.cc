// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/shared_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "enfilade/structure/types.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;

constexpr int kColumns = 512;
const DistanceBins kBins{0.3, 0.015, 200};
const Vector2d kHere(1.2, 1.1), kThere(2.9, 1.9);

// Two panoramas in one room; the scores of each are perfect.
struct Pair {
  ColumnTruth truth = TruthOfColumns(BoxRoom(), kHere, kColumns);
  std::array<ColumnScores, 2> scores = {
      PerfectScores(truth, kBins, 1, 5),
      PerfectScores(TruthOfColumns(BoxRoom(), kThere, kColumns), kBins, 1, 5)};
  std::vector<PlacedScores> views = {{kHere, scores.data()}, {kThere, &scores[1]}};
  std::vector<KnownDistances> known = {truth.wall_m,
                                       TruthOfColumns(BoxRoom(), kThere, kColumns).wall_m};
};

ColumnScores Share(const Pair& pair, const std::vector<KnownDistances>& known,
                   const ColumnScores* own_ceiling = nullptr,
                   const SharedScoresOptions& options = {}) {
  return ShareScores(pair.views, 0, std::vector<int>{1}, known, own_ceiling, 1, kBins, options);
}

int TrueBin(const Pair& pair, int column) {
  return static_cast<int>(std::lround(kBins.Bin(pair.truth.wall_m[static_cast<size_t>(column)])));
}

// Columns whose wall the other panorama sees at no flat angle, away from corners.
std::vector<int> SharedColumns(const Pair& pair) {
  std::vector<int> columns;
  for (int c = 0; c < kColumns; ++c) {
    const size_t i = static_cast<size_t>(c);
    const double azimuth = AzimuthOfColumn(c, kColumns);
    const Vector2d point =
        kHere + pair.truth.wall_m[i] * Vector2d(std::cos(azimuth), std::sin(azimuth));
    const Vector2d ray = point - kThere, own = point - kHere;
    const size_t axis = pair.truth.family[i] == 0 ? 1 : 0;
    const double along = pair.truth.family[i] == 0 ? point.x() : point.y();
    const double end = pair.truth.family[i] == 0 ? 4 : 3;
    if (std::abs(ray[static_cast<Eigen::Index>(axis)]) > 0.3 * ray.norm() &&
        std::abs(own[static_cast<Eigen::Index>(axis)]) > 0.3 * own.norm() && along > 0.2 &&
        along < end - 0.2)
      columns.push_back(c);
  }
  return columns;
}

TEST(ShareScores, SupportsTheTrueWallAndLittleElse) {
  const Pair pair;
  const ColumnScores shared = Share(pair, pair.known);
  const std::vector<int> columns = SharedColumns(pair);
  ASSERT_GT(columns.size(), 240U);
  for (const int c : columns) {
    const ImageF& score =
        shared.family[static_cast<size_t>(pair.truth.family[static_cast<size_t>(c)])];
    const int bin = TrueBin(pair, c);
    EXPECT_GT(score(c, bin), 0.5) << c;
    for (const int off : {-20, -12, 12}) {
      if (bin + off < 0 || bin + off >= kBins.count) continue;
      EXPECT_LT(score(c, bin + off), 0.5 * score(c, bin)) << c << " " << off;
    }
  }
}

TEST(ShareScores, SeeingPastContradictsUnlessTheCeilingIsReached) {
  const Pair pair;
  SharedScoresOptions options;
  options.contradiction = 0.4;
  ColumnScores everywhere;
  for (const size_t f : {0, 1}) everywhere.family[f] = ImageF(kColumns, kBins.count, 1, 1.0F);
  const ColumnScores without = Share(pair, pair.known, nullptr, options);
  const ColumnScores with = Share(pair, pair.known, &everywhere, options);
  int num_contradicted = 0;
  for (const int c : SharedColumns(pair)) {
    const size_t f = static_cast<size_t>(pair.truth.family[static_cast<size_t>(c)]);
    const int middle =
        static_cast<int>(std::lround(kBins.Bin(0.5 * pair.truth.wall_m[static_cast<size_t>(c)])));
    if (middle < 0) continue;
    num_contradicted += without.family[f](c, middle) < -0.39F;
    EXPECT_GE(with.family[f](c, middle), 0) << c;
    EXPECT_GT(without.family[f](c, TrueBin(pair, c)), 0) << c;
  }
  EXPECT_GT(num_contradicted, 120);
}

TEST(ShareScores, NobodyIsAskedAboutWhatItCannotSee) {
  // The other panorama's walls are known to be near: it sees nothing of this room.
  const Pair pair;
  std::vector<KnownDistances> known = pair.known;
  known[1].assign(kColumns, 0.1);
  const ColumnScores shared = Share(pair, known);
  for (const int c : SharedColumns(pair)) {
    const double azimuth = AzimuthOfColumn(c, kColumns);
    const Vector2d point = kHere + pair.truth.wall_m[static_cast<size_t>(c)] *
                                       Vector2d(std::cos(azimuth), std::sin(azimuth));
    if ((point - kThere).norm() < 0.4) continue;
    EXPECT_EQ(shared.family[static_cast<size_t>(pair.truth.family[static_cast<size_t>(c)])](
                  c, TrueBin(pair, c)),
              0)
        << c;
  }
}

TEST(ShareScores, AloneAPanoramaHearsNothing) {
  const Pair pair;
  const ColumnScores shared =
      ShareScores(pair.views, 0, {}, pair.known, nullptr, 1, kBins, SharedScoresOptions());
  for (const size_t f : {0, 1}) {
    for (const float value : shared.family[f].data()) EXPECT_EQ(value, 0);
  }
}

TEST(ShareOfPath, IsTheMeanOfTheSharedScoresAlongIt) {
  const Pair pair;
  WallPath path;
  path.family = pair.truth.family;
  path.wall_m.resize(kColumns);
  for (int c = 0; c < kColumns; ++c)
    path.wall_m[static_cast<size_t>(c)] = kBins.Distance(TrueBin(pair, c));
  const ColumnScores shared = Share(pair, pair.known);
  double sum = 0;
  for (int c = 0; c < kColumns; ++c)
    sum += shared.family[static_cast<size_t>(path.family[static_cast<size_t>(c)])](
        c, TrueBin(pair, c));
  EXPECT_NEAR(ShareOfPath(pair.views, 0, path, std::vector<int>{1}, pair.known, kBins, {}),
              sum / kColumns, 1e-6);
}

TEST(ShareOfPath, IsBestForTheTrueScale) {
  // Walls that are 6 % too far all round contradict those of the other panorama.
  const Pair pair;
  const auto share = [&](double scale) {
    WallPath path;
    path.family = pair.truth.family;
    for (const double r : pair.truth.wall_m) path.wall_m.push_back(scale * r);
    return ShareOfPath(pair.views, 0, path, std::vector<int>{1}, pair.known, kBins, {});
  };
  EXPECT_GT(share(1.0), 2 * share(1.06));
  EXPECT_GT(share(1.0), 2 * share(0.94));
}

TEST(NearestOthers, AreSortedAndLeaveOutOneself) {
  const std::vector<Vector2d> positions = {{0, 0}, {3, 0}, {1, 0}, {-2, 0}};
  EXPECT_EQ(NearestOthers(positions, 0), (std::vector<int>{2, 3, 1}));
  EXPECT_EQ(NearestOthers(positions, 1), (std::vector<int>{2, 0, 3}));
  EXPECT_TRUE(NearestOthers({positions.data(), 1}, 0).empty());
}

}  // namespace
}  // namespace enfilade
