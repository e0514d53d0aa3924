// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/exchange/ground_truth.h"
#include "enfilade/floorplan/types.h"
#include "enfilade/scene/types.h"
#include "enfilade/structure/types.h"

namespace enfilade {

/// A home of three rooms with walls 10 cm thick, and a perfect result for it. World frame:
///
///   4.6  +-----------------------------+
///        |            hall (2)         |     doors: room 0 – hall at x 1.0 … 1.9,
///   3.1  +--d--------------------d-----+            room 1 – hall at x 6.0 … 6.9
///   3.0  +--d---------+ +--------d-----+
///        |  room 0    | |   room 1     |     floor 0, ceilings 2.4, 2.5 and 2.6 m,
///        |            | |              |     one camera in each room, 1.4 m up
///   0.0  +------------+ +--------------+
///        0           4.0 4.1          8.1
struct SmallHome {
  GroundTruth truth;
  Scene scene;
  Structure
      structure;  ///< 360 columns a profile; the home frame is turned by 20° against the world
  Floorplan plan;
};

[[nodiscard]] SmallHome MakeSmallHome();

/// The plan of those rooms with those openings cut into their walls, all given in the world frame.
/// Every edge is a wall; wall i is seen, partly seen or inferred as i mod 3 and known to 2 cm.
[[nodiscard]] Floorplan MakePlan(const std::vector<Ring2>& rooms_in_world,
                                 const std::vector<Opening>& openings_in_world);

/// Writes the truth about the pixels of the home's pictures (64 × 32, doors closed) below `folder`
/// and names it in the truth.
void WritePixelTruth(const std::filesystem::path& folder, SmallHome& home);

/// The rings of the three rooms and their two doors (a pair of faces each) in the world.
[[nodiscard]] std::vector<Ring2> SmallHomeRooms();
[[nodiscard]] std::vector<Opening> SmallHomeDoors();

}  // namespace enfilade
