// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/base/check.h"

#include <gmock/gmock.h>

namespace enfilade {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Check, PassesWithoutEvaluatingTwice) {
  int num_evaluations = 0;
  ENFILADE_CHECK(++num_evaluations == 1);
  EXPECT_EQ(num_evaluations, 1);
}

TEST(Check, NamesPlaceAndCondition) {
  EXPECT_THAT([] { ENFILADE_CHECK(1 > 2); },
              ThrowsMessage<std::logic_error>(HasSubstr("check failed: 1 > 2")));
  EXPECT_THAT([] { ENFILADE_CHECK(false); },
              ThrowsMessage<std::logic_error>(HasSubstr("check_test.cc:")));
}

TEST(Check, TellsTheDetail) {
  EXPECT_THAT([] { ENFILADE_CHECK_MSG(false, "rows = " + std::to_string(3)); },
              ThrowsMessage<std::logic_error>(HasSubstr("(rows = 3)")));
}

TEST(Check, IsOneStatement) {
  // Compiles without braces in both branches.
  if (true)
    ENFILADE_CHECK(true);
  else
    ENFILADE_CHECK(false);
}

}  // namespace
}  // namespace enfilade
