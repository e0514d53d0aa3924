// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/structure/room_mates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/structure/box_room.h"

namespace enfilade {
namespace {

using Eigen::Vector2d;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

constexpr int kColumns = 256;

KnownDistances WallsOf(const BoxRoom& room, const Vector2d& position) {
  return TruthOfColumns(room, position, kColumns).wall_m;
}

TEST(FindRoomMates, ThoseOfOneBareRoomInFull) {
  const BoxRoom room, next = {.min = {4.1, 0}, .max = {7, 3}};
  const std::vector<Vector2d> positions = {{1, 1}, {5, 2}, {3, 2}};
  const std::vector<std::vector<RoomMate>> mates =
      FindRoomMates(positions, std::vector<KnownDistances>{WallsOf(room, positions[0]),
                                                           WallsOf(next, positions[1]),
                                                           WallsOf(room, positions[2])});
  EXPECT_THAT(mates, ElementsAre(ElementsAre(Field(&RoomMate::view, 2)), IsEmpty(),
                                 ElementsAre(Field(&RoomMate::view, 0))));
  EXPECT_THAT(mates[0][0].weight, DoubleEq(1));
  EXPECT_THAT(mates[2][0].weight, DoubleEq(1));
}

// The walls of one run half across the room, as where furniture is taken for them.
TEST(FindRoomMates, LessWhereHalfOfTheFloorIsSeen) {
  const BoxRoom room, half = {.max = {2.2, 3}};
  const std::vector<Vector2d> positions = {{1, 1}, {1.5, 2}};
  const std::vector<std::vector<RoomMate>> mates = FindRoomMates(
      positions,
      std::vector<KnownDistances>{WallsOf(room, positions[0]), WallsOf(half, positions[1])});
  ASSERT_THAT(mates[0], ElementsAre(Field(&RoomMate::view, 1)));
  EXPECT_NEAR(mates[0][0].weight, (2.2 / 4 - 0.3) / 0.4, 0.06);
  EXPECT_EQ(mates[1][0].weight, mates[0][0].weight);
}

}  // namespace
}  // namespace enfilade
