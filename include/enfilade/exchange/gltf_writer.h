// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "enfilade/floorplan/types.h"
#include "enfilade/model/types.h"

namespace enfilade {

/// The model as a binary glTF 2.0 file (GLB, Khronos 2017/2021).
///
/// Metres; the root node turns z up into glTF's y up. Below it stands one node per storey and one
/// per room, whose `extras` hold id, area_m2, floor_z and ceiling_z as the plan gives them, and
/// below that one node and mesh per surface ("room_2/floor", "room_2/wall_11"), so that a viewer
/// can hide ceilings. Faces with `uv` get their texture, embedded as JPEG, under
/// KHR_materials_unlit; faces without get a plain colour by kind. Faces are single-sided: from
/// outside one looks into rooms.
///
/// Vertices that are equal in the model stay equal. Same model, same bytes. `version` goes into
/// asset.generator. A uv outside [0, 1], a texture_idx without texture or a face whose room the
/// plan does not hold is a bug of the caller.
[[nodiscard]] std::string FormatGlb(const BuildingModel& model, const Floorplan& plan,
                                    std::string_view version);

/// Writes FormatGlb atomically. Throws IoError.
void WriteGlb(const std::filesystem::path& path, const BuildingModel& model, const Floorplan& plan,
              std::string_view version);

}  // namespace enfilade
