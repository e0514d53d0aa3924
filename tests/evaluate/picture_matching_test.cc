// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/picture_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

using testing::ElementsAre;

TEST(MatchPictures, PrefersTheHashOverTheName) {
  const std::vector<PictureKey> truth = {{"a.jpg", "1111"}, {"b.jpg", "2222"}};
  const std::vector<PictureKey> renamed = {{"a.jpg", "2222"}, {"b.jpg", "1111"}};
  EXPECT_THAT(MatchPictures(renamed, truth), ElementsAre(1, 0));
}

TEST(MatchPictures, FallsBackToTheFileNameWithoutFolders) {
  const std::vector<PictureKey> truth = {{"panos/a.jpg", ""}, {"b.jpg", "2222"}};
  const std::vector<PictureKey> result = {{"b.jpg", "9999"}, {"a.jpg", "1111"}, {"c.jpg", ""}};
  EXPECT_THAT(MatchPictures(result, truth), ElementsAre(1, 0, -1));
}

TEST(MatchPictures, PairsEqualPicturesInOrderAndOnce) {
  const std::vector<PictureKey> truth = {{"a.jpg", "1"}, {"b.jpg", "1"}};
  const std::vector<PictureKey> result = {{"x.jpg", "1"}, {"y.jpg", "1"}, {"z.jpg", "1"}};
  EXPECT_THAT(MatchPictures(result, truth), ElementsAre(0, 1, -1));
}

TEST(MatchPictures, UnknownHashesAreNotEqual) {
  const std::vector<PictureKey> truth = {{"a.jpg", ""}};
  const std::vector<PictureKey> result = {{"b.jpg", ""}};
  EXPECT_THAT(MatchPictures(result, truth), ElementsAre(-1));
}

}  // namespace
}  // namespace enfilade
