// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace enfilade {
namespace {

TEST(Memory, PeakRemembersWhatWasFreed) {
  ResetPeakMemory();
  const double before = PeakMemoryMb();
  {
    std::vector<char> block(200'000'000);
    for (size_t i = 0; i < block.size(); i += 1024) block[i] = 1;
    volatile char* keep = block.data();
    (void)keep;
  }
  EXPECT_NEAR(PeakMemoryMb() - before, 200, 40);
}

TEST(Memory, AvailableIsKnown) { EXPECT_GT(AvailableMemoryMb(), 1); }

}  // namespace
}  // namespace enfilade
