// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/sfm/pair_joins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "enfilade/geometry/angles.h"
#include "enfilade/sfm/gravity.h"
#include "tests/sfm/box_outline.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHeight_m = 1.5;

// Two rooms beside each other, 4 m × 3 m each, a component each with its own origin, and pairs of
// panoramas that tell places.
struct TwoRooms {
  std::vector<Rigid3> world_from_cam;
  std::vector<int> component_idx = {1, 0, 0};
  std::vector<PanoFeatures> features{3};
  std::vector<Gravity> gravity{3};
  std::vector<RoomOutline> outlines;
  std::vector<PanoPair> pairs;

  // Of the second room's component in the first one's; view 0 is in the second room.
  const Rigid3 truth{RotationZ(kPi / 2), Vector3d(4.1, 0, 0)};

  TwoRooms() {
    const std::vector<Vector2d> at = {{1.0, -2.0}, {1.0, 1.0}, {3.2, 2.0}};
    const std::vector<double> yaws = {0.4, 0.0, 2.0};
    for (size_t i = 0; i < at.size(); ++i) {
      world_from_cam.push_back({RotationZ(yaws[i]) * LevelFromCam(gravity[i]),
                                Vector3d(at[i].x(), at[i].y(), kHeight_m)});
    }
    outlines = {BoxOutline({0, -4}, {3, 0}, at[0], 2.5), BoxOutline({0, 0}, {4, 3}, at[1], 2.5),
                BoxOutline({0, 0}, {4, 3}, at[2], 2.5)};
  }

  // View 0 and another one tell this place of the second component in the first.
  void Tell(int view, const Rigid3& place, double digits) {
    const size_t i = static_cast<size_t>(view);
    const auto level = [&](size_t k) -> Rigid3 {
      return {world_from_cam[k].rotation * LevelFromCam(gravity[k]).transpose(),
              world_from_cam[k].translation};
    };
    const Rigid3 first_from_other = (place * level(0)).Inverse() * level(i);
    PanoPair pair;
    pair.a_idx = 0;
    pair.b_idx = view;
    pair.verdict = PairVerdict::kChance;
    pair.a_from_b = first_from_other.rotation;
    pair.length = first_from_other.translation.norm() / kHeight_m;
    pair.direction = first_from_other.translation.normalized();
    pair.log10_chance = -digits;
    pair.inliers = {{0, 0}, {1, 1}};
    pairs.push_back(pair);
  }

  [[nodiscard]] std::vector<ComponentJoin> Join() const {
    const std::vector<ComponentFloor> floors = {
        ComponentFloor({{1, world_from_cam[1].translation, &outlines[1]},
                        {2, world_from_cam[2].translation, &outlines[2]}}),
        ComponentFloor({{0, world_from_cam[0].translation, &outlines[0]}})};
    return JoinsOfPairs(
        {world_from_cam, component_idx, features, gravity, outlines, pairs, kHeight_m}, floors, {});
  }
};

TEST(JoinsOfPairs, AddsUpWhatPairsTellOfRoomsSideBySide) {
  TwoRooms rooms;
  rooms.Tell(1, rooms.truth, 7);
  EXPECT_TRUE(rooms.Join().empty());
  rooms.Tell(2, {rooms.truth.rotation, rooms.truth.translation + Vector3d(0.05, 0, 0)}, 8);
  const std::vector<ComponentJoin> joins = rooms.Join();
  ASSERT_EQ(joins.size(), 1U);
  EXPECT_EQ(joins[0].a, 0);
  EXPECT_EQ(joins[0].b, 1);
  EXPECT_NEAR(joins[0].log_odds, 15 * std::log(10.0), 1e-9);
  EXPECT_EQ(joins[0].pairs.size(), 2U);
  EXPECT_LT((joins[0].a_from_b.translation - rooms.truth.translation).norm(), 0.06);
  EXPECT_LT((joins[0].a_from_b.rotation - rooms.truth.rotation).norm(), 1e-6);
}

TEST(JoinsOfPairs, DoesNotLayRoomsUponEachOther) {
  TwoRooms rooms;
  const Rigid3 upon{rooms.truth.rotation, Vector3d(1, 0, 0)};
  rooms.Tell(1, upon, 19);
  EXPECT_TRUE(rooms.Join().empty());
  // Nor does that speak against a place beside.
  rooms.Tell(2, rooms.truth, 11);
  ASSERT_EQ(rooms.Join().size(), 1U);
  EXPECT_LT((rooms.Join()[0].a_from_b.translation - rooms.truth.translation).norm(), 1e-6);
}

// Both components have panoramas of one room.
TEST(JoinsOfPairs, LaysRoomsUponEachOtherWhoseWallsAreTheSame) {
  TwoRooms rooms;
  const Rigid3 same{rooms.truth.rotation, Vector3d(0.05, 0, 0)};
  rooms.Tell(1, same, 12);
  EXPECT_TRUE(rooms.Join().empty());
  rooms.pairs.clear();
  rooms.Tell(1, same, 19);
  ASSERT_EQ(rooms.Join().size(), 1U);
}

TEST(JoinsOfPairs, LeavesRoomsApartOfWhichTwoPlacesAreTold) {
  TwoRooms rooms;
  rooms.Tell(1, rooms.truth, 11);
  rooms.Tell(2, {rooms.truth.rotation, Vector3d(4.1, 1.5, 0)}, 8);
  EXPECT_TRUE(rooms.Join().empty());
}

TEST(JoinsOfPairs, NeedsLengthsAndPairsBetweenComponents) {
  TwoRooms rooms;
  rooms.Tell(1, rooms.truth, 15);
  ASSERT_EQ(rooms.Join().size(), 1U);
  rooms.pairs[0].length = 0;
  EXPECT_TRUE(rooms.Join().empty());
  rooms.pairs[0] = {};
  rooms.pairs[0].a_idx = 1;
  rooms.pairs[0].b_idx = 2;
  EXPECT_TRUE(rooms.Join().empty());
}

}  // namespace
}  // namespace enfilade
