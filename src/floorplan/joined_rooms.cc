// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/floorplan/joined_rooms.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace enfilade {

std::vector<size_t> FirstJoinedRooms(const Storey& storey) {
  std::map<int, size_t> idx_of_id;
  for (size_t i = 0; i < storey.rooms.size(); ++i) idx_of_id[storey.rooms[i].id] = i;
  std::vector<size_t> first(storey.rooms.size());
  std::iota(first.begin(), first.end(), size_t{0});
  for (const Opening& opening : storey.openings) {
    if (opening.kind != OpeningKind::kOpening || !opening.other_room_id) continue;
    if ((opening.b - opening.a).norm() <= kRoomJoiningOpening_m) continue;
    const auto room = idx_of_id.find(opening.room_id);
    const auto other = idx_of_id.find(*opening.other_room_id);
    if (room == idx_of_id.end() || other == idx_of_id.end()) continue;
    const auto [low, high] = std::minmax({first[room->second], first[other->second]});
    std::replace(first.begin(), first.end(), high, low);
  }
  return first;
}

}  // namespace enfilade
