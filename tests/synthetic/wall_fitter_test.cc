// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/synthetic/wall_fitter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "enfilade/synthetic/text_home.h"
#include "src/synthetic/fitting_pieces.h"

namespace enfilade {
namespace {

using ::testing::IsEmpty;

// The lower wall, number 0, holds a window over [1, 2] from 0.9 m up; the upper one, number 2, runs
// back from x = 5 and has a closed door over [0.6, 1.4].
constexpr const char* kRoom =
    "room 0,0 5,0 5,4 0,4 | window 1,0 2,0 | closed 3.6,4 4.4,4 | box 3,0.05 4,0.5 | camera 2.5,2";

struct Fitted {
  Home home;
  bool is_fixed = false;
};

Fitted Fix(int wall_idx, double middle_m, const FurniturePiece& piece,
           BeforeWindows before_windows = BeforeWindows::kForbidden) {
  Fitted fitted{TextHome(kRoom)};
  WallFitter fitter(fitted.home, fitted.home.rooms[0]);
  const HomeWall wall = fitter.walls()[static_cast<size_t>(wall_idx)];
  fitted.is_fixed = fitter.FixAt(wall, middle_m, piece, before_windows);
  return fitted;
}

FurniturePiece Cupboard(double width_m) {
  Random random(1);
  return TallCupboard({width_m, 0.4}, 2.0, random);
}

FurniturePiece PictureOnWall() {
  Random random(1);
  return Picture(random);
}

TEST(WallFitter, FixesAPieceFlushWithItsWallToStay) {
  const Fitted fitted = Fix(2, 4.4, Cupboard(1.0));
  EXPECT_TRUE(fitted.is_fixed);
  EXPECT_THAT(HomeProblems(fitted.home), IsEmpty());
  const HomeBox& body = fitted.home.boxes.at(1);
  EXPECT_TRUE(body.is_built_in);
  EXPECT_NEAR(body.center.x(), 0.6, 1e-9);
  EXPECT_NEAR(body.center.y() + 0.5 * body.size.y(), 4.0, 1e-9);
  for (size_t i = 2; i < fitted.home.boxes.size(); ++i)
    EXPECT_EQ(fitted.home.boxes[i].item, body.item);
}

TEST(WallFitter, LeavesTheHomeAsItWasWhereThereIsNoRoom) {
  const auto is_refused = [](int wall_idx, double middle_m, const FurniturePiece& piece) {
    const Fitted fitted = Fix(wall_idx, middle_m, piece);
    return !fitted.is_fixed && fitted.home.boxes.size() == 1;
  };
  EXPECT_TRUE(is_refused(0, 1.5, Cupboard(0.8)));  // before the window
  EXPECT_TRUE(is_refused(2, 1.0, Cupboard(0.8)));  // before the door
  EXPECT_TRUE(is_refused(0, 3.5, Cupboard(0.8)));  // through the box
  EXPECT_TRUE(is_refused(0, 4.8, Cupboard(0.8)));  // through the next wall
  EXPECT_TRUE(is_refused(0, 3.5, Socket()));       // behind the box
}

TEST(WallFitter, CountsHandlesThatReachOutOfTheFootprint) {
  // The floor before the door must be free from x = 3.5 to 4.5; handles reach 2 cm out.
  Random random(1);
  EXPECT_FALSE(Fix(1, 3.5, TallCupboard({0.6, 0.49}, 2.0, random)).is_fixed);
  const Fitted fitted = Fix(1, 3.5, TallCupboard({0.6, 0.46}, 2.0, random));
  EXPECT_TRUE(fitted.is_fixed);
  EXPECT_THAT(HomeProblems(fitted.home), IsEmpty());
}

TEST(WallFitter, PassesOverAndUnderWhatIsThere) {
  EXPECT_TRUE(Fix(0, 3.5, PictureOnWall()).is_fixed);     // above the box
  EXPECT_TRUE(Fix(0, 1.5, Radiator(0.8, 0.7)).is_fixed);  // below the window
  const Fitted bulkhead = Fix(2, 2.5, Bulkhead({5, 0.5}, 2.15, 2.5, {0.8f, 0.8f, 0.8f}));
  EXPECT_TRUE(bulkhead.is_fixed);  // above the door
  EXPECT_THAT(HomeProblems(bulkhead.home), IsEmpty());
}

TEST(WallFitter, HangsCurtainsBeforeWindowsOnlyWhenAllowed) {
  Random random(2);
  const FurniturePiece curtain = Curtain(0.5, 2.2, {0.5f, 0.5f, 0.5f}, random);
  EXPECT_FALSE(Fix(0, 1.0, curtain).is_fixed);
  EXPECT_TRUE(Fix(0, 1.0, curtain, BeforeWindows::kAllowed).is_fixed);
}

TEST(WallFitter, KeepsClearOfCameras) {
  Home home = TextHome("room 0,0 5,0 5,4 0,4 | camera 2.5,0.6");
  WallFitter fitter(home, home.rooms[0]);
  EXPECT_FALSE(fitter.FixAt(fitter.walls()[0], 2.5, Cupboard(0.8)));
  EXPECT_TRUE(fitter.FixAt(fitter.walls()[0], 2.5, Socket()));
  EXPECT_TRUE(fitter.FixAt(fitter.walls()[0], 4.0, Cupboard(0.8)));
  EXPECT_THAT(HomeProblems(home), IsEmpty());
}

}  // namespace
}  // namespace enfilade
