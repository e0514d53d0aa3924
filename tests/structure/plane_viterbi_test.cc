// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/plane_viterbi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "enfilade/structure/types.h"
#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

// The brute-force twin: every state, every transition, every start.

constexpr double kNever = -1e8;

// Best score of a closed path, and for each column and state the best closed path through it.
class BruteForce {
 public:
  BruteForce(const ColumnScores& scores, const DistanceBins& bins,
             const PlaneViterbiOptions& options)
      : bins_(bins), options_(options) {
    for (int f = 0; f < kNumFamilies; ++f) {
      const ImageF& picture = scores.family[static_cast<size_t>(f)];
      if (picture.empty()) continue;
      families_.push_back(f);
      num_columns_ = picture.rows();
    }
    num_states_ = static_cast<int>(families_.size()) * bins.count;
    emission_.resize(static_cast<size_t>(num_columns_));
    for (int c = 0; c < num_columns_; ++c) {
      for (int s = 0; s < num_states_; ++s) {
        emission_[static_cast<size_t>(c)].push_back(Emission(scores, c, s));
      }
      const double boundary = AzimuthOfColumn(c, num_columns_) + kPi / num_columns_;
      cost_.emplace_back();
      for (int b = 0; b < num_states_; ++b) {
        for (int a = 0; a < num_states_; ++a) cost_.back().push_back(Cost(a, b, boundary));
      }
    }
  }

  // Best closed path through state `s` in column `c`.
  [[nodiscard]] double BestThrough(int c, int s) const {
    std::vector<double> best(static_cast<size_t>(num_states_), kNever);
    best[static_cast<size_t>(s)] = 0;
    for (int i = 0; i < num_columns_; ++i) {
      const std::vector<double>& cost = cost_[static_cast<size_t>((c + i) % num_columns_)];
      const std::vector<double>& emission =
          emission_[static_cast<size_t>((c + i + 1) % num_columns_)];
      std::vector<double> next(best.size(), kNever);
      for (size_t to = 0; to < next.size(); ++to) {
        for (size_t from = 0; from < best.size(); ++from) {
          next[to] = std::max(next[to], best[from] - cost[to * best.size() + from] + emission[to]);
        }
      }
      best = std::move(next);
    }
    return best[static_cast<size_t>(s)];
  }

  [[nodiscard]] double Best() const {
    double best = kNever;
    for (int s = 0; s < num_states_; ++s) best = std::max(best, BestThrough(0, s));
    return best;
  }

  // For each bin of distance in a column, the best closed path with its wall in that bin.
  [[nodiscard]] std::vector<double> BestOfBins(int column) const {
    std::vector<double> best(static_cast<size_t>(bins_.count), kNever);
    for (int s = 0; s < num_states_; ++s) {
      const double azimuth = AzimuthOfColumn(column, num_columns_);
      const int64_t bin = std::lround(s % bins_.count + Shift(Family(s), azimuth));
      if (bin >= bins_.count) continue;
      double& value = best[static_cast<size_t>(bin)];
      value = std::max(value, BestThrough(column, s));
    }
    return best;
  }

 private:
  [[nodiscard]] int Family(int state) const {
    return families_[static_cast<size_t>(state / bins_.count)];
  }

  // Bins by which a plane lies farther in a column than its offset.
  [[nodiscard]] double Shift(int family, double azimuth) const {
    if (family == kFrontalFamily) return 0;
    const double incidence = std::abs(std::sin(azimuth - WallDirection(family, azimuth)));
    return incidence < 0.04 ? bins_.count : std::log(1 / incidence) / bins_.log_step;
  }

  [[nodiscard]] double Emission(const ColumnScores& scores, int column, int state) const {
    const int family = Family(state);
    const double bin = state % bins_.count + Shift(family, AzimuthOfColumn(column, num_columns_));
    const int low = static_cast<int>(std::floor(bin));
    if (low + 1 >= bins_.count) return kNever;
    const float* row = scores.family[static_cast<size_t>(family)].row(column);
    const double score = row[low] + (bin - low) * (row[low + 1] - row[low]);
    const double cost = family == kFrontalFamily ? options_.frontal_cost
                        : family >= 2            ? options_.diagonal_cost
                                                 : 0;
    return 360.0 / num_columns_ * (score - cost);
  }

