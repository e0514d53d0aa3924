// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/evaluate/regions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "enfilade/geometry/angles.h"
#include "tests/evaluate/small_home.h"

namespace enfilade {
namespace {

constexpr double kNet_m2 = 4 * 3 + 4 * 3 + 8.1 * 1.5;
constexpr double kGross_m2 = 8.1 * 4.6;

JudgedPlan PlanOf(const std::vector<Ring2>& rooms) {
  return JudgedPlanOf(MakePlan(rooms, SmallHomeDoors()));
}

TEST(TrueRegion, IsTheTruthInAnotherFrame) {
  const SmallHome home = MakeSmallHome();
  const Rigid3 frame_from_truth{RotationZ(kPi / 2), Eigen::Vector3d(10, 0, 5)};
  const MultiPolygon2 region = TrueRegion(home.truth, frame_from_truth);
  EXPECT_NEAR(Area(region), kNet_m2, 1e-6);
  // (2, 1.5), in the first room.
  EXPECT_TRUE(std::any_of(region.begin(), region.end(), [](const Polygon2& part) {
    return Contains(part, Eigen::Vector2d(8.5, 2));
  }));
}

TEST(EvaluateRegions, TruthAgainstItselfIsPerfect) {
  const SmallHome home = MakeSmallHome();
  const RegionFigures figures = EvaluateRegions(JudgedPlanOf(home.plan), JudgedPlanOf(home.truth));
  EXPECT_NEAR(figures.iou_net, 1, 1e-9);
  EXPECT_NEAR(figures.iou_gross, 1, 1e-9);
  EXPECT_NEAR(figures.error_gross, 0, 1e-9);
  EXPECT_NEAR(figures.area_net_m2, kNet_m2, 1e-9);
  EXPECT_NEAR(figures.truth_area_net_m2, kNet_m2, 1e-9);
  // Closing leaves a small notch where the wall between the rooms meets the outer face.
  EXPECT_NEAR(figures.truth_area_gross_m2, kGross_m2, 0.01);
}

TEST(EvaluateRegions, AWallMovedBy7CentimetresChangesWhatItSweeps) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms[1] = ParseRing("4.1,0 8.17,0 8.17,3 4.1,3");
  const RegionFigures figures = EvaluateRegions(PlanOf(rooms), JudgedPlanOf(MakeSmallHome().truth));
  EXPECT_NEAR(figures.iou_net, kNet_m2 / (kNet_m2 + 0.07 * 3), 1e-9);
  EXPECT_NEAR(figures.iou_gross, kGross_m2 / (kGross_m2 + 0.07 * 3), 3e-4);
  EXPECT_NEAR(figures.error_gross, 0.07 * 3 / kGross_m2, 3e-4);
}

TEST(EvaluateRegions, ALostRoomIsMissing) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  rooms.pop_back();
  const RegionFigures figures = EvaluateRegions(PlanOf(rooms), JudgedPlanOf(MakeSmallHome().truth));
  EXPECT_NEAR(figures.iou_net, 24 / kNet_m2, 1e-9);
  EXPECT_NEAR(figures.error_gross, (8.1 * 1.6) / kGross_m2, 1e-3);
}

TEST(EvaluateRegions, APlanWithoutRoomsCoversNothing) {
  const RegionFigures figures =
      EvaluateRegions(JudgedPlanOf(Floorplan()), JudgedPlanOf(MakeSmallHome().truth));
  EXPECT_EQ(figures.iou_net, 0);
  EXPECT_EQ(figures.iou_gross, 0);
  EXPECT_NEAR(figures.error_gross, 1, 1e-9);
}

TEST(EvaluateRegions, AMirroredPlanLosesWhatIsNotSymmetric) {
  std::vector<Ring2> rooms = SmallHomeRooms();
  for (Ring2& room : rooms) {
    for (Eigen::Vector2d& p : room) p.y() = 4.6 - p.y();
  }
  const RegionFigures figures = EvaluateRegions(PlanOf(rooms), JudgedPlanOf(MakeSmallHome().truth));
  // Seen from above the outer rectangle is the same; only the walls inside it differ.
  EXPECT_GT(figures.iou_gross, 0.999);
  // Walls: y 3.0 … 3.1 against 1.5 … 1.6, and 10 cm at x 4.0 … 4.1 over 1.4 m on either side.
  const double differing = 2 * (8.1 * 0.1 - 0.1 * 0.1) + 2 * 0.1 * 1.5;
  const double inside_either = kGross_m2 - 0.1 * 1.4;
  EXPECT_NEAR(figures.iou_net, 1 - differing / inside_either, 5e-3);
}

TEST(GrossRegion, FillsWallsAndSmallShaftsButKeepsCourtyards) {
  // A room with a shaft of 0.81 m² and a courtyard of 4 m², both wider than the disc closes.
  const JudgedPlan plan = PlanOf({ParseRing("0,0 10,0 10,6 0,6")});
  JudgedPlan with_holes = plan;
  Polygon2& room = with_holes.rooms[0].region[0];
  const auto hole = [](double x, double y, double size) {
    return Ring2{{x, y}, {x, y + size}, {x + size, y + size}, {x + size, y}};
  };
  room = {ParseRing("0,0 10,0 10,6 0,6"), {hole(1, 1, 0.9), hole(5, 2, 2)}};
  EXPECT_NEAR(Area(NetRegion(with_holes)), 60 - 0.81 - 4, 1e-9);
  const double gross = Area(GrossRegion(NetRegion(with_holes)));
  EXPECT_NEAR(gross, 60 - 4, 0.1);  // the disc rounds the courtyard's corners
  EXPECT_GT(gross, 60 - 4);
}

}  // namespace
}  // namespace enfilade
