// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/picture_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace enfilade {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<View> Views(int count) {
  std::vector<View> views(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    views[static_cast<size_t>(i)].picture = "p" + std::to_string(i) + ".jpg";
  }
  return views;
}

std::vector<std::string> Untied(const std::vector<int>& component_idx) {
  std::vector<std::string> warnings;
  WarnOfUntied(Views(static_cast<int>(component_idx.size())), component_idx, warnings);
  return warnings;
}

TEST(WarnOfUntied, NamesPicturesThatStandAlone) {
  EXPECT_THAT(Untied({0, 0, 0}), IsEmpty());
  EXPECT_THAT(Untied({0, 1, 0, 2}),
              ElementsAre("nothing ties 2 of 4 panoramas to the others: p1.jpg, p3.jpg"));
  EXPECT_THAT(Untied({0, 1}), ElementsAre(EndsWith("any two of these panoramas together: p0.jpg, "
                                                   "p1.jpg")));
  EXPECT_THAT(Untied({0}), ElementsAre(HasSubstr("p0.jpg is the only panorama")));
  EXPECT_THAT(Untied({0, 0, 1, 1, 2}), ElementsAre(HasSubstr("p4.jpg"), HasSubstr("2 groups")));
  std::vector<int> many;
  for (int i = 0; i < 40; ++i) many.push_back(i);
  EXPECT_THAT(Untied(many),
              ElementsAre(AllOf(HasSubstr("p11.jpg and 28 more"), Not(HasSubstr("p12.jpg")))));
}

TEST(WarnOfOddPictures, NamesBothPictures) {
  std::vector<std::string> warnings;
  const std::vector<View> views = Views(3);
  const std::vector<OddTie> ties = {{2, 0, -20}};
  WarnOfUpsideDown(views, ties, warnings);
  WarnOfMirrored(views, ties, warnings);
  WarnOfCopies(views, ties, warnings);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("p2.jpg stands upside down beside p0.jpg"),
                                    HasSubstr("p2.jpg is mirrored beside p0.jpg: flip it"),
                                    HasSubstr("p0.jpg and p2.jpg show the same")));
}

TEST(WarnOfToldVerticals, NamesWhatStrongLinesContradict) {
  std::vector<View> views = Views(4);
  views[0].told_up_in_cam = Vector3d(0, -1, 0);                 // right
  views[1].told_up_in_cam = Vector3d(0.1, -1, 0).normalized();  // 6° off
  views[2].told_up_in_cam = Vector3d(0.1, -1, 0).normalized();  // too few lines
  std::vector<Gravity> gravity(4);
  for (Gravity& of_view : gravity) of_view.num_lines = 30;
  gravity[2].num_lines = 4;
  std::vector<std::string> warnings;
  WarnOfToldVerticals(views, gravity, warnings);
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("lines of 1 pictures"), HasSubstr("6°"),
                                          HasSubstr("p1.jpg"), Not(HasSubstr("p2.jpg")))));
}

}  // namespace
}  // namespace enfilade
