// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/pipeline/leave_one_out.h"

#include <gtest/gtest.h>

namespace enfilade {
namespace {

TEST(CanPlanWithout, NeedsTwoOthersOnTheSameStorey) {
  Scene scene;
  scene.views.resize(5);
  scene.views[3].storey_idx = scene.views[4].storey_idx = 1;
  for (int view = 0; view < 3; ++view) EXPECT_TRUE(CanPlanWithout(scene, view)) << view;
  for (int view = 3; view < 5; ++view) EXPECT_FALSE(CanPlanWithout(scene, view)) << view;
  RunContext context;
  EXPECT_THROW((void)PlanWithout(scene, 4, {}, context), std::logic_error);
  EXPECT_THROW((void)CanPlanWithout(scene, 5), std::logic_error);
}

}  // namespace
}  // namespace enfilade
