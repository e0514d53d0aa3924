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

MetricScale FindScale(const ScaleEvidence& evidence) { return FindMetricScale(evidence, {}); }

TEST(FindMetricScale, TakesTheGivenHeight) {
  const MetricScale scale = FindScale({.given_height_m = 1.4, .ceilings = {1.75}});
  EXPECT_EQ(scale.camera_height_m, 1.4);
  EXPECT_EQ(scale.source, ScaleSource::kCameraHeight);
  EXPECT_THAT(scale.warnings, IsEmpty());
}

TEST(FindMetricScale, CombinesWhatIsUsual) {
  const MetricScale alone = FindScale({});
  EXPECT_NEAR(alone.camera_height_m, 1.5, 1e-12);
  EXPECT_EQ(alone.source, ScaleSource::kAssumed);
  // Weighted mean of logarithms: 1.5 m to 10 %, 2.5 / 2 = 1.25 m to 12 %.
  const MetricScale both = FindScale({.ceilings = {2.0}});
  const double w1 = 1 / 0.01, w2 = 1 / 0.0144;
  EXPECT_NEAR(std::log(both.camera_height_m),
              (w1 * std::log(1.5) + w2 * std::log(1.25)) / (w1 + w2), 1e-12);
  EXPECT_LT(both.log_sigma, alone.log_sigma);
  ASSERT_EQ(both.cues.size(), 2U);
  EXPECT_NEAR(both.cues[0].weight, w1 / (w1 + w2), 1e-12);
  EXPECT_NEAR(both.cues[0].weight + both.cues[1].weight, 1, 1e-12);
}

TEST(FindMetricScale, DoorsSayMoreThanWhatIsUsual) {
  const MetricScale scale = FindScale({.door_head = 2.0 / 1.3, .ceilings = {2.5 / 1.35}});
  EXPECT_NEAR(scale.camera_height_m, 1.3, 0.02);
  EXPECT_EQ(scale.source, ScaleSource::kAssumed);
  EXPECT_EQ(scale.cues.front().name, "door heads");
  EXPECT_GT(scale.cues.front().weight, 0.85);
  EXPECT_EQ(DescribeCue(scale.cues.front()),
            "door heads: cameras stand at 1.300 m ± 2.5 %, weight 90 %");
}

TEST(FindMetricScale, DistancesCountByTheirLength) {
  const MetricScale scale =
      FindScale({.distances = {{"a – b", 2.8, 2.0}, {"c – d", 0.36, 0.24}}, .door_head = 1.42});
  EXPECT_EQ(scale.source, ScaleSource::kKnownDistance);
  // 1.40 m to 1.1 % and 1.50 m to 8.3 %; doors do not count beside what is measured.
  EXPECT_NEAR(scale.camera_height_m, 1.4, 0.005);
  EXPECT_EQ(scale.cues[2].weight, 0);
  EXPECT_THAT(scale.warnings, IsEmpty());
}

TEST(FindMetricScale, CombinesHeightAndDistance) {
  const MetricScale scale = FindScale({.given_height_m = 1.41, .distances = {{"a – b", 2.8, 2.0}}});
  EXPECT_GT(scale.camera_height_m, 1.40);
  EXPECT_LT(scale.camera_height_m, 1.41);
  EXPECT_THAT(scale.warnings, IsEmpty());
}

TEST(FindMetricScale, NamesBothValuesOfWhatDisagrees) {
  const MetricScale scale = FindScale({.given_height_m = 1.4, .distances = {{"a – b", 3.2, 2.0}}});
  EXPECT_THAT(scale.warnings, ElementsAre(HasSubstr("given camera height puts cameras at 1.40 m"),
                                          HasSubstr("distance a – b puts cameras at 1.60 m")));
  // What does not count is compared all the same.
  EXPECT_THAT(FindScale({.given_height_m = 1.4, .door_head = 2.0 / 1.6}).warnings,
              ElementsAre(HasSubstr("door heads puts cameras at 1.60 m, all that counts together "
                                    "at 1.40 m")));
}

TEST(FindMetricScale, TakesTheHighestLevelForTheCeiling) {
  // A lintel stands out more than the ceiling above it.
  EXPECT_THAT(FindScale({.given_height_m = 1.4, .ceilings = {1.43, 1.75}}).warnings, IsEmpty());
}

TEST(FindMetricScale, WarnsOfWhatNoHomeHas) {
  EXPECT_THAT(FindScale({.given_height_m = 0.5}).warnings,
              ElementsAre(HasSubstr("cameras stand at 0.50 m")));
  EXPECT_THAT(FindScale({.given_height_m = 1.5, .ceilings = {1.2}}).warnings,
              testing::Contains(HasSubstr("rooms come out 1.80 m high")));
  EXPECT_THAT(FindScale({.given_height_m = 1.5, .ceilings = {3.2}}).warnings,
              testing::Contains(HasSubstr("usual height of rooms")));
}

}  // namespace
}  // namespace enfilade
