// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "enfilade/floorplan/types.h"

namespace enfilade {

/// Openings (without a door) wider than this make one room of the spaces that they join.
inline constexpr double kRoomJoiningOpening_m = 1.2;

/// For each room of the storey the index of the first of the rooms that wide openings make one with
/// it, directly or through others: its own index if it is the first or alone.
[[nodiscard]] std::vector<size_t> FirstJoinedRooms(const Storey& storey);

}  // namespace enfilade
