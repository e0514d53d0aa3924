// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "enfilade/model/types.h"

namespace enfilade {

/// Writes the model as Wavefront OBJ: `path`, its material library beside it (same stem, .mtl) and
/// the textures as textures/atlas_0.jpg, textures/atlas_1.jpg, … below the same folder, referred to
/// by relative paths with forward slashes and without spaces.
///
/// Metres, z up (as the comment in the file says), home frame. One group per surface and room
/// ("g storey_0/room_2/wall_11"). Equal positions within a room share one vertex, so every room is
/// watertight by index. Files are written atomically, those referred to first. Same model, same
/// bytes. A stem that holds white space is a bug of the caller. Throws IoError.
void WriteObj(const std::filesystem::path& path, const BuildingModel& model);

}  // namespace enfilade
