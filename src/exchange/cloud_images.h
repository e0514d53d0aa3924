// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "enfilade/exchange/point_cloud_reader.h"

namespace enfilade {

/// The list of the images that a patch file counts, or the COLMAP model of those that a `.vis` file
/// counts, where they usually lie: see ReadPointCloud. Throws InvalidInputError when there is none.
[[nodiscard]] std::filesystem::path FindPmvsImages(const std::filesystem::path& patches);
[[nodiscard]] std::filesystem::path FindColmapImages(const std::filesystem::path& ply);

/// The file that ReadCloudImages takes the order from.
[[nodiscard]] std::filesystem::path FileOfImages(const std::filesystem::path& list);

/// Images in their order: of a COLMAP model in a folder, or of the lines of a text file, of which
/// empty ones at the end do not count. Throws IoError, InvalidInputError.
[[nodiscard]] std::vector<CloudImage> ReadCloudImages(const std::filesystem::path& list);

}  // namespace enfilade
