// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "src/floorplan/facade_store.h"

#include <algorithm>
#include <utility>

namespace enfilade {

FacadeStore::FacadeStore(const RunContext& context) : free_bytes_(size_t{256} << 20) {
  const auto cap = static_cast<size_t>(context.max_memory_mb()) << 20;
  if (cap > 0) free_bytes_ = std::min(free_bytes_, cap / 4);
}

FacadeStore::Key FacadeStore::KeyOf(const PicturedWall& wall) {
  return {static_cast<double>(wall.storey_idx),
          wall.a.x(),
          wall.a.y(),
          wall.b.x(),
          wall.b.y(),
          wall.floor_z,
          wall.ceiling_z,
          wall.facade.step_m()};
}

bool FacadeStore::Take(PicturedWall& wall) {
  const auto found = kept_.find(KeyOf(wall));
  if (found == kept_.end()) return false;
  free_bytes_ += found->second.facade.NumBytes();
  const bool is_same =
      found->second.room.outer == wall.room->outer && found->second.room.holes == wall.room->holes;
  if (is_same) wall.facade = std::move(found->second.facade);
  kept_.erase(found);
  return is_same;
}

void FacadeStore::Keep(PicturedWall&& wall) {
  const size_t num_bytes = wall.facade.NumBytes();
  if (num_bytes > free_bytes_) return;
  const bool is_new = kept_.try_emplace(KeyOf(wall), *wall.room, std::move(wall.facade)).second;
  if (is_new) free_bytes_ -= num_bytes;
}

}  // namespace enfilade
