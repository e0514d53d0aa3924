// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/picture_matching.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

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

// The twin: for each picture of the result the first free one of the truth, by hash, then by name.
std::vector<int> SlowMatches(const std::vector<PictureKey>& result,
                             const std::vector<PictureKey>& truth) {
  std::vector<int> matches(result.size(), -1);
  for (const bool is_by_hash : {true, false}) {
    for (size_t i = 0; i < result.size(); ++i) {
      for (size_t j = 0; j < truth.size() && matches[i] < 0; ++j) {
        const bool is_free = std::count(matches.begin(), matches.end(), static_cast<int>(j)) == 0;
        const bool is_same = is_by_hash
                                 ? !result[i].sha256.empty() && result[i].sha256 == truth[j].sha256
                                 : result[i].picture == truth[j].picture;
        if (is_free && is_same) matches[i] = static_cast<int>(j);
      }
    }
  }
  return matches;
}

TEST(MatchPictures, AgreesWithItsBruteForceTwin) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> letter(0, 4);
  const auto keys = [&](int count) {
    std::vector<PictureKey> made;
    for (int i = 0; i < count; ++i) {
      const int hash = letter(random);
      made.push_back({std::string(1, static_cast<char>('a' + letter(random))),
                      hash == 0 ? "" : std::to_string(hash)});
    }
    return made;
  };
  for (int round = 0; round < 200; ++round) {
    const auto result = keys(6), truth = keys(5);
    EXPECT_EQ(MatchPictures(result, truth), SlowMatches(result, truth));
  }
}

}  // namespace
}  // namespace enfilade