  [[nodiscard]] double Cost(int a, int b, double boundary) const {
    const int bin_a = a % bins_.count, bin_b = b % bins_.count;
    const int family_a = Family(a), family_b = Family(b);
    if (a == b) return 0;
    double cost = options_.jump_cost_deg;
    if (family_a == family_b) {
      if (family_a == kFrontalFamily && std::abs(bin_a - bin_b) == 1) {
        cost = std::min(cost, options_.frontal_step_cost);
      }
      return cost;
    }
    // A corner: both planes at one distance at the boundary, to within a bin.
    const int64_t meeting =
        bin_b + std::lround(Shift(family_b, boundary) - Shift(family_a, boundary));
    if (std::abs(meeting - bin_a) <= 1) cost = std::min(cost, options_.corner_cost_deg);
    return cost;
  }

  DistanceBins bins_;
  PlaneViterbiOptions options_;
  std::vector<int> families_;
  int num_columns_ = 0, num_states_ = 0;
  std::vector<std::vector<double>> emission_;  // column, state
  std::vector<std::vector<double>> cost_;      // boundary after the column, to · states + from
};

ColumnScores RandomScores(std::span<const int> families, int num_columns, int num_bins, int seed) {
  std::mt19937 random(static_cast<uint32_t>(seed));
  ColumnScores scores;
  for (const int f : families) {
    ImageF picture(num_columns, num_bins);
    for (float& value : picture.data()) value = static_cast<float>(random() % 1000) / 1000;
    scores.family[static_cast<size_t>(f)] = std::move(picture);
  }
  return scores;
}

constexpr std::array kAllFamilies = {0, 1, 2, 3, 4};
const DistanceBins kFewBins{0.5, 0.3, 9};

TEST(FindWallPath, NeverBeatsBruteForceAndMostlyEqualsIt) {
  int num_equal = 0;
  constexpr int kNumCases = 60;
  for (int seed = 0; seed < kNumCases; ++seed) {
    const int num_columns = 4 + seed % 4;
    const ColumnScores scores = RandomScores(kAllFamilies, num_columns, kFewBins.count, seed);
    const double score = FindWallPath(scores, kFewBins, {}, false).score;
    const double best = BruteForce(scores, kFewBins, {}).Best();
    EXPECT_LT(score, best + 1e-3) << seed;
    num_equal += score > best - 1e-3;
  }
  // Pure noise has no certain column, so the closure is not always the best one.
  EXPECT_GE(num_equal, kNumCases * 2 / 3);
}

// Problems in which one column is beyond doubt: there the closure is exact.
class PlantedWall : public ::testing::TestWithParam<int> {
 protected:
  PlantedWall()
      : scores_(RandomScores(kAllFamilies, 5 + GetParam() % 3, kFewBins.count, GetParam())) {
    ImageF& frontal = scores_.family[kFrontalFamily];
    const int column = GetParam() % frontal.rows(), bin = 1 + GetParam() % 7;
    frontal(column, bin) = 8;
  }

  ColumnScores scores_;
};

TEST_P(PlantedWall, ScoreEqualsBruteForce) {
  EXPECT_NEAR(FindWallPath(scores_, kFewBins, {}, false).score,
              BruteForce(scores_, kFewBins, {}).Best(), 2e-3);
}

