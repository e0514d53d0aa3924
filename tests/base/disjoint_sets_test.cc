// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(DisjointSets, LowestMemberStandsForItsSet) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.Join(4, 3));
  EXPECT_TRUE(sets.Join(3, 1));
  EXPECT_FALSE(sets.Join(1, 4));
  EXPECT_EQ(sets.Find(4), 1);
  EXPECT_EQ(sets.Find(2), 2);
}

}  // namespace
}  // namespace enfilade
