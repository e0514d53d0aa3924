// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/exchange/ground_truth.h"

namespace enfilade {

/// Reads the truth of a home from the first of these in `folder`: `truth/floorplan.json`,
/// `floorplan.json`, `zind_data.json`, `layout.obj` (docs/formats.md). Everything is in the world
/// of ReadScene for the same folder.
///
/// * Floorplan: rooms as they stand, walls are the rooms' outlines without doors and openings,
///   doors its openings of kind door; what a picture shows is the outline of the room it was taken
///   in. The truth about a picture's pixels is named where it lies beside the file (labels/, depth/
///   and normals/ with the picture's stem); it is read by who needs it (pixel_truth.h).
/// * ZInD: rooms are the complete rooms, each the union of its panoramas' `layout_complete` (else
///   `layout_raw`), ceilings the median of theirs, none where one of them is not flat. Doors are
///   those of these layouts. What a picture shows is its `layout_visible`, else `layout_raw`.
///   `redraw` is never used.
/// * layout.obj: one room, the vertical projection of the mesh; floor and ceiling have a height
///   where 90 % of them lie within 5 cm of it. Cameras come from the poses beside it.
///
/// Walls are outlines with doors and openings cut out; doors with centres within 0.4 m of each
/// other are one. Picture hashes are those of the file's, or of the picture where it exists.
///
/// `camera_height_m` is the value that the scene was read with (0: none): it scales tours whose
/// scale is null. Throws IoError, InvalidInputError.
[[nodiscard]] GroundTruth ReadGroundTruth(const std::filesystem::path& folder,
                                          double camera_height_m = 0);

}  // namespace enfilade
