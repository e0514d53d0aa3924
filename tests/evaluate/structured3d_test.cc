// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/structured3d.h"

#include <gtest/gtest.h>

#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

Structured3dFigures Judge(const std::vector<Ring2>& rooms) {
  return EvaluateStructured3d(JudgedPlanOf(MakePlan(rooms, SmallHomeDoors())),
                              JudgedPlanOf(MakeSmallHome().truth));
}

TEST(EvaluateStructured3d, TruthAgainstItselfIsPerfect) {
  const Structured3dFigures figures = Judge(SmallHomeRooms());
  EXPECT_EQ(figures.room_f1, 1.0);
  EXPECT_EQ(figures.corner_f1, 1.0);
  EXPECT_EQ(figures.angle_f1, 1.0);
}

TEST(EvaluateStructured3d, TenPixelsAreAnisotropic) {
  // The home is 8.1 by 4.6 m, so ten pixels are 0.38 m along x and 0.22 m along y.
  std::vector<Ring2> wider = SmallHomeRooms(), higher = SmallHomeRooms();
  wider[1] = ParseRing("4.1,0 8.4,0 8.4,3 4.1,3");
  EXPECT_EQ(Judge(wider).corner_f1, 1.0);
  higher[1] = ParseRing("4.1,-0.3 8.1,-0.3 8.1,3 4.1,3");
  EXPECT_NEAR(*Judge(higher).corner_f1, 10.0 / 12, 1e-12);
  EXPECT_EQ(Judge(higher).room_f1, 1.0);
}

TEST(EvaluateStructured3d, AnglesMustAgreeWithin5Degrees) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  // 0.3 m are 8 px, within reach of the corner; over 69 px of height they turn the wall by 6.5°.
  rooms[2] = ParseRing("0,3.1 8.1,3.1 7.8,4.6 0,4.6");
  const Structured3dFigures figures = Judge(rooms);
  EXPECT_EQ(figures.corner_f1, 1.0);
  EXPECT_NEAR(*figures.angle_f1, 10.0 / 12, 1e-12);
}

TEST(EvaluateStructured3d, OverlappingRoomsAreNoHits) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("3.4,0 8.1,0 8.1,3 3.4,3");
  EXPECT_NEAR(*Judge(rooms).room_f1, 2.0 / 6, 1e-12);
}

TEST(EvaluateStructured3d, ALostRoomAndItsCorners) {
  const Structured3dFigures figures = Judge({SmallHomeRooms()[0], SmallHomeRooms()[1]});
  EXPECT_NEAR(*figures.room_f1, 4.0 / 5, 1e-12);
  EXPECT_NEAR(*figures.corner_f1, 16.0 / 20, 1e-12);
}

TEST(EvaluateStructured3d, ASideWithoutRoomsGivesNone) {
  EXPECT_EQ(Judge({}).room_f1, std::nullopt);
}

}  // namespace
}  // namespace enfilade
