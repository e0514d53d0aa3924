// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "enfilade/base/errors.h"
#include "enfilade/sfm/metric_scale.h"

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<View> ThreeViews() {
  std::vector<View> views(3);
  for (size_t i = 0; i < 3; ++i)
    views[i].picture = std::string(1, static_cast<char>('a' + i)) + ".jpg";
  return views;
}

TEST(ParseKnownDistances, ReadsNamesWithAndWithoutExtension) {
  const std::vector<View> views = ThreeViews();
  EXPECT_TRUE(ParseKnownDistances("", views).empty());
  const auto known = ParseKnownDistances("a.jpg,c,3.20;b,a,1.5", views);
  ASSERT_EQ(known.size(), 2U);
  EXPECT_EQ(known[0].a_idx, 0);
  EXPECT_EQ(known[0].b_idx, 2);
  EXPECT_EQ(known[0].metres, 3.2);
  EXPECT_EQ(known[1].a_idx, 1);
  EXPECT_EQ(known[1].metres, 1.5);
}

TEST(ParseKnownDistances, RefusesWhatIsNoDistance) {
  const std::vector<View> views = ThreeViews();
  for (const char* text :
       {"a", "a,b", "a,3.2", ",", "a,b,", "a,b,far", "a,b,0", "a,b,-1", "a,b,nan", "a,b,3.2m",
        "a,b,1;"
        "x",
        ";"}) {
    EXPECT_THROW(static_cast<void>(ParseKnownDistances(text, views)), InvalidInputError) << text;
  }
  EXPECT_THAT(
      [&] { static_cast<void>(ParseKnownDistances("a,d.jpg,3.2", views)); },
      ThrowsMessage<InvalidInputError>(HasSubstr("'d.jpg', which is none of the pictures")));
  EXPECT_THAT([&] { static_cast<void>(ParseKnownDistances("a,a.jpg,3.2", views)); },
              ThrowsMessage<InvalidInputError>(HasSubstr("names one picture twice")));
}

TEST(MeasureDistances, MeasuresWithinAComponent) {
  const std::vector<View> views = ThreeViews();
  const std::array<Vector3d, 3> positions = {Vector3d(0, 0, 1), Vector3d(2, 0, 1),
                                             Vector3d(0.05, 0, 1)};
  const std::vector<KnownDistance> known = {{0, 1, 2.8}};
  const std::array<int, 3> together = {0, 0, 0}, apart = {0, 1, 0};
  const auto measured = MeasureDistances(known, views, positions, together);
  ASSERT_EQ(measured.size(), 1U);
  EXPECT_EQ(measured[0].name, "a.jpg – b.jpg");
  EXPECT_EQ(measured[0].camera_heights, 2);
  EXPECT_THAT(
      [&] { static_cast<void>(MeasureDistances(known, views, positions, apart)); },
      ThrowsMessage<InvalidInputError>(HasSubstr("a.jpg and b.jpg, which nothing ties together")));
  const std::vector<KnownDistance> near = {{0, 2, 2.8}};
  EXPECT_THAT([&] { static_cast<void>(MeasureDistances(near, views, positions, together)); },
              ThrowsMessage<InvalidInputError>(HasSubstr("stand at one place")));
}

}  // namespace
}  // namespace enfilade
