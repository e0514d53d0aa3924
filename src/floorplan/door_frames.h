// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "src/floorplan/facade.h"

namespace enfilade {

/// Two upright edges from the floor to a level one: what the frame of a door looks like.
struct DoorFrame {
  double begin_m = 0, end_m = 0;  ///< along the wall
  double head_m = 0;              ///< above the floor
  float low_jambs[2] = {0, 0};    ///< 0–1: how straight and clear the jambs are near the floor
  float high_jambs[2] = {0, 0};   ///< and above that
  float above[2] = {0, 0};        ///< how far the jambs' lines go on above the head
  float head = 0;                 ///< how straight and clear the head is
  float baseboard = 0;            ///< how clear a level line at the floor goes on between the jambs
  double score = 0;               ///< to choose among frames that overlap

  [[nodiscard]] double Width() const { return end_m - begin_m; }
};

/// The best few frames of a wall that do not overlap, best first. Frames whose head is near
/// `home_head_m` are preferred. Cost: O(heads · edges²).
[[nodiscard]] std::vector<DoorFrame> FindDoorFrames(const Facade& facade,
                                                    std::optional<double> home_head_m);

/// True when what is inside the frame is an opening that joins rooms (kRoomJoiningOpening_m).
[[nodiscard]] bool IsWide(const DoorFrame& frame);

/// The best few wide frames, up to 3.2 m, that do not overlap, best first; openings between rooms
/// have no usual height. Their score is OpeningStrength.
[[nodiscard]] std::vector<DoorFrame> FindWideFrames(const Facade& facade);

/// 0–2: how clear the head and the weakest of the jambs are.
[[nodiscard]] float OpeningStrength(const DoorFrame& frame);

/// The height of most doors' heads, from the frames of all walls found without one; none when
/// there are no frames.
[[nodiscard]] std::optional<double> HomeHead(std::span<const std::vector<DoorFrame>> frames);

/// Log-odds that a frame is a door's. `camera_m`: distance in plan from its middle to the nearest
/// camera, if it shall count: where people walk through, photographers stand.
[[nodiscard]] double DoorLogOdds(const DoorFrame& frame, double home_head_m,
                                 std::optional<double> camera_m);

}  // namespace enfilade
