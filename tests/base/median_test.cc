// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/median.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(UpperMedian, IsAMember) {
  EXPECT_EQ(UpperMedian({3}), 3);
  EXPECT_EQ(UpperMedian({5, 1, 3}), 3);
  EXPECT_EQ(UpperMedian({4, 1, 3, 2}), 3);
  EXPECT_EQ(UpperMedian({}), 0);
}

}  // namespace
}  // namespace enfilade