TEST_P(PlantedWall, LikelihoodsAreTheMaxMarginals) {
  const PlaneViterbiOptions options;
  const WallPath path = FindWallPath(scores_, kFewBins, options, true);
  const BruteForce brute(scores_, kFewBins, options);
  const double best = brute.Best();
  // Paths past the planted wall lose this much at least; they are not closed exactly.
  constexpr double kAvoidsPlanted = -100;
  for (int c = 0; c < path.log_likelihood.rows(); ++c) {
    const std::vector<double> through = brute.BestOfBins(c);
    for (int b = 0; b < kFewBins.count; ++b) {
      const double expected = (through[static_cast<size_t>(b)] - best) / options.temperature_deg;
      if (expected < kAvoidsPlanted) {
        EXPECT_LT(path.log_likelihood(c, b), kAvoidsPlanted) << c << ", " << b;
      } else {
        EXPECT_NEAR(path.log_likelihood(c, b), expected, 2e-2) << c << ", " << b;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PlantedWall, ::testing::Range(0, 12));

// Rooms

constexpr int kColumns = 256;
const DistanceBins kBins{0.3, 0.015, 240};

double WorstRelativeError(const WallPath& path, const ColumnTruth& truth, int around_corners) {
  double worst = 0;
  for (int c = 0; c < kColumns; ++c) {
    bool is_near_corner = false;
    for (int d = -around_corners; d <= around_corners; ++d) {
      is_near_corner |= truth.family[static_cast<size_t>((c + d + kColumns) % kColumns)] !=
                        truth.family[static_cast<size_t>(c)];
    }
    if (is_near_corner) continue;
    const size_t i = static_cast<size_t>(c);
    worst = std::max(worst, std::abs(path.wall_m[i] / truth.wall_m[i] - 1));
    EXPECT_EQ(path.family[i], truth.family[i]) << c;
  }
  return worst;
}

TEST(FindWallPath, RoomsFromPerfectScoresAreExact) {
  for (const Eigen::Vector2d& camera :
       {Eigen::Vector2d(2, 1.5), Eigen::Vector2d(0.7, 0.6), Eigen::Vector2d(3.1, 2.2)}) {
    BoxRoom room;
    const ColumnTruth truth = TruthOfColumns(room, camera, kColumns);
    const WallPath path = FindWallPath(PerfectScores(truth, kBins), kBins, {}, false);
    EXPECT_LT(WorstRelativeError(path, truth, 1), 0.004) << camera.transpose();
  }
}

TEST(FindWallPath, AWallIsCarriedAcrossColumnsThatSawNothing) {
  const ColumnTruth truth = TruthOfColumns({}, {2, 1.5}, kColumns);
  ColumnScores scores = PerfectScores(truth, kBins);
  for (int c = 120; c < 136; ++c) {  // 22° in the middle of the wall towards +x
    for (int f : {0, 1}) {
      std::fill_n(scores.family[static_cast<size_t>(f)].row(c), kBins.count, 0.0F);
    }
  }
  EXPECT_LT(WorstRelativeError(FindWallPath(scores, kBins, {}, false), truth, 1), 0.004);
}

TEST(FindWallPath, FollowsAJumpInDepth) {
  // The columns towards +x look through a gap into a further room.
  ColumnTruth truth = TruthOfColumns({}, {2, 1.5}, kColumns);
  for (int c = 114; c < 142; ++c) {
    truth.wall_m[static_cast<size_t>(c)] *= 1.8;
  }
  const WallPath path = FindWallPath(PerfectScores(truth, kBins), kBins, {}, false);
  EXPECT_LT(WorstRelativeError(path, truth, 1), 0.004);
}

TEST(FindWallPath, AQuarterTurnOfTheColumnsTurnsThePath) {
  const ColumnTruth truth = TruthOfColumns({}, {1.1, 1.9}, kColumns);
  ColumnScores scores = PerfectScores(truth, kBins, 0.7);
  for (const int f : {0, 1, 2, 3, 4}) {
    const ColumnScores noise = RandomScores(std::array{f}, kColumns, kBins.count, 40 + f);
    AddScores(noise, 0.3, scores);
  }
  ColumnScores turned;
  constexpr std::array kFamilyAfterTurn = {1, 0, 3, 2, 4};
  for (size_t f = 0; f < kNumFamilies; ++f) {
    ImageF picture(kColumns, kBins.count);
    for (int c = 0; c < kColumns; ++c) {
      std::copy_n(scores.family[f].row(c), kBins.count, picture.row((c + kColumns / 4) % kColumns));
    }
    turned.family[static_cast<size_t>(kFamilyAfterTurn[f])] = std::move(picture);
  }
  const WallPath path = FindWallPath(scores, kBins, {}, true);
  const WallPath path_turned = FindWallPath(turned, kBins, {}, true);
  EXPECT_NEAR(path.score, path_turned.score, 0.02);
  for (int c = 0; c < kColumns; ++c) {
    const int t = (c + kColumns / 4) % kColumns;
    EXPECT_EQ(path_turned.family[static_cast<size_t>(t)],
              kFamilyAfterTurn[static_cast<size_t>(path.family[static_cast<size_t>(c)])]);
    EXPECT_NEAR(path_turned.wall_m[static_cast<size_t>(t)], path.wall_m[static_cast<size_t>(c)],
                1e-3);
    for (int b = 0; b < kBins.count; b += 7) {
      EXPECT_NEAR(std::exp(path_turned.log_likelihood(t, b)), std::exp(path.log_likelihood(c, b)),
                  0.02);
    }
  }
}

TEST(FindWallPath, LikelihoodRowsPeakAtZeroNearThePath) {
  const ColumnTruth truth = TruthOfColumns({}, {2.4, 1.2}, kColumns);
  ColumnScores scores = PerfectScores(truth, kBins);
  AddScores(RandomScores(std::array{0, 1, 4}, kColumns, kBins.count, 5), 0.2, scores);
  const WallPath path = FindWallPath(scores, kBins, {}, true);
  ASSERT_EQ(path.log_likelihood.rows(), kColumns);
  ASSERT_EQ(path.log_likelihood.cols(), kBins.count);
  for (int c = 0; c < kColumns; ++c) {
    const float* row = path.log_likelihood.row(c);
    const float* top = std::max_element(row, row + kBins.count);
    EXPECT_EQ(*top, 0);
    EXPECT_NEAR(static_cast<double>(top - row), kBins.Bin(path.wall_m[static_cast<size_t>(c)]),
                1.5);
  }
}

TEST(FindWallPath, LikelihoodSpreadsOverTwoWallsThatAreAsGood) {
  // Two rooms drawn into one picture, the outer one a little weaker; walls at centres of bins.
  BoxRoom inner, outer;
  inner.min = {-kBins.Distance(100), -kBins.Distance(110)};
  inner.max = {kBins.Distance(120), kBins.Distance(105)};
  outer.min = {-kBins.Distance(140), -kBins.Distance(150)};
  outer.max = {kBins.Distance(160), kBins.Distance(145)};
  const ColumnTruth inner_truth = TruthOfColumns(inner, {0, 0}, kColumns);
  const ColumnTruth outer_truth = TruthOfColumns(outer, {0, 0}, kColumns);
  ColumnScores scores = PerfectScores(inner_truth, kBins);
  AddScores(PerfectScores(outer_truth, kBins), 0.995, scores);
  const WallPath path = FindWallPath(scores, kBins, {}, true);
  for (const int c : {0, 64, 128, 192}) {  // the middles of the walls
    const size_t i = static_cast<size_t>(c);
    const auto at = [&](double distance) {
      return path.log_likelihood(c, static_cast<int>(std::lround(kBins.Bin(distance))));
    };
    EXPECT_GT(at(outer_truth.wall_m[i]), -3);
    EXPECT_LT(at(std::sqrt(inner_truth.wall_m[i] * outer_truth.wall_m[i])), -3);
  }
}

TEST(FindWallPath, NothingToSeeGivesAFiniteAnswer) {
  ColumnScores scores;
  for (const size_t f : {0, 1}) scores.family[f] = ImageF(kColumns, kBins.count);
  const WallPath path = FindWallPath(scores, kBins, {}, true);
  for (int c = 0; c < kColumns; ++c) {
    EXPECT_GT(path.wall_m[static_cast<size_t>(c)], 0);
    EXPECT_LT(path.wall_m[static_cast<size_t>(c)], 1.1 * kBins.Distance(kBins.count));
  }
  EXPECT_GT(path.score, -50);
}

TEST(FindWallPath, WithoutCostsTheBestOfEachColumnIsTaken) {
  PlaneViterbiOptions options;
  options.corner_cost_deg = options.jump_cost_deg = options.frontal_step_cost = 0;
  const ColumnScores scores = RandomScores(std::array{0, 1}, 8, kFewBins.count, 3);
  EXPECT_NEAR(FindWallPath(scores, kFewBins, options, false).score,
              BruteForce(scores, kFewBins, options).Best(), 1e-3);
}

TEST(FindWallPath, NeedsScoresOfOneSize) {
  EXPECT_THROW((void)FindWallPath({}, kBins, {}, false), std::logic_error);
  ColumnScores scores;
  scores.family[0] = ImageF(8, kBins.count);
  scores.family[1] = ImageF(9, kBins.count);
  EXPECT_THROW((void)FindWallPath(scores, kBins, {}, false), std::logic_error);
}

}  // namespace
}  // namespace enfilade
