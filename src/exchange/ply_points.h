// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "enfilade/scene/types.h"

namespace enfilade {

/// The vertices of a PLY file, ascii or binary of either byte order, with their normals (made unit;
/// zero stays zero) and, where it has them, colours: `red green blue`, `diffuse_red …` or `r g b`,
/// integers of any width or fractions of one. Other elements and properties, lists too, are passed
/// over. `view_idx` stays empty.
///
/// Throws IoError, and InvalidInputError for a file that is no PLY, is cut, promises more than it
/// can hold, has no positions or no normals, or holds one that is not finite.
[[nodiscard]] std::vector<ScenePoint> ReadPlyPoints(const std::filesystem::path& path);

}  // namespace enfilade
