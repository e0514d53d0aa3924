// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/exchange/short_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "enfilade/base/errors.h"

namespace enfilade {
namespace {

using testing::ElementsAre;

std::vector<std::string> Short(const std::vector<std::string>& names) { return ShortNames(names); }

TEST(ShortNames, LeavesOutWhatAllHaveInCommon) {
  EXPECT_THAT(Short({"pano_010.jpg", "pano_011.jpg", "pano_100.jpg"}),
              ElementsAre("010", "011", "100"));
  EXPECT_THAT(Short({"R0010732.JPG", "R0010733.JPG"}), ElementsAre("0010732", "0010733"));
  EXPECT_THAT(Short({"Bad_pano.jpg", "Küche_pano.jpg"}), ElementsAre("Bad", "Küche"));
}

TEST(ShortNames, CutsNoWordApart) {
  EXPECT_THAT(Short({"kitchen.jpg", "kitty.jpg"}), ElementsAre("kitchen", "kitty"));
  EXPECT_THAT(Short({"lobby 1 north.png", "hobby 1 north.png"}), ElementsAre("lobby", "hobby"));
}

TEST(ShortNames, KeepsSomethingOfEveryName) {
  EXPECT_THAT(Short({"a.jpg", "a.jpg.jpg"}), ElementsAre("a", "a.jpg"));
  EXPECT_THAT(Short({"pano", "pano1"}), ElementsAre("pano", "pano1"));
  EXPECT_THAT(Short({"only.jpg"}), ElementsAre("only"));
  EXPECT_THAT(Short({"same.jpg", "same.jpg"}), ElementsAre("same", "same"));
  EXPECT_THAT(Short({".jpg"}), ElementsAre(".jpg"));
  EXPECT_THAT(Short({"", "a"}), ElementsAre("", "a"));
  EXPECT_THAT(Short({}), ElementsAre());
}

TEST(ShortNames, CutsLongNamesWhereTheyDoNotDiffer) {
  EXPECT_THAT(Short({"ground floor, the large kitchen", "x"}), ElementsAre("…arge kitchen", "x"));
  EXPECT_THAT(Short({"alpha of the very same ending", "beta1 of the very same ending,"}),
              ElementsAre("… same ending", "…same ending,"));
}

// Names of few letters, so that many begin or end alike.
TEST(ShortNames, KeepsDifferentNamesDifferentAndValid) {
  std::mt19937 random(5);
  const std::vector<std::string> pieces = {"a", "ä", "1", "_", "aaaa", "…", "äöüäöüäöü", "22"};
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<std::string> names;
    const size_t num_names = 1 + random() % 6;
    for (size_t i = 0; i < num_names; ++i) {
      std::string name;
      for (size_t k = random() % 9; k > 0; --k) name += pieces[random() % pieces.size()];
      names.push_back(name);
    }
    const std::vector<std::string> shorts = ShortNames(names);
    ASSERT_EQ(shorts.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i) {
      EXPECT_TRUE(IsValidUtf8(shorts[i]));
      for (size_t k = 0; k < i; ++k) {
        EXPECT_EQ(shorts[i] == shorts[k], names[i] == names[k]) << names[i] << " and " << names[k];
      }
    }
  }
}

}  // namespace
}  // namespace enfilade
