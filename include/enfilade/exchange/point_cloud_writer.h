// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>

#include "enfilade/scene/types.h"

namespace enfilade {

/// Writes who sees the points of a PLY file, as COLMAP's stereo_fusion does beside it (FILE.vis);
/// view_idx are the numbers of the images. Throws IoError.
void WriteVisibility(const std::filesystem::path& path, std::span<const ScenePoint> points);

/// Writes points as PMVS2's patches (.patch): positions and normals as the same single-precision
/// numbers as WritePointsPly, view_idx as the images that agree. Throws IoError.
void WritePatches(const std::filesystem::path& path, std::span<const ScenePoint> points);

}  // namespace enfilade
