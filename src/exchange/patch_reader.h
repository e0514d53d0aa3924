// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "enfilade/scene/types.h"

namespace enfilade {

/// The patches of PMVS2 (Furukawa & Ponce): positions, normals and, in `view_idx`, the numbers of
/// the images that it found to agree (V(p); those that merely should see the patch are passed
/// over). Colours come from the PLY file that PMVS2 writes of the same patches; empty for none.
///
/// Throws IoError, and InvalidInputError for a file that is no patch file, is cut, or holds numbers
/// that are not finite, and for a PLY file with another number of points.
[[nodiscard]] std::vector<ScenePoint> ReadPatches(const std::filesystem::path& path,
                                                  const std::filesystem::path& colours);

/// The same cloud without the images: lines of position and normal (.pset).
[[nodiscard]] std::vector<ScenePoint> ReadPset(const std::filesystem::path& path);

}  // namespace enfilade
