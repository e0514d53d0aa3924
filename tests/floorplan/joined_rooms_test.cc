// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/joined_rooms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace enfilade {
namespace {

Opening Passage(OpeningKind kind, double width_m, int room_id, std::optional<int> other_room_id) {
  Opening opening;
  opening.kind = kind;
  opening.b = {width_m, 0};
  opening.a = {0, 0};
  opening.room_id = room_id;
  opening.other_room_id = other_room_id;
  return opening;
}

TEST(FirstJoinedRooms, WideOpeningsJoinDirectlyAndThroughOthers) {
  Storey storey;
  for (const int id : {7, 3, 9, 4, 5}) storey.rooms.emplace_back().id = id;
  storey.openings = {Passage(OpeningKind::kOpening, 1.8, 4, 9),
                     Passage(OpeningKind::kOpening, 2.4, 9, 7),
                     Passage(OpeningKind::kOpening, 1.1, 7, 3),  // a doorway without a door
                     Passage(OpeningKind::kDoor, 1.6, 3, 5),     // a double door
                     Passage(OpeningKind::kOpening, 3, 5, {}),   // to the outside
                     Passage(OpeningKind::kOpening, 3, 5, 77)};  // to a room that is not there
  EXPECT_THAT(FirstJoinedRooms(storey), ::testing::ElementsAre(0, 1, 0, 0, 4));
  EXPECT_THAT(FirstJoinedRooms({}), ::testing::IsEmpty());
}

}  // namespace
}  // namespace enfilade
