// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/sfm/metric_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace enfilade {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(FindMetricScale, TakesTheGivenHeight) {
  const MetricScale scale = FindMetricScale(1.4, std::vector{1.75}, {});
  EXPECT_EQ(scale.camera_height_m, 1.4);
  EXPECT_EQ(scale.source, ScaleSource::kCameraHeight);
  EXPECT_THAT(scale.warnings, IsEmpty());
}

TEST(FindMetricScale, CombinesWhatIsUsual) {
  const MetricScale alone = FindMetricScale(std::nullopt, {}, {});
  EXPECT_NEAR(alone.camera_height_m, 1.5, 1e-12);
  EXPECT_EQ(alone.source, ScaleSource::kAssumed);
  // Weighted mean of logarithms: 1.5 m to 10 %, 2.5 / 2 = 1.25 m to 12 %.
  const MetricScale both = FindMetricScale(std::nullopt, std::vector{2.0}, {});
  const double w1 = 1 / 0.01, w2 = 1 / 0.0144;
  EXPECT_NEAR(std::log(both.camera_height_m),
              (w1 * std::log(1.5) + w2 * std::log(1.25)) / (w1 + w2), 1e-12);
  EXPECT_LT(both.log_sigma, alone.log_sigma);
}

TEST(FindMetricScale, TakesTheHighestLevelForTheCeiling) {
  // A lintel stands out more than the ceiling above it.
  const MetricScale scale = FindMetricScale(1.4, std::vector{1.43, 1.75}, {});
  EXPECT_THAT(scale.warnings, IsEmpty());
}

TEST(FindMetricScale, WarnsOfWhatNoHomeHas) {
  EXPECT_THAT(FindMetricScale(0.5, {}, {}).warnings,
              ElementsAre(HasSubstr("cameras stand at 0.50 m")));
  EXPECT_THAT(FindMetricScale(1.5, std::vector{1.2}, {}).warnings,
              testing::Contains(HasSubstr("rooms come out 1.80 m high")));
  EXPECT_THAT(FindMetricScale(1.5, std::vector{3.2}, {}).warnings,
              testing::Contains(HasSubstr("usual height of rooms")));
}

}  // namespace
}  // namespace enfilade
