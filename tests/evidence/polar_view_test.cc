// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/evidence/polar_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "enfilade/geometry/angles.h"
#include "tests/evidence/plan_samples.h"

namespace enfilade {
namespace {

// Brute force: the nearest column by dot product, its blurred distribution by the error function,
// without tables.
class SlowView {
 public:
  SlowView(const WallSampleSet& set, const DistanceError& error) : set_(set), error_(error) {}

  double Cdf(const Eigen::Vector2d& offset) const {
    const WallSample& nearest = *std::max_element(
        set_.samples.begin(), set_.samples.end(), [&](const WallSample& a, const WallSample& b) {
          return a.direction.dot(offset) < b.direction.dot(offset);
        });
    double below = 0;
    for (size_t i = 0; i < set_.bin_m.size(); ++i) {
      const double sigma = error_.Sigma(set_.bin_m[i]);
      below += nearest.wall_probability[i] * 0.5 *
               std::erfc((set_.bin_m[i] - offset.norm()) / (std::sqrt(2.0) * sigma));
    }
    return below;
  }

 private:
  const WallSampleSet& set_;
  DistanceError error_;
};

TEST(PolarView, EqualsBruteForceInColumnCentres) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> distance(0.5, 12);
  PlanToSample plan;
  plan.cameras = {{0.3, -0.2}};
  plan.num_columns = 64;
  plan.sigma_m = 0.2;
  plan.distance = [&](int, const Eigen::Vector2d&) { return distance(random); };
  WallSampleSet set = SamplesOf(plan);
  // Bins are their own centres here: no refinement within a bin.
  for (WallSample& s : set.samples) s.wall_m = 0;
  const DistanceError error{0.05, 0.01, 1.4};
  const RangeBins bins(set.bin_m, error);
  RunContext context(1);
  const std::vector<PolarView> views = MakePolarViews(set, bins, context);
  ASSERT_EQ(views.size(), 1u);
  const SlowView slow(set, error);
  std::uniform_int_distribution<int> column(0, 63);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d offset = set.samples[column(random)].direction * distance(random);
    const auto reading =
        views[0].Read(offset.cast<float>(), static_cast<float>(offset.norm()), 0, 0);
    // None: the wall surely lies before.
    const double cdf = reading ? reading->cdf : 1;
    worst = std::max(worst, std::abs(cdf - slow.Cdf(offset)));
  }
  EXPECT_LT(worst, 0.03);  // bins of 5 cm to 25 cm width against σ of 0.2 m
}

TEST(PolarView, StraightWallStaysStraightBetweenColumns) {
  // A wall along x = 3, seen by 90 columns only: its median must not stair-step.
  PlanToSample plan;
  plan.cameras = {{0, 0}};
  plan.num_columns = 90;
  plan.num_bins = 512;
  plan.distance = [](int, const Eigen::Vector2d& d) { return d.x() > 0.3 ? 3 / d.x() : 12; };
  const WallSampleSet set = SamplesOf(plan);
  const RangeBins bins(set.bin_m, {0.01, 0, 1.4});
  RunContext context(1);
  const PolarView view = MakePolarViews(set, bins, context)[0];
  for (double y = -4; y <= 4; y += 0.01) {
    double low = 2.5, high = 3.5;
    while (high - low > 1e-4) {
      const double x = 0.5 * (low + high);
      const auto reading =
          view.Read(Eigen::Vector2f(x, y), static_cast<float>(std::hypot(x, y)), 0, 0);
      (reading && reading->cdf < 0.5f ? low : high) = x;
    }
    EXPECT_NEAR(low, 3, 0.012) << y;
  }
}

TEST(PolarView, DirectionsWithoutColumnsSayNothing) {
  PlanToSample plan = PlanFromText("-2,-2 2,-2 2,2 -2,2", {{0, 0}});
  WallSampleSet set = SamplesOf(plan);
  std::erase_if(set.samples, [](const WallSample& s) { return s.direction.x() < 0; });
  const RangeBins bins(set.bin_m, {});
  RunContext context(1);
  const PolarView view = MakePolarViews(set, bins, context)[0];
  EXPECT_TRUE(view.Read({1, 0.2f}, 1.02f, 0, 0));
  EXPECT_FALSE(view.Read({-1, 0.2f}, 1.02f, 0, 0));
}

TEST(PolarView, RefusesBrokenSamples) {
  const PlanToSample plan = PlanFromText("-2,-2 2,-2 2,2 -2,2", {{0, 0}});
  const WallSampleSet good = SamplesOf(plan);
  const RangeBins bins(good.bin_m, {});
  RunContext context(1);
  const auto expect_refused = [&](auto&& spoil) {
    WallSampleSet set = good;
    spoil(set.samples[7]);
    EXPECT_THROW((void)MakePolarViews(set, bins, context), std::logic_error);
  };
  expect_refused([](WallSample& s) { s.wall_probability.pop_back(); });
  expect_refused([](WallSample& s) { s.wall_probability[3] = NAN; });
  expect_refused([](WallSample& s) { s.wall_probability.assign(s.wall_probability.size(), 0); });
  expect_refused([](WallSample& s) { s.wall_m = INFINITY; });
  expect_refused([](WallSample& s) { s.origin.x() += 1; });
  expect_refused([](WallSample& s) { s.direction *= 2; });
}

}  // namespace
}  // namespace enfilade
